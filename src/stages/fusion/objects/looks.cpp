#include "stages/fusion/objects/looks.hpp"

#include <algorithm>
#include <array>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>

#include "stages/fusion/findings.hpp"

namespace credo {
namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();
constexpr std::size_t kPairs = 8;

/// Element `index` of the van der Corput sequence.
double radical_inverse(std::size_t index, std::size_t base) {
  double inverse = 0.0;
  double digit = 1.0;
  for (; index > 0; index /= base) {
    digit /= static_cast<double>(base);
    inverse += digit * static_cast<double>(index % base);
  }
  return inverse;
}

/// Standard normal errors, spread evenly: Halton's sequence (1960) without its beginning, which is
/// the same along all axes.
std::array<Vector6d, kPairs> const& even_errors() {
  static std::array<Vector6d, kPairs> const errors = [] {
    constexpr std::array<std::size_t, 6> kPrimes = {2, 3, 5, 7, 11, 13};
    constexpr std::size_t kSkipped = 20;
    boost::math::normal const standard;
    std::array<Vector6d, kPairs> result;
    for (std::size_t i = 0; i < kPairs; ++i) {
      for (std::size_t axis = 0; axis < kPrimes.size(); ++axis) {
        result[i](static_cast<Eigen::Index>(axis)) =
            boost::math::quantile(standard, radical_inverse(i + kSkipped, kPrimes[axis]));
      }
    }
    return result;
  }();
  return errors;
}

/// How far a point of the surface may be from where the mean has it, one deviation.
double spread_m(PoseDistribution const& pose, KnownSurface const& surface) {
  double const turned_m2 =
      pose.covariance.bottomRightCorner<3, 3>().trace() * surface.radius_m * surface.radius_m;
  return std::sqrt(std::max(0.0, pose.covariance.topLeftCorner<3, 3>().trace() + turned_m2));
}

/// The mean and, where that is not as good as all and the covariance has a root, pairs around it.
std::vector<Se3> poses_of(PoseDistribution const& pose, KnownSurface const& surface) {
  std::vector<Se3> poses = {pose.mean};
  // A frame tells no finer.
  constexpr double kKnown_m = 0.005;
  Eigen::LLT<Matrix6d> const root(pose.covariance);
  if (spread_m(pose, surface) > kKnown_m && root.info() == Eigen::Success) {
    for (Vector6d const& even : even_errors()) {
      Vector6d const error = root.matrixL() * even;
      poses.push_back(boxplus(pose.mean, error));
      poses.push_back(boxplus(pose.mean, -error));
    }
  }
  return poses;
}

int total(PointCounts const& counts) {
  return std::accumulate(counts.by_state.begin(), counts.by_state.end(), 0);
}

/// The part that is seen or seen through.
double share_told(PointCounts const& counts) {
  int const told = counts[PointState::kAgrees] + counts[PointState::kSeenThrough];
  return static_cast<double>(told) / std::max(1, total(counts));
}

/// From 0 at `from` and below it to 1 at `to`.
double rise(double value, double from, double to) {
  return value > from ? std::min(1.0, (value - from) / std::max(to - from, 1e-9)) : 0.0;
}

/// How much likelier it is at this pose that nobody finds the object, and that the depths are as
/// they are, than if it were not there. That one sees through it and that a detector misses it are
/// not independent: the stronger counts. What fits the depths speaks for a detector that erred, but
/// never for the object: others are as large.
double missed_ratio(double found, std::optional<Finding> const& finding) {
  double const missed = 1.0 - found;
  if (!finding) {
    return missed;
  }
  double const fits = likelihood_ratio(*finding);
  return finding->verdict == Verdict::kSeen ? std::min(1.0, missed * fits) : std::min(missed, fits);
}

}  // namespace

double found_if_visible(double visible_share, double shown_px, double seen_if_present,
                        ObjectFusionConfig const& config) {
  if (!(shown_px > 0.0)) {
    return 0.0;
  }
  return seen_if_present *
         rise(visible_share, config.never_found_share, config.surely_found_share) *
         rise(std::log(shown_px), std::log(config.never_found_px),
              std::log(config.surely_found_px));
}

ObjectLooks::ObjectLooks(Sight const& sight, Se3 const& T_world_camera, FusionConfig const& config)
    : view_(sight, T_world_camera),
      objects_(config.objects),
      seen_if_present_(config.existence.seen_if_present),
      rendered_m_(sight.depth_m.width(), sight.depth_m.height(), kNone) {}

ObjectLook ObjectLooks::look_at(PoseDistribution const& pose_world, KnownSurface const& surface) {
  std::vector<Se3> const poses = poses_of(pose_world, surface);
  ObjectLook look;
  double missed = 0.0;
  Eigen::Array<double, 5, 1> points = Eigen::Array<double, 5, 1>::Zero();
  for (Se3 const& pose : poses) {
    auto const [seen, shown_px] = look_from(pose, surface);
    double const visible = share_told(seen);
    double const found = found_if_visible(visible, shown_px, seen_if_present_, objects_);
    look.visible_share += visible;
    look.shown_px += shown_px;
    look.found_if_there += found;
    missed += missed_ratio(found, finding_of(seen, total(seen), false));
    for (Eigen::Index i = 0; i < points.size(); ++i) {
      points[i] += seen.by_state[static_cast<std::size_t>(i)];
    }
  }
  auto const count = static_cast<double>(poses.size());
  look.visible_share /= count;
  look.shown_px /= count;
  look.found_if_there /= count;
  look.missed_if_there = missed / count;
  for (Eigen::Index i = 0; i < points.size(); ++i) {
    look.points.by_state[static_cast<std::size_t>(i)] =
        static_cast<int>(std::lround(points[i] / count));
  }
  return look;
}

ObjectLooks::PoseLook ObjectLooks::look_from(Se3 const& pose_world, KnownSurface const& surface) {
  points_.clear();
  int out_of_view = 0;
  Eigen::Matrix3f const rotation = pose_world.rotation().toRotationMatrix().cast<float>();
  Eigen::Vector3f const translation = pose_world.translation().cast<float>();
  for (Eigen::Vector3f const& p_model : surface.points_model) {
    Eigen::Vector3f const p_camera = view_.in_camera(rotation * p_model + translation);
    if (std::optional<Pixel> const block = view_.block_of(p_camera)) {
      points_.push_back({*block, p_camera.z()});
    } else {
      ++out_of_view;
    }
  }
  render(surface.spacing_m);
  PointCounts counts;
  int facing = 0;
  for (Projected const& point : points_) {
    // A slanted surface lies deeper from one point to the next.
    if (point.depth_m <= rendered_m_[point.block] + surface.spacing_m) {
      ++facing;
      ++counts[state_of(point.depth_m, view_.sight().depth_m[point.block],
                        view_.sight().nearest_m[point.block])];
    }
  }
  for (std::size_t const block : touched_) {
    rendered_m_[block] = kNone;
  }
  // Before what is out of view is added, which covers no pixels.
  double const block_px = view_.sight().block_px;
  double const shown_px =
      share_told(counts) * static_cast<double>(touched_.size()) * block_px * block_px;
  // What is out of view faces the camera as often as what is in view.
  double const share =
      points_.empty() ? 1.0 : static_cast<double>(facing) / static_cast<double>(points_.size());
  counts[PointState::kOutOfView] = static_cast<int>(std::lround(share * out_of_view));
  return {counts, shown_px};
}

/// A point stands for the surface around it, as far as the next one.
void ObjectLooks::render(float spacing_m) {
  touched_.clear();
  for (Projected const& point : points_) {
    auto const radius =
        static_cast<int>(std::lround(spacing_m * view_.focal_blocks() / (2.0F * point.depth_m)));
    int const u_end = std::min(point.block.u + radius + 1, rendered_m_.width());
    int const v_end = std::min(point.block.v + radius + 1, rendered_m_.height());
    for (int v = std::max(0, point.block.v - radius); v < v_end; ++v) {
      for (int u = std::max(0, point.block.u - radius); u < u_end; ++u) {
        float& nearest_m = rendered_m_[{u, v}];
        if (nearest_m == kNone) {
          touched_.push_back(rendered_m_.index({u, v}));
        }
        nearest_m = std::min(nearest_m, point.depth_m);
      }
    }
  }
}

}  // namespace credo
