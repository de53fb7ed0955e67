#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/object_model.hpp"
#include "sim/tabletop.hpp"

namespace credo {

/// The two kinds of scenes that detectors are measured on.
enum class TabletopKind : std::uint8_t {
  /// 3 to 8 known objects, each on the table itself, among up to 4 unknown things.
  kSparse,
  /// 18 to 22 known objects close together: touching, on each other, leaning on each other.
  kClutter,
};

/// Makes scenes of models: each at most once in a scene, at rest on the table or on what is there
/// already, and clear of it. Bodies rest on a face that they do not fall over from; one on others
/// or leaning on them has its centre of mass over what it touches (friction holds what leans).
class TabletopMaker {
public:
  /// Throws std::logic_error for a model that is not a mesh.
  explicit TabletopMaker(ObjectModels const& models);
  TabletopMaker(TabletopMaker const&) = delete;
  TabletopMaker& operator=(TabletopMaker const&) = delete;
  TabletopMaker(TabletopMaker&&) = delete;
  TabletopMaker& operator=(TabletopMaker&&) = delete;
  ~TabletopMaker();

  /// The same for the same models, kind, name and seed.
  [[nodiscard]] TabletopScene make(TabletopKind kind, std::string const& name, int seed) const;

private:
  struct Body;
  class Table;
  std::vector<Body> bodies_;
};

}  // namespace credo
