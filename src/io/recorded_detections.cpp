#include "io/recorded_detections.hpp"

#include <stdexcept>
#include <string>
#include <utility>

#include "core/told_pose.hpp"
#include "io/json_value.hpp"

namespace credo {
namespace {

Matrix6d covariance_of(JsonValue const& value) {
  auto const numbers = value.numbers<36>();
  try {
    return told_covariance(
        Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor> const>(numbers.data()));
  } catch (std::invalid_argument const& error) {
    value.refuse(error.what());
  }
}

Detection detection_of(JsonValue const& value) {
  value.must_be_object(
      {"type", "position", "orientation_xyzw", "covariance", "score", "visible_fraction"});
  Detection detection;
  detection.type = value.at("type").text();
  detection.pose_camera.mean =
      Se3(value.at("orientation_xyzw").orientation(), value.at("position").position());
  detection.pose_camera.covariance = covariance_of(value.at("covariance"));
  detection.score = value.at("score").number();
  if (value.has("visible_fraction")) {
    detection.visible_fraction = value.at("visible_fraction").fraction();
  }
  return detection;
}

std::pair<FrameIndex, std::vector<Detection>> frame_in(JsonValue const& line) {
  line.must_be_object({"frame", "detections"});
  FrameIndex const frame = line.at("frame").frame();
  std::vector<Detection> detections;
  line.at("detections").for_each([&](JsonValue const& value) {
    detections.push_back(detection_of(value));
  });
  return {frame, std::move(detections)};
}

}  // namespace

RecordedDetector::RecordedDetector(std::filesystem::path const& path) {
  for_each_json_line(path, "recorded detections", [&](JsonValue const& line) {
    auto [frame, detections] = frame_in(line);
    if (!by_frame_.try_emplace(frame, std::move(detections)).second) {
      line.at("frame").refuse(std::to_string(number(frame)) + " has a line already");
    }
  });
}

std::vector<Detection> RecordedDetector::detect(Frame const& frame,
                                                std::vector<DetectionRequest> const& /*requests*/) {
  auto const found = by_frame_.find(frame.index);
  return found != by_frame_.end() ? found->second : std::vector<Detection>{};
}

}  // namespace credo
