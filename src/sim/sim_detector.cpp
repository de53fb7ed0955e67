#include "sim/sim_detector.hpp"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <random>
#include <set>
#include <string>
#include <thread>

#include "sim/camera_path.hpp"
#include "sim/scene_time.hpp"
#include "sim/thing.hpp"
#include "sim/visibility.hpp"

namespace credo {
namespace {

/// What a zero sigma is told as.
constexpr double kLeastSigma = 1e-6;
constexpr std::array<double, 2> kFalseAlarmDepth_m = {0.5, 4.0};

/// What a generator is for: each purpose has its own numbers.
enum class Draw : std::uint32_t { kThing, kAlarmCount, kAlarm };

std::mt19937_64 generator(SimDetectorConfig const& config, FrameIndex index, Draw what,
                          std::size_t which) {
  auto const frame = static_cast<std::uint64_t>(number(index));
  std::seed_seq seed{static_cast<std::uint32_t>(config.seed), static_cast<std::uint32_t>(frame),
                     static_cast<std::uint32_t>(frame >> 32U), static_cast<std::uint32_t>(what),
                     static_cast<std::uint32_t>(which)};
  return std::mt19937_64(seed);
}

double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// Standard normal numbers.
template <int kSize>
Eigen::Matrix<double, kSize, 1> normals(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Eigen::Matrix<double, kSize, 1> result;
  for (double& value : result) {
    value = normal(random);
  }
  return result;
}

/// Standard deviations of an error in the order of boxplus.
Vector6d sigmas(SimDetectorConfig const& config) {
  Vector6d result;
  result << Eigen::Vector3d::Constant(config.sigma_position_m),
      Eigen::Vector3d::Constant(config.sigma_rotation_rad);
  return result;
}

Matrix6d told_covariance(SimDetectorConfig const& config) {
  return sigmas(config).cwiseMax(kLeastSigma).cwiseAbs2().asDiagonal();
}

/// The true pose in the camera with noise and bias.
PoseDistribution proposed_pose(SimDetectorConfig const& config, SceneThing const& thing,
                               Se3 const& T_world_camera, std::mt19937_64& random) {
  auto const& bias = config.bias_position_m;
  Se3 const T_camera_world = T_world_camera.inverse();
  Vector6d error = sigmas(config).cwiseProduct(normals<6>(random));
  error.head<3>() += T_camera_world.rotation() * Eigen::Vector3d(bias[0], bias[1], bias[2]);
  return {boxplus(T_camera_world * pose_of(thing), error), told_covariance(config)};
}

std::size_t false_alarm_count(SimDetectorConfig const& config, FrameIndex index) {
  // The distribution is not defined for a mean of 0.
  if (!(config.false_alarms_per_frame > 0.0)) {
    return 0;
  }
  std::mt19937_64 random = generator(config, index, Draw::kAlarmCount, 0);
  return std::poisson_distribution<std::size_t>(config.false_alarms_per_frame)(random);
}

Detection false_alarm(SimDetectorConfig const& config, SceneCamera const& camera,
                      std::set<std::string> const& types, std::mt19937_64 random) {
  Detection alarm;
  std::uniform_int_distribution<std::size_t> any_type(0, types.size() - 1);
  alarm.type = *std::next(types.begin(), static_cast<std::ptrdiff_t>(any_type(random)));
  // Pixel u reaches from u - 1/2 to u + 1/2.
  double const u = uniform(random, -0.5, camera.width_px - 0.5);
  double const v = uniform(random, -0.5, camera.height_px - 0.5);
  double const z = uniform(random, kFalseAlarmDepth_m[0], kFalseAlarmDepth_m[1]);
  Eigen::Vector3d const position(z * (u - camera.cx_px) / camera.fx_px,
                                 z * (v - camera.cy_px) / camera.fy_px, z);
  // A normal vector of four points in any direction alike (Muller 1959), a uniform rotation.
  Eigen::Quaterniond const rotation(normals<4>(random));
  alarm.pose_camera = {Se3(rotation, position), told_covariance(config)};
  alarm.visible_fraction = uniform(random, config.min_visible_fraction, 1.0);
  alarm.score = alarm.visible_fraction;
  alarm.errors_repeat = false;
  return alarm;
}

}  // namespace

SimDetector::SimDetector(Scene const& scene, SimDetectorConfig const& config)
    : world_(scene), config_(config) {}

std::vector<Detection> SimDetector::detect(Frame const& frame,
                                           std::vector<DetectionRequest> const& requests) {
  auto const begin = std::chrono::steady_clock::now();
  std::set<std::string> types;
  for (DetectionRequest const& request : requests) {
    types.insert(request.type);
  }
  SceneCamera const& camera = world_.scene().camera;
  double const time_s = scene_time_s(world_.scene(), frame.index);
  RayCaster const& world = world_.at(time_s);
  PresentThings const& things = world.things();
  Se3 const T_world_camera = camera_pose(camera.path, time_s);
  std::vector<Detection> found;
  for (std::size_t i = 0; i < things.size(); ++i) {
    auto const& thing = things[i];
    if (thing.has_value() && thing->kind == SceneKind::kObject &&
        types.count(type_of(*thing)) == 1) {
      double const visible = visible_fraction(world, i, T_world_camera);
      std::mt19937_64 random = generator(config_, frame.index, Draw::kThing, i);
      bool const missed = uniform(random, 0.0, 1.0) < config_.miss_probability;
      if (!missed && visible > 0.0 && visible >= config_.min_visible_fraction) {
        found.push_back({type_of(*thing), proposed_pose(config_, *thing, T_world_camera, random),
                         visible, visible, false});
      }
    }
  }
  std::size_t const alarm_count = types.empty() ? 0 : false_alarm_count(config_, frame.index);
  for (std::size_t i = 0; i < alarm_count; ++i) {
    found.push_back(
        false_alarm(config_, camera, types, generator(config_, frame.index, Draw::kAlarm, i)));
  }
  std::this_thread::sleep_until(begin + std::chrono::duration<double>(config_.latency_s));
  return found;
}

}  // namespace credo
