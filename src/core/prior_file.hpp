#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/belief.hpp"
#include "core/fields.hpp"

namespace credo {

/// A known object as people write it: what it is and roughly where.
struct PriorEntry {
  std::string id;
  /// Name of a model, or its file.
  std::string model;
  std::vector<double> position_m;
  // One of them, or neither: not turned.
  std::vector<double> orientation_xyzw;
  std::vector<double> rpy_deg;
  /// Standard deviations along and about the frame's axes.
  std::vector<double> sigma_position_m;
  std::vector<double> sigma_rotation_rad;
};
FieldList fields(PriorEntry& entry);

enum class PriorFrame : std::uint8_t {
  kWorld,
  /// The camera's optical frame at the first frame of a run.
  kCamera,
};

/// What the robot is told before it looks (YAML).
struct PriorFile {
  PriorFrame frame = PriorFrame::kWorld;
  std::vector<PriorEntry> objects;
};
FieldList fields(PriorFile& file);

/// What is believed before the first frame.
struct Prior {
  PriorFrame frame = PriorFrame::kWorld;
  /// Poses in that frame, though their members say world.
  std::vector<ObjectBelief> objects;
};

/// The file's pose distributions, in its order. Throws InputError beginning with `where`, and
/// naming the entry, where one is incomplete or its id used twice. An object's type is its entry's
/// model.
[[nodiscard]] Prior prior_of(PriorFile const& file, double probability, std::string const& where);

/// The belief to begin with where the first frame is taken at `T_world_camera`.
[[nodiscard]] BeliefState prior_belief(Prior const& prior, Se3 const& T_world_camera);

}  // namespace credo
