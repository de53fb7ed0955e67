#include "fpfh_proposals.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "geometry/random_draws.hpp"

namespace credo {
namespace {

/// As propose_by_pairs has it.
bool fits(SceneSegment const& segment, float diameter_m) {
  constexpr int kLeastSegment_px = 60;
  bool const too_large =
      segment.extent_m > 1.2F * diameter_m && segment.area_m2 > 1.5F * diameter_m * diameter_m;
  return segment.pixels >= kLeastSegment_px && !too_large;
}

std::size_t draw_below(std::size_t count, std::mt19937_64& random) {
  return std::min(count - 1,
                  static_cast<std::size_t>(draw_uniform(random) * static_cast<double>(count)));
}

/// Some of the scene's points that may be of the model, none twice.
std::vector<std::size_t> drawn_points(SearchModel const& model, SearchScene const& scene,
                                      DescribedPoints const& of_scene,
                                      ClaimedPixels const& explained, std::size_t count,
                                      std::mt19937_64& random) {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < of_scene.points.size(); ++i) {
    BentPoint const& point = of_scene.points[i];
    if (fits(scene.segments[point.segment - 1U], model.diameter_m) &&
        !scene.is_background(scene.pixels[point.pixel], model.diameter_m) &&
        (explained.empty() || explained[point.pixel] == 0)) {
      all.push_back(i);
    }
  }
  std::size_t const drawn = std::min(count, all.size());
  for (std::size_t i = 0; i < drawn; ++i) {
    std::swap(all[i], all[i + draw_below(all.size() - i, random)]);
  }
  all.resize(drawn);
  return all;
}

/// Draws among the model's features nearest to one of the scene; none where the nearest is farther
/// than the deviation.
std::vector<std::size_t> drawn_matches(Eigen::VectorXf const& distances2,
                                       FpfhSettings const& settings, std::mt19937_64& random) {
  float const deviation2 = settings.deviation * settings.deviation;
  if (distances2.minCoeff() > deviation2) {
    return {};
  }
  std::vector<std::size_t> order(static_cast<std::size_t>(distances2.size()));
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::size_t const nearest = std::min(settings.nearest, order.size());
  std::ranges::partial_sort(
      order, order.begin() + static_cast<std::ptrdiff_t>(nearest), {},
      [&](std::size_t i) { return distances2[static_cast<Eigen::Index>(i)]; });
  std::vector<double> sums;
  double sum = 0.0;
  for (std::size_t i = 0; i < nearest; ++i) {
    float const distance2 = distances2[static_cast<Eigen::Index>(order[i])];
    sum += std::exp(-0.5 * static_cast<double>(distance2 / deviation2));
    sums.push_back(sum);
  }
  std::vector<std::size_t> matches;
  for (std::size_t i = 0; i < settings.matches; ++i) {
    auto const at = std::ranges::upper_bound(sums, draw_uniform(random) * sum);
    matches.push_back(order[std::min(nearest - 1, static_cast<std::size_t>(at - sums.begin()))]);
  }
  return matches;
}

Eigen::Matrix3f axes(BentPoint const& point, float sign) {
  Eigen::Matrix3f result;
  result.col(0) = sign * point.bend;
  result.col(2) = point.normal;
  result.col(1) = result.col(2).cross(result.col(0));
  return result;
}

CameraPose pose_of(BentPoint const& of_scene, BentPoint const& of_model, float sign,
                   float turn_rad) {
  CameraPose pose;
  Eigen::Matrix3f const turned =
      Eigen::AngleAxisf(turn_rad, Eigen::Vector3f::UnitZ()).toRotationMatrix();
  pose.rotation = axes(of_scene, sign) * turned * axes(of_model, 1.0F).transpose();
  pose.translation_m = of_scene.point - pose.rotation * of_model.point;
  return pose;
}

}  // namespace

std::vector<Proposal> propose_by_fpfh(SearchModel const& model, DescribedPoints const& of_model,
                                      SearchScene const& scene, DescribedPoints const& of_scene,
                                      ClaimedPixels const& explained,
                                      FpfhSettings const& settings) {
  std::vector<Proposal> proposals;
  if (of_model.points.empty()) {
    return proposals;
  }
  std::mt19937_64 random(settings.seed);
  Eigen::VectorXf const squares = of_model.features.colwise().squaredNorm();
  for (std::size_t const i :
       drawn_points(model, scene, of_scene, explained, settings.points, random)) {
    BentPoint const& from = of_scene.points[i];
    auto const feature = of_scene.features.col(static_cast<Eigen::Index>(i));
    Eigen::VectorXf const distances2 =
        (squares - 2.0F * (of_model.features.transpose() * feature)).array() +
        feature.squaredNorm();
    for (std::size_t const match : drawn_matches(distances2, settings, random)) {
      BentPoint const& to = of_model.points[match];
      float const turn_rad =
          from.has_bend && to.has_bend
              ? 0.0F
              : static_cast<float>(draw_uniform(random) * 2.0 * std::numbers::pi);
      proposals.push_back({pose_of(from, to, 1.0F, turn_rad), from.segment});
      proposals.push_back({pose_of(from, to, -1.0F, turn_rad), from.segment});
    }
  }
  return proposals;
}

}  // namespace credo
