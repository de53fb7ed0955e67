#include "stages/segments/things.hpp"

#include <utility>

#include "stages/segments/color/parts.hpp"
#include "stages/segments/parts/thing_parts.hpp"
#include "stages/segments/parts/thing_sides.hpp"
#include "stages/segments/raised/raised_things.hpp"

namespace credo {

Segments segment_things(Grid<float> const& depth_m, Grid<Rgb> const& color,
                        CameraIntrinsics const& intrinsics,
                        std::optional<Eigen::Vector3d> const& up_camera,
                        SegmentsConfig const& config) {
  Segments segments = convex_segments(depth_m, intrinsics.fx_px, config);
  segments = split_by_color(std::move(segments), depth_m, color, intrinsics.fx_px, config);
  if (config.join_parts) {
    segments = join_parts(std::move(segments), depth_m, intrinsics, up_camera, config);
  }
  if (config.raised_quanta > 0.0) {
    segments = with_raised_things(std::move(segments), depth_m, intrinsics.fx_px, config);
  }
  if (config.join_parts) {
    // Last, for what is raised stands out of one face.
    segments = join_sides(std::move(segments), depth_m, intrinsics, up_camera, config);
  }
  return segments;
}

Segments segment_things(Frame const& frame, std::optional<Eigen::Vector3d> const& up_camera,
                        SegmentsConfig const& config) {
  Grid<Rgb> const none;
  return segment_things(frame.cloud_camera.z, frame.color_registered ? frame.color : none,
                        frame.intrinsics, up_camera, config);
}

}  // namespace credo
