#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/fields.hpp"
#include "core/object_model.hpp"

namespace credo {

enum class LengthUnit : std::uint8_t { kMetre, kMillimetre };

/// About the fixed axes x, y, z, through the model's origin.
struct SymmetryTurn {
  std::vector<double> rpy_deg;
};
FieldList fields(SymmetryTurn& turn);

/// A symmetry as people write it: a word, an axis, or a list of turns.
struct SymmetryEntry {
  enum class Word : std::uint8_t {
    /// What the primitive's own shape allows, standing on its base; none for a mesh.
    kOwn,
    kNone,
  };
  Form form = Form::kWord;
  Word word = Word::kOwn;
  std::vector<double> axis;
  std::vector<double> point_m = {0, 0, 0};
  bool both_ways = false;
  std::vector<SymmetryTurn> turns;
};

/// A model of a known object as people write it (YAML): one primitive in metres, or a mesh.
struct ModelFile {
  /// What objects and detections call it.
  std::string name;
  // Empty, or 0, where not given.
  std::vector<double> box_m;
  double cylinder_radius_m = 0.0;
  double cylinder_height_m = 0.0;
  std::vector<double> table_top_m;
  double table_thickness_m = 0.0;
  double table_height_m = 0.0;
  double table_leg_m = 0.0;
  /// Beside the model's file; any format that assimp reads.
  std::string mesh;
  LengthUnit unit = LengthUnit::kMetre;
  /// What lies behind an open mesh's triangles was never seen.
  bool one_sided = false;
  SymmetryEntry symmetry;
};
FieldList fields(ModelFile& file);

/// The model that a file describes, with its mesh where it names one. Throws InputError beginning
/// with `where` where the file says nothing, too much, or what cannot be (a table whose legs are
/// thicker than its top, an axis of length 0).
[[nodiscard]] ObjectModel model_of(ModelFile const& file, std::optional<TriangleMesh> mesh,
                                   std::string const& where);

}  // namespace credo
