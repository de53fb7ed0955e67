#include "stages/fusion/stuff/hidden_things.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "stages/fusion/points.hpp"

namespace credo {
namespace {

// Of what is measured of the thing so much is hidden, and so many points.
constexpr double kMostlyHidden = 0.6;
constexpr int kLeastHidden = 8;
// A thing hides no more of itself.
constexpr double kMostHiddenByItself = 0.1;
// So much of the cluster touches it, which is not much smaller.
constexpr double kLeastTouching = 0.25;
constexpr float kMostOfSize = 1.2F;

/// Hidden for the most part, believed, and not on its way elsewhere.
bool is_hidden(StuffBelief const& item, StuffLook const& look) {
  int const hidden = look.counts[PointState::kOccluded];
  int const measured =
      hidden + look.counts[PointState::kAgrees] + look.counts[PointState::kSeenThrough];
  return hidden >= kLeastHidden && hidden > kMostlyHidden * measured && item.log_odds > 0.0 &&
         !is_on_its_way(item);
}

/// Whether the cluster is what hides it, or a part of that.
bool is_hidden_by(LabelCode label, StuffLook const& look) {
  auto const share = std::ranges::find(look.shares, label, &ClusterShare::label);
  return share != look.shares.end() &&
         share->hidden > kMostHiddenByItself * look.counts[PointState::kOccluded];
}

Eigen::AlignedBox3f bounds_of(SeenCluster const& seen) {
  Eigen::AlignedBox3f bounds;
  for (Eigen::Vector3f const& point : seen.points_world) {
    bounds.extend(point);
  }
  return bounds;
}

/// The part of the cluster that lies no farther than `near_m` from what is hidden of the thing.
double share_touching(SeenCluster const& seen, Eigen::AlignedBox3f bounds, StuffBelief const& item,
                      StuffLook const& look, float near_m) {
  bounds.min().array() -= near_m;
  bounds.max().array() += near_m;
  std::vector<Eigen::Vector3f> hidden;
  for (std::size_t p = 0; p < look.points.size(); ++p) {
    Eigen::Vector3f const& point = item.model->points[p].p_world;
    if (look.points[p].state == PointState::kOccluded && bounds.contains(point)) {
      hidden.push_back(point);
    }
  }
  auto const touching = std::ranges::count_if(seen.points_world, [&](Eigen::Vector3f const& point) {
    return std::ranges::any_of(hidden, [&](Eigen::Vector3f const& other) {
      return (other - point).squaredNorm() <= near_m * near_m;
    });
  });
  return static_cast<double>(touching) / static_cast<double>(seen.points_world.size());
}

}  // namespace

std::map<std::size_t, LabelCode> what_comes_out(std::vector<StuffBelief> const& stuff,
                                                std::vector<StuffLook> const& looks,
                                                std::vector<SeenCluster> const& clusters,
                                                std::span<std::size_t const> free,
                                                std::vector<bool> const& shows,
                                                SightView const& view) {
  std::map<std::size_t, LabelCode> parts;
  std::map<std::size_t, double> shares;
  for (std::size_t const c : free) {
    SeenCluster const& seen = clusters[c];
    auto const label = static_cast<LabelCode>(kFirstStuff + c);
    Eigen::AlignedBox3f const bounds = bounds_of(seen);
    double const tolerance_m =
        surface_tolerance_m(static_cast<double>(view.in_camera(bounds.center()).squaredNorm()));
    double const pitch_m = std::sqrt(seen.area_m2 / static_cast<double>(seen.blocks.size()));
    std::size_t best = looks.size();
    double most = kLeastTouching;
    for (std::size_t i = 0; i < looks.size(); ++i) {
      if (shows[i] || !is_hidden(stuff[i], looks[i]) || is_hidden_by(label, looks[i])) {
        continue;
      }
      Eigen::AlignedBox3f const& known = stuff[i].latest().bounds_world;
      auto const near_m = static_cast<float>(
          std::max(pitch_m, static_cast<double>(stuff[i].model->spacing_m)) + tolerance_m);
      if (known.exteriorDistance(bounds) > near_m ||
          bounds.diagonal().norm() > kMostOfSize * known.diagonal().norm()) {
        continue;
      }
      double const share = share_touching(seen, bounds, stuff[i], looks[i], near_m);
      if (share > most) {
        most = share;
        best = i;
      }
    }
    if (best < looks.size() && most > shares[best]) {
      shares[best] = most;
      parts[best] = label;
    }
  }
  return parts;
}

}  // namespace credo
