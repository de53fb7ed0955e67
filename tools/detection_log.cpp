#include "detection_log.hpp"

#include <spdlog/fmt/fmt.h>

#include "rounding.hpp"

namespace credo {
namespace {

constexpr std::uint64_t kTold = 5;

std::string line_of(FrameIndex frame, RefusedDetection const& refused) {
  Eigen::Vector3d const& p = refused.pose_world.mean.translation();
  std::string const what =
      fmt::format("frame {}: a {} detected at ({:.2f}, {:.2f}, {:.2f}) m", number(frame),
                  refused.type, rounded(p.x(), 2), rounded(p.y(), 2), rounded(p.z(), 2));
  if (refused.object_id.empty()) {
    return what + " is no object of the belief";
  }
  if (refused.squared_distance <= refused.max_squared_distance) {
    return fmt::format("{} is not taken for {}: another detection fits better", what,
                       refused.object_id);
  }
  return fmt::format(
      "{} is not taken for {}: squared Mahalanobis distance {:.1f}, the gate lets pass {:.1f}",
      what, refused.object_id, refused.squared_distance, refused.max_squared_distance);
}

}  // namespace

std::vector<std::string> DetectionLog::told(Segmentation const& segmentation) {
  (segmentation.objects_looked_for ? looked_ : not_looked_) += 1;
  taken_ += segmentation.objects.size();
  std::vector<std::string> lines;
  for (RefusedDetection const& refused : segmentation.refused) {
    std::uint64_t const count = ++refused_[refused.object_id];
    if (count <= kTold) {
      lines.push_back(line_of(segmentation.frame, refused) +
                      (count == kTold ? " (more of these are only counted)" : ""));
    }
  }
  return lines;
}

std::string DetectionLog::summary() const {
  if (looked_ == 0) {
    return {};
  }
  std::uint64_t total = 0;
  std::string by_object;
  for (auto const& [object, count] : refused_) {
    total += count;
    by_object += fmt::format("{}{} {}", by_object.empty() ? " (" : ", ", count,
                             object.empty() ? "of no object" : object);
  }
  std::string const unlooked = not_looked_ > 0 ? fmt::format("; nobody looked in {} of {} frames",
                                                             not_looked_, looked_ + not_looked_)
                                               : "";
  return fmt::format("objects: {} detections taken, {} refused{}{}\n", taken_, total,
                     by_object.empty() ? "" : by_object + ")", unlooked);
}

}  // namespace credo
