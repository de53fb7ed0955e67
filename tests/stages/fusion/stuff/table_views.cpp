#include "stages/fusion/stuff/table_views.hpp"

#include <algorithm>

#include "geometry/sight.hpp"

namespace credo::test {

Segmentation segmentation_of(View const& view) {
  constexpr int kWidth = 160;
  constexpr int kHeight = 120;
  CameraIntrinsics const camera{150, 150, 79.5, 59.5};
  Grid<float> depth_m(kWidth, kHeight);
  Segmentation segmentation;
  segmentation.stamp_ns = view.stamp_ns;
  segmentation.T_world_camera =
      Se3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(view.x_m, view.y_m, 0.0));
  segmentation.labels = LabelMap(kWidth, kHeight, kUnassigned);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      double nearest_m = 3.0;
      for (Board const& board : view.boards) {
        double const x_m = view.x_m + (u - camera.cx_px) / camera.fx_px * board.z_m;
        double const y_m = view.y_m + (v - camera.cy_px) / camera.fy_px * board.z_m;
        bool const hit = x_m >= board.left_m && x_m < board.left_m + board.width_m &&
                         y_m >= board.top_m && y_m < board.top_m + board.height_m;
        if (hit && board.z_m < nearest_m) {
          nearest_m = board.z_m;
          segmentation.labels[{u, v}] = board.label.value_or(kUnassigned);
        }
      }
      bool const blind = u < view.blind_px && v < view.blind_px;
      if (blind) {
        segmentation.labels[{u, v}] = kNoDepth;
      }
      depth_m[{u, v}] = blind ? 0.0F : static_cast<float>(nearest_m);
    }
  }
  for (Board const& board : view.boards) {
    if (board.label && is_stuff(*board.label)) {
      std::size_t const place = *board.label - std::size_t{kFirstStuff};
      segmentation.stuff.resize(std::max(segmentation.stuff.size(), place + 1));
      segmentation.stuff[place].label = *board.label;
      segmentation.stuff[place].lies_on = board.lies_on;
    }
  }
  for (StuffCluster& cluster : segmentation.stuff) {
    for (LabelCode const label : segmentation.labels) {
      cluster.pixel_count += label == cluster.label ? 1U : 0U;
    }
  }
  segmentation.sight = sight_of(depth_m, segmentation.labels, camera);
  return segmentation;
}

}  // namespace credo::test
