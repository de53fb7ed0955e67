#pragma once

#include <cstddef>
#include <vector>

#include "core/belief.hpp"
#include "core/grid.hpp"
#include "geometry/shapes/known_surface.hpp"
#include "stages/fusion/fusion.hpp"
#include "stages/fusion/sight_view.hpp"

namespace credo {

/// What a frame says of a known object, wherever it may stand by its pose distribution.
struct ObjectLook {
  /// Of the points of its surface that would face the camera; mean over the poses.
  PointCounts points;
  /// Part of them that is seen, or seen through; mean over the poses.
  double visible_share = 0.0;
  /// Pixels that the same part covers; mean over the poses.
  double shown_px = 0.0;
  /// P(a detector finds it | it is there), for what of it is visible.
  double found_if_there = 0.0;
  /// P(no detector finds it and the depths are as they are | it is there), as a multiple of P(the
  /// depths are as they are | it is not there).
  double missed_if_there = 1.0;
};

/// Looks at known objects in a frame. A pose distribution is stood for by its mean and by poses
/// around it, drawn once and for all, in pairs with opposite errors. At each the surface is
/// rendered as points into the blocks of the sight, so that nobody looks for what the object itself
/// hides.
class ObjectLooks {
public:
  /// `sight` must outlive it.
  ObjectLooks(Sight const& sight, Se3 const& T_world_camera, FusionConfig const& config);

  [[nodiscard]] ObjectLook look_at(PoseDistribution const& pose_world, KnownSurface const& surface);

private:
  struct Projected {
    Pixel block;
    float depth_m = 0.0F;
  };
  /// Of the points that would face the camera if it stood there, and the pixels that those of them
  /// cover that are seen or seen through.
  struct PoseLook {
    PointCounts points;
    double shown_px = 0.0;
  };
  [[nodiscard]] PoseLook look_from(Se3 const& pose_world, KnownSurface const& surface);
  void render(float spacing_m);

  SightView view_;
  ObjectFusionConfig objects_;
  double seen_if_present_;
  // Of one pose at a time.
  std::vector<Projected> points_;
  /// Its least depth by block; infinite where it has none.
  Grid<float> rendered_m_;
  std::vector<std::size_t> touched_;
};

/// P(a detector finds an object that is there, of which this part is visible and covers so many
/// pixels): the product of `seen_if_present` and two rises, from 0 at never_found_share to 1 at
/// surely_found_share, and with the logarithm of pixels from never_found_px to surely_found_px.
/// None for no pixels.
[[nodiscard]] double found_if_visible(double visible_share, double shown_px, double seen_if_present,
                                      ObjectFusionConfig const& config);

}  // namespace credo
