#include "core/segmentation.hpp"

namespace credo {

Segmentation unassigned_segmentation(Frame const& frame, Se3 const& T_world_camera,
                                     FrameIndex segmented_with) {
  Segmentation result;
  result.frame = frame.index;
  result.stamp_ns = frame.stamp_ns;
  result.segmented_with = segmented_with;
  result.T_world_camera = T_world_camera;
  OrganizedCloud const& cloud = frame.cloud_camera;
  result.labels = LabelMap(cloud.width(), cloud.height());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    result.labels[i] = cloud.valid(i) ? kUnassigned : kNoDepth;
  }
  return result;
}

}  // namespace credo
