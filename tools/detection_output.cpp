#include "detection_output.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

namespace credo {
namespace {

using Json = nlohmann::ordered_json;

Json row_by_row(Matrix6d const& matrix) {
  Json numbers = Json::array();
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) {
      numbers.push_back(matrix(row, column));
    }
  }
  return numbers;
}

/// Of the directions in which it is known least.
double largest_deviation(Matrix6d const& covariance, int first) {
  return std::sqrt(covariance.diagonal().segment<3>(first).maxCoeff());
}

}  // namespace

std::string detections_json(std::vector<Detection> const& detections) {
  Json list = Json::array();
  for (Detection const& detection : detections) {
    Se3 const& mean = detection.pose_camera.mean;
    Eigen::Vector3d const& p = mean.translation();
    Eigen::Quaterniond const& q = mean.rotation();
    list.push_back({{"type", detection.type},
                    {"position", {p.x(), p.y(), p.z()}},
                    {"orientation_xyzw", {q.x(), q.y(), q.z(), q.w()}},
                    {"score", detection.score},
                    {"visible_fraction", detection.visible_fraction},
                    {"covariance", row_by_row(detection.pose_camera.covariance)}});
  }
  return list.dump() + "\n";
}

std::string detection_table(ObjectModels const& models, std::vector<Detection> const& detections) {
  std::string text =
      fmt::format("{:<20} {:>11} {:>8} {:>27} {:>9} {:>9}\n", "object", "probability", "visible",
                  "x y z, camera [m]", "+- [mm]", "+- [deg]");
  for (auto const& [name, model] : models) {
    bool found = false;
    for (Detection const& detection : detections) {
      if (detection.type != name) {
        continue;
      }
      found = true;
      Eigen::Vector3d const& p = detection.pose_camera.mean.translation();
      Matrix6d const& covariance = detection.pose_camera.covariance;
      text += fmt::format("{:<20} {:>11.3f} {:>7.0f}% {:>9.3f}{:>9.3f}{:>9.3f} {:>9.1f} {:>9.1f}\n",
                          name, detection.score, 100.0 * detection.visible_fraction, p.x(), p.y(),
                          p.z(), 1000.0 * largest_deviation(covariance, 0),
                          largest_deviation(covariance, 3) * 180.0 / std::numbers::pi);
    }
    if (!found) {
      text += fmt::format("{:<20} not found\n", name);
    }
  }
  return text;
}

}  // namespace credo
