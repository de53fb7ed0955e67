#include "dds/segmentation_writer.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "dds/entities.hpp"
#include "dds/thing_messages.hpp"
#include "segmentation.h"

namespace credo {
namespace {

/// Lends the object's ids, and `none`, an empty one.
std::vector<credo_msg_Segment> segments_of(Segmentation const& segmentation,
                                           std::vector<std::string>& object_ids, char* none) {
  std::vector<credo_msg_Segment> segments;
  if (segmentation.floor) {
    segments.push_back({kFloor, credo_msg_SEGMENT_FLOOR, none, segmentation.floor->pixel_count});
  }
  for (WallObservation const& wall : segmentation.walls) {
    segments.push_back({wall.label, credo_msg_SEGMENT_WALL, none, wall.pixel_count});
  }
  for (std::size_t i = 0; i < segmentation.objects.size(); ++i) {
    ObjectObservation const& object = segmentation.objects[i];
    segments.push_back(
        {object.label, credo_msg_SEGMENT_OBJECT, object_ids[i].data(), object.pixel_count});
  }
  for (StuffCluster const& cluster : segmentation.stuff) {
    segments.push_back({cluster.label, credo_msg_SEGMENT_STUFF, none, cluster.pixel_count});
  }
  return segments;
}

}  // namespace

SegmentationWriter::SegmentationWriter(Participant const& participant)
    : source_(participant.source()),
      writer_(
          writer_of(participant, "segmentation", credo_msg_Segmentation_desc, droppable_qos())) {}

bool SegmentationWriter::write(Segmentation const& segmentation, CameraIntrinsics const& intrinsics,
                               std::uint64_t revision) {
  if (!has_readers(writer_)) {
    return true;
  }
  std::vector<std::string> object_ids;
  for (ObjectObservation const& object : segmentation.objects) {
    object_ids.push_back(object.object_id);
  }
  std::string none;
  std::vector<credo_msg_Segment> segments = segments_of(segmentation, object_ids, none.data());
  std::vector<std::uint16_t> labels(segmentation.labels.begin(), segmentation.labels.end());
  credo_msg_Segmentation sample{};
  sample.source = source_.data();
  sample.revision = revision;
  sample.frame = number(segmentation.frame);
  sample.stamp_ns = segmentation.stamp_ns;
  sample.segmented_with = number(segmentation.segmented_with);
  Eigen::Matrix<double, 4, 4, Eigen::RowMajor> const T_world_camera =
      segmentation.T_world_camera.matrix();
  std::copy_n(T_world_camera.data(), 16, sample.T_world_camera);
  sample.fx_px = intrinsics.fx_px;
  sample.fy_px = intrinsics.fy_px;
  sample.cx_px = intrinsics.cx_px;
  sample.cy_px = intrinsics.cy_px;
  sample.width_px = static_cast<std::uint32_t>(segmentation.labels.width());
  sample.height_px = static_cast<std::uint32_t>(segmentation.labels.height());
  sample.labels = lent<decltype(sample.labels)>(labels);
  sample.segments = lent<dds_sequence_credo_msg_Segment>(segments);
  return write_now(writer_, sample);
}

}  // namespace credo
