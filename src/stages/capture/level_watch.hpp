#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/frame.hpp"
#include "core/se3.hpp"
#include "stages/capture/level.hpp"

namespace credo {

/// Looks whether the floor is still where the level says, as a sensor that stands still may be
/// bumped: all that is seen after that is believed in a wrong place.
///
/// Once a second it finds the floor anew. The camera has moved where three looks in a row find it
/// tilted by more than 2 degrees, or more than 4 cm higher or lower below the camera. A level plane
/// 30 cm away and more is another surface, such as a table in front of the camera, and says
/// nothing; neither does a frame without a floor.
class LevelWatch {
public:
  explicit LevelWatch(WorldLevel const& level)
      : T_world_source_(level.T_world_source), given_(level.given) {}

  /// Frames in their order. A line for people when the camera is found to have moved, and one when
  /// it stands as it did at first; none otherwise.
  std::optional<std::string> look(Frame const& frame);

private:
  Se3 T_world_source_;
  bool given_;
  std::optional<std::int64_t> looked_at_ns_;
  /// Looks in a row that say the contrary of what was told last.
  int against_ = 0;
  bool moved_ = false;
};

}  // namespace credo
