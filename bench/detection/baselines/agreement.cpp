#include "agreement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace credo {
namespace {

constexpr int kBlock_px = 4;
constexpr float kSelfHidden_m = 0.012F;

struct Projected {
  Pixel pixel;
  std::size_t block = 0;
  float z = 0.0F;
  /// Cosine between its normal and the ray.
  float facing = 0.0F;
};

/// The points that a camera could see of the model alone.
std::vector<Projected> seen_alone(NormalCloud const& model, Eigen::Isometry3f const& pose,
                                  SceneCloud const& scene) {
  std::vector<Projected> points;
  int const blocks_wide = (scene.depth_m.width() + kBlock_px - 1) / kBlock_px;
  int const blocks_high = (scene.depth_m.height() + kBlock_px - 1) / kBlock_px;
  std::vector<float> nearest(static_cast<std::size_t>(blocks_wide * blocks_high),
                             std::numeric_limits<float>::infinity());
  for (pcl::PointNormal const& point : model) {
    Eigen::Vector3f const p = pose * point.getVector3fMap();
    float const facing = -(pose.linear() * point.getNormalVector3fMap()).dot(p) / p.norm();
    if (p.z() < 0.1F || facing < 0.1F) {
      continue;
    }
    auto const& camera = scene.intrinsics;
    Pixel const pixel{static_cast<int>(std::lround(camera.fx_px * p.x() / p.z() + camera.cx_px)),
                      static_cast<int>(std::lround(camera.fy_px * p.y() / p.z() + camera.cy_px))};
    if (!scene.depth_m.contains(pixel)) {
      continue;
    }
    auto const block =
        static_cast<std::size_t>(pixel.v / kBlock_px * blocks_wide + pixel.u / kBlock_px);
    points.push_back({pixel, block, p.z(), facing});
    nearest[block] = std::min(nearest[block], p.z());
  }
  std::erase_if(points, [&](Projected const& point) {
    return point.z > nearest[point.block] + kSelfHidden_m;
  });
  return points;
}

}  // namespace

double Agreement::score() const {
  double const all = explained + 0.5 * hidden + looked_through;
  return all > 0.0 ? (explained - looked_through) / all : 0.0;
}

Agreement agreement(NormalCloud const& model, Eigen::Isometry3f const& pose_camera,
                    SceneCloud const& scene, float slack_m) {
  Agreement result;
  double known = 0.0;
  for (Projected const& point : seen_alone(model, pose_camera, scene)) {
    float const seen_m = scene.depth_m[point.pixel];
    known += 1.0;
    if (!(seen_m > 0.0F)) {
      result.hidden += 0.5;
      continue;
    }
    float const tolerance_m = 0.006F + 0.004F * seen_m * seen_m + slack_m;
    float const off = std::abs(seen_m - point.z) / tolerance_m;
    if (off < 1.0F) {
      // Across the surface, not along the ray.
      float const across = off * point.facing;
      result.explained += 1.0 - across * across;
      result.blocks.push_back(point.block);
    } else if (seen_m < point.z) {
      result.hidden += 1.0;
    } else {
      result.looked_through += 1.0;
    }
  }
  if (known > 0.0) {
    result.explained /= known;
    result.hidden /= known;
    result.looked_through /= known;
  }
  std::ranges::sort(result.blocks);
  auto const [first, last] = std::ranges::unique(result.blocks);
  result.blocks.erase(first, last);
  return result;
}

Detection detection_of(Candidate const& candidate) {
  constexpr double kPlace_m = 0.01;
  constexpr double kTurn_rad = 0.1;
  Vector6d variances;
  variances << Eigen::Vector3d::Constant(kPlace_m * kPlace_m),
      Eigen::Vector3d::Constant(kTurn_rad * kTurn_rad);
  return {candidate.model,
          {Se3(Eigen::Quaterniond(candidate.pose_camera.linear().cast<double>()),
               candidate.pose_camera.translation().cast<double>()),
           variances.asDiagonal()},
          candidate.score,
          candidate.fit.explained};
}

std::vector<Detection> best_candidates(std::vector<Candidate> candidates, double least_score) {
  constexpr double kMostTaken = 0.4;
  std::ranges::stable_sort(candidates, std::greater{}, &Candidate::score);
  std::set<std::size_t> taken;
  std::set<std::string> found;
  std::vector<Detection> detections;
  for (Candidate const& candidate : candidates) {
    if (candidate.score < least_score || candidate.fit.blocks.empty() ||
        found.contains(candidate.model)) {
      continue;
    }
    auto const shared = std::ranges::count_if(
        candidate.fit.blocks, [&](std::size_t block) { return taken.contains(block); });
    if (static_cast<double>(shared) >
        kMostTaken * static_cast<double>(candidate.fit.blocks.size())) {
      continue;
    }
    taken.insert(candidate.fit.blocks.begin(), candidate.fit.blocks.end());
    found.insert(candidate.model);
    detections.push_back(detection_of(candidate));
  }
  return detections;
}

}  // namespace credo
