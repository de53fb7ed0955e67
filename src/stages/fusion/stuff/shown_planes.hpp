#pragma once

#include <cstddef>
#include <map>
#include <optional>

#include "core/label.hpp"
#include "core/plane.hpp"
#include "core/segmentation.hpp"
#include "stages/fusion/stuff/looks.hpp"

namespace credo {

/// The planes that a frame calls floor and walls. Blocks are held against these, and not against
/// those that are believed, so that a pose that is off does not count.
class ShownPlanes {
public:
  /// `segmentation` must outlive it.
  explicit ShownPlanes(Segmentation const& segmentation);

  /// Of the blocks that agree with a thing and that the frame calls floor, wall or known object,
  /// whether most are that: not those that lie off their plane by more than a Kinect's noise (1.5
  /// cm + 1.5 mm/m^2 times the squared distance), such as a door in its wall. Nor where they stand
  /// before it by more than 1.5 cm + 0.5 mm/m^2 times the squared distance on the mean, in which
  /// noise goes away.
  [[nodiscard]] bool are_what_shows(StuffLook const& look) const;

private:
  /// What is measured in a block, and the plane that the frame has there.
  struct Offset {
    /// How far it stands before the plane, on the camera's side.
    double before_m = 0.0;
    double squared_distance_m2 = 0.0;
  };
  /// None where the frame has no plane.
  [[nodiscard]] std::optional<Offset> offset_of(std::size_t block) const;

  Segmentation const& segmentation_;
  std::map<LabelCode, Plane> plane_world_;
};

}  // namespace credo
