#include "dds/detection_messages.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/told_pose.hpp"
#include "dds/thing_messages.hpp"

namespace credo {
namespace {

/// Matrices go row by row.
using RowMajor6d = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

credo_msg_CameraPose message_of(PoseDistribution const& pose) {
  credo_msg_CameraPose message{};
  std::copy_n(pose.mean.translation().data(), 3, message.position_camera_m);
  // Eigen keeps them as x, y, z, w.
  std::copy_n(pose.mean.rotation().coeffs().data(), 4, message.orientation_camera_xyzw);
  Eigen::Map<RowMajor6d>(message.covariance) = pose.covariance;
  return message;
}

/// `value()`, its complaint with the name before it.
template <typename Value>
auto named(char const* name, Value const& value) {
  try {
    return value();
  } catch (std::invalid_argument const& error) {
    throw std::invalid_argument(std::string(name) + " " + error.what());
  }
}

PoseDistribution pose_in(credo_msg_CameraPose const& message) {
  double const* const xyzw = message.orientation_camera_xyzw;
  Eigen::Vector3d const position = named("position_camera_m", [&] {
    return told_position(Eigen::Vector3d(message.position_camera_m));
  });
  Eigen::Quaterniond const orientation = named("orientation_camera_xyzw", [&] {
    return told_orientation({xyzw[3], xyzw[0], xyzw[1], xyzw[2]});
  });
  Matrix6d const covariance = named("covariance", [&] {
    return told_covariance(Eigen::Map<RowMajor6d const>(message.covariance));
  });
  return {Se3(orientation, position), covariance};
}

Detection detection_in(credo_msg_FoundObject const& message) {
  Detection detection;
  detection.type = message.type;
  if (detection.type.empty()) {
    throw std::invalid_argument("type must not be empty");
  }
  detection.pose_camera = pose_in(message.pose);
  detection.score = message.score;
  if (!std::isfinite(detection.score)) {
    throw std::invalid_argument("score must be finite");
  }
  detection.visible_fraction = message.visible_fraction;
  if (!(detection.visible_fraction >= 0.0 && detection.visible_fraction <= 1.0)) {
    throw std::invalid_argument("visible_fraction must be in [0, 1]");
  }
  return detection;
}

std::string about(credo_msg_DetectionReply const& reply) {
  return "the detector's reply to frame " + std::to_string(reply.frame);
}

}  // namespace

DetectionRequestMessage::DetectionRequestMessage(DetectionSession const& session,
                                                 Frame const& frame,
                                                 std::vector<DetectionRequest> const& requests) {
  Grid<float> const& depth_m = frame.cloud_camera.z;
  bool const has_color = frame.color.size() > 0;
  if (has_color &&
      (frame.color.width() != depth_m.width() || frame.color.height() != depth_m.height())) {
    throw std::logic_error("a frame's colour is not of its depth's size");
  }
  for (DetectionRequest const& request : requests) {
    objects_.push_back({lent_text(request.object_id), lent_text(request.type),
                        message_of(request.expected_camera)});
  }
  sample_.source = lent_text(session.source);
  sample_.session = session.number;
  sample_.schema_version = credo_msg_DETECTION_SCHEMA;
  sample_.frame = number(frame.index);
  sample_.stamp_ns = frame.stamp_ns;
  sample_.fx_px = frame.intrinsics.fx_px;
  sample_.fy_px = frame.intrinsics.fy_px;
  sample_.cx_px = frame.intrinsics.cx_px;
  sample_.cy_px = frame.intrinsics.cy_px;
  sample_.width_px = static_cast<std::uint32_t>(depth_m.width());
  sample_.height_px = static_cast<std::uint32_t>(depth_m.height());
  sample_.depth_m = lent_values<dds_sequence_float>(depth_m.data(), depth_m.size());
  if (has_color) {
    static_assert(sizeof(Rgb) == 3);
    sample_.color_rgb =
        lent_values<dds_sequence_octet>(frame.color.data()->data(), 3 * frame.color.size());
  }
  sample_.color_registered = has_color && frame.color_registered;
  sample_.objects = lent<dds_sequence_credo_msg_WantedObject>(objects_);
}

std::vector<Detection> detections_in(credo_msg_DetectionReply const& reply) {
  if (reply.schema_version != credo_msg_DETECTION_SCHEMA) {
    throw std::runtime_error(about(reply) + " has schema " + std::to_string(reply.schema_version) +
                             ", and this Credo reads " +
                             std::to_string(credo_msg_DETECTION_SCHEMA) +
                             ": build both with the same idl/credo/detector.idl");
  }
  if (*reply.error != '\0') {
    throw NobodyLooked(std::string("the detector says: ") + reply.error);
  }
  std::vector<Detection> detections;
  for (std::uint32_t i = 0; i < reply.detections._length; ++i) {
    try {
      detections.push_back(detection_in(reply.detections._buffer[i]));
    } catch (std::invalid_argument const& error) {
      throw std::runtime_error(about(reply) + ": detections[" + std::to_string(i) + "] (" +
                               reply.detections._buffer[i].type + "): " + error.what());
    }
  }
  return detections;
}

}  // namespace credo
