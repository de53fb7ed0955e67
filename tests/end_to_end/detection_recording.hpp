#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "end_to_end/known_scene.hpp"
#include "sim/camera_path.hpp"
#include "sim/scene_time.hpp"

namespace credo::test {

/// A file of recorded detections: each object of the scene where it truly is, moved.
class DetectionRecording {
public:
  DetectionRecording(std::filesystem::path const& path, Scene const& scene)
      : file_(path), scene_(scene) {}

  DetectionRecording& frame(std::int64_t index) {
    finish();
    frame_ = {{"frame", index}, {"detections", nlohmann::json::array()}};
    index_ = index;
    return *this;
  }
  DetectionRecording& sees(std::string const& thing,
                           Eigen::Vector3d const& off_world_m = {0, 0, 0}) {
    Se3 const truth = true_pose(scene_, index_, thing);
    Se3 const T_world_thing(truth.rotation(), truth.translation() + off_world_m);
    Se3 const pose =
        camera_pose(scene_.camera.path, scene_time_s(scene_, FrameIndex{index_})).inverse() *
        T_world_thing;
    Eigen::Quaterniond const& q = pose.rotation();
    Eigen::Vector3d const& p = pose.translation();
    nlohmann::json covariance = nlohmann::json::array();
    for (int i = 0; i < 36; ++i) {
      covariance.push_back(i % 7 == 0 ? 1e-4 : 0.0);
    }
    frame_["detections"].push_back(
        {{"type", scene_.things[static_cast<std::size_t>(position_of(scene_, thing))].type},
         {"position", {p.x(), p.y(), p.z()}},
         {"orientation_xyzw", {q.x(), q.y(), q.z(), q.w()}},
         {"covariance", covariance},
         {"score", 1.0}});
    return *this;
  }
  void finish() {
    if (!frame_.is_null()) {
      file_ << frame_ << std::endl;
      frame_ = nullptr;
    }
  }

private:
  std::ofstream file_;
  Scene scene_;
  nlohmann::json frame_;
  std::int64_t index_ = 0;
};

}  // namespace credo::test
