#include "detector/poses/procrustes_refinement.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include "detector/poses/edge_contacts.hpp"
#include "detector/scenes/scene_projection.hpp"
#include "geometry/bingham/procrustes.hpp"
#include "geometry/random_draws.hpp"

namespace credo {
namespace {

constexpr int kRounds = 5;
/// So many of the view's points are looked at, and at most so many aligned.
constexpr std::size_t kLookedAt = 100;
constexpr std::size_t kAligned = 30;
constexpr std::size_t kEdges = 16;
/// Of a point from what it falls on, before the pose is right; three of them are too far.
constexpr double kSurfaceSigma_m = 0.010;
/// Angles count a fifth of what they are, beside this (as the authors weigh them).
constexpr double kAngleShare = 0.2;
constexpr double kAngleSigma_rad = 0.14;
constexpr std::size_t kFewestPoints = 4;

/// A point of the model, and what it falls on.
struct Fall {
  PointMatch point;
  DirectionMatch normal;
  /// How well both agree, in (0, 1].
  double likelihood = 0.0;
};

/// By the segment that they fall on.
using Falls = std::map<std::uint16_t, std::vector<Fall>>;

class Round {
public:
  Round(SearchModel const& model, SearchScene const& scene, CameraPose const& pose)
      : model_(model),
        scene_(scene),
        pose_(pose),
        view_(model.view_from(-(pose.rotation.transpose() * (pose * model.centre_model)))) {}

  [[nodiscard]] Falls falls() const {
    SceneProjection const project(scene_);
    Falls falls;
    std::size_t const count = std::min(kLookedAt, view_.visible.size());
    for (std::size_t k = 0; k < count; ++k) {
      std::uint16_t const i = view_.visible[k];
      Pixel pixel;
      if (!project.at(pose_ * model_.points_model[i], pixel)) {
        continue;
      }
      ScenePixel const& seen = scene_.pixels[pixel];
      if (!seen.has_normal() || scene_.is_background(seen, model_.diameter_m)) {
        continue;
      }
      Fall const fall = fall_on(i, pixel);
      if (fall.likelihood > kLeastLikelihood) {
        falls[seen.segment].push_back(fall);
      }
    }
    return falls;
  }

  /// Where the scene's surface ends, for some of the silhouette.
  void add_edges(std::vector<PointMatch>& points, std::mt19937_64& random) const {
    std::size_t const count = view_.outline.size();
    if (count == 0) {
      return;
    }
    auto const first = static_cast<std::size_t>(draw_uniform(random) * static_cast<double>(count));
    std::size_t const step = std::max<std::size_t>(1, count / kEdges);
    for (std::size_t k = 0; k < count; k += step) {
      EdgeLook const look = look_at_edge(model_, scene_, pose_, view_.outline[(first + k) % count]);
      if (look.verdict == EdgeVerdict::kFound) {
        EdgeContact const& contact = look.contact;
        points.push_back({to_model(contact.point),
                          (contact.point + contact.residual_m * contact.direction).cast<double>(),
                          2.0 * static_cast<double>(contact.deviation_m)});
      }
    }
  }

private:
  static constexpr double kLeastLikelihood = 0.011;  // three deviations

  [[nodiscard]] Eigen::Vector3d to_model(Eigen::Vector3f const& p_camera) const {
    return (pose_.rotation.transpose() * (p_camera - pose_.translation_m)).cast<double>();
  }

  [[nodiscard]] Fall fall_on(std::uint16_t i, Pixel pixel) const {
    Fall fall;
    fall.point = {model_.points_model[i].cast<double>(), scene_.point_at(pixel).cast<double>(),
                  kSurfaceSigma_m};
    fall.normal = {model_.normals_model[i].cast<double>(),
                   scene_.pixels[pixel].normal_camera().normalized().cast<double>(), kNormalKappa};
    double const d =
        static_cast<double>((scene_.point_at(pixel) - pose_ * model_.points_model[i]).norm()) /
        kSurfaceSigma_m;
    double const cosine = static_cast<double>(
        scene_.pixels[pixel].normal_camera().dot(pose_.rotation * model_.normals_model[i]));
    double const turn = kAngleShare * std::acos(std::clamp(cosine, -1.0, 1.0)) / kAngleSigma_rad;
    fall.likelihood = std::exp(-0.5 * (d * d + turn * turn));
    return fall;
  }

  SearchModel const& model_;
  SearchScene const& scene_;
  CameraPose const& pose_;
  ModelView const& view_;
};

/// Those of the segments that are drawn, each as likely as its points agree on average.
std::vector<Fall const*> drawn(Falls const& falls, std::mt19937_64& random) {
  std::vector<Fall const*> all;
  for (auto const& [segment, own] : falls) {
    double sum = 0.0;
    for (Fall const& fall : own) {
      sum += fall.likelihood;
    }
    if (draw_uniform(random) < sum / static_cast<double>(own.size())) {
      for (Fall const& fall : own) {
        all.push_back(&fall);
      }
    }
  }
  // The first of a shuffle (Fisher and Yates).
  std::size_t const count = std::min(kAligned, all.size());
  for (std::size_t i = 0; i < count; ++i) {
    auto const left = static_cast<double>(all.size() - i);
    std::swap(all[i], all[i + static_cast<std::size_t>(draw_uniform(random) * left)]);
  }
  all.resize(count);
  return all;
}

}  // namespace

ScoredPose procrustes_refined(SearchModel const& model, SearchScene const& scene,
                              PoseScore const& score, ScoredPose const& start,
                              std::size_t score_points, std::mt19937_64& random) {
  ScoredPose best = start;
  std::vector<PointMatch> points;
  std::vector<DirectionMatch> directions;
  for (int round = 0; round < kRounds; ++round) {
    Round const at_best(model, scene, best.pose);
    Falls const falls = at_best.falls();
    points.clear();
    directions.clear();
    for (Fall const* fall : drawn(falls, random)) {
      points.push_back(fall->point);
      directions.push_back(fall->normal);
    }
    at_best.add_edges(points, random);
    if (points.size() < kFewestPoints) {
      continue;
    }
    CameraPose const pose = camera_pose(best_pose(align(points, directions)));
    float const of_pose = score(pose, score_points);
    if (of_pose > best.score) {
      best = {pose, of_pose};
    }
  }
  return best;
}

}  // namespace credo
