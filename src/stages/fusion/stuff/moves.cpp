#include "stages/fusion/stuff/moves.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "geometry/icp.hpp"
#include "geometry/thickness.hpp"
#include "stages/fusion/existence.hpp"

namespace credo {
namespace {

constexpr double kFarthest_m = 0.5;
constexpr double kMostSizeRatio = 1.5;
constexpr std::size_t kMostIcpPoints = 200;
constexpr int kIcpSteps = 5;
// The RMS after ICP: of the sensor's noise, which grows with the squared distance, and of the
// thing's size.
constexpr double kLeastRms_m = 0.012;
constexpr double kRmsPerSquareMetre = 0.0015;
constexpr double kShareOfSize = 0.2;
// What lies so many times as far from a cluster's middle as half of it is no part of it.
constexpr float kStray = 4.0F;
// Of a thing that moves more may come into view from one frame to the next.
constexpr float kMostGrowth = 4.0F;
// A thing makes way for a cluster where so much of what is measured of it is hidden by that, or
// seen through.
constexpr double kMakesWay = 0.6;
constexpr int kLeastMeasured = 8;
// What stood still may set out: nobody walks faster.
constexpr double kWalk_mps = 2.0;
// It is on its way where it moved at so many of its looks, of four at the least.
constexpr double kMovesOften = 0.3;
constexpr std::size_t kFewestLooks = 4;
constexpr std::size_t kLooksRemembered = 36;
// A thing has moved where so much of what the frame tells of it is seen through.
constexpr double kMostThroughSeen = 0.35;
constexpr double kTimeOnItsWay_s = 0.5;

bool moves_often(StuffBelief const& item) {
  return item.moved_share > kMovesOften;
}

/// Whether it arrived itself, or moved, a few looks ago, or was seen once, and not since in one
/// with something else: nothing says that it stands still.
bool has_just_come(StuffBelief const& item) {
  return (item.history_count == 1 && item.one_with.empty()) ||
         (item.history_count < kFewestLooks && item.moved_share > 0.0);
}

/// Whether what a thing should show is hidden by a cluster, or seen through. What only lies at
/// the edge of something nearer tells nothing.
bool is_gone_behind(StuffLook const& look, std::size_t cluster, bool may_be_seen_through) {
  auto const label = static_cast<LabelCode>(kFirstStuff + cluster);
  int hidden = 0;
  int through = look.counts[PointState::kSeenThrough];
  int measured = through + look.counts[PointState::kAgrees];
  for (ClusterShare const& share : look.shares) {
    hidden += share.label == label ? share.hidden : 0;
    measured += share.hidden;
  }
  return (hidden > 0 || may_be_seen_through) && measured >= kLeastMeasured &&
         hidden + through > kMakesWay * measured;
}

/// Whether a thing has left its place to a cluster that has come there.
bool makes_way_for(StuffBelief const& item, StuffLook const& look, FreeCluster const& free) {
  return (moves_often(item) || (free.arrived && has_just_come(item))) &&
         is_gone_behind(look, free.cluster, moves_often(item));
}

std::vector<Eigen::Vector3f> centred(std::span<Eigen::Vector3f const> points,
                                     Eigen::Vector3f const& centre) {
  std::size_t const step = (points.size() + kMostIcpPoints - 1) / kMostIcpPoints;
  std::vector<Eigen::Vector3f> some;
  for (std::size_t i = 0; i < points.size(); i += std::max<std::size_t>(step, 1)) {
    some.push_back(points[i] - centre);
  }
  return some;
}

Eigen::Vector3f mean_of(std::span<Eigen::Vector3f const> points) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (Eigen::Vector3f const& point : points) {
    sum += point;
  }
  return sum / static_cast<float>(std::max<std::size_t>(points.size(), 1));
}

/// Standard deviations along the points' own axes, ascending.
Eigen::Vector3f extents_of(std::span<Eigen::Vector3f const> points) {
  Eigen::Vector3f const mean = mean_of(points);
  Eigen::Matrix3f spread = Eigen::Matrix3f::Zero();
  for (Eigen::Vector3f const& point : points) {
    spread += (point - mean) * (point - mean).transpose();
  }
  spread /= static_cast<float>(std::max<std::size_t>(points.size(), 1));
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f>(spread, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .cwiseMax(0.0F)
      .cwiseSqrt();
}

float median_of(std::vector<float> values) {
  auto const middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// Of some points the median along each axis.
Eigen::Vector3f middle_of(std::span<Eigen::Vector3f const> points) {
  Eigen::Vector3f middle;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::vector<float> along;
    along.reserve(points.size());
    for (Eigen::Vector3f const& point : points) {
      along.push_back(point[axis]);
    }
    middle[axis] = median_of(std::move(along));
  }
  return middle;
}

/// Without what lies far from most of it: at its edge a cluster has pixels of what is behind it.
std::vector<Eigen::Vector3f> without_strays(std::span<Eigen::Vector3f const> points) {
  if (points.empty()) {
    return {};
  }
  Eigen::Vector3f const middle = middle_of(points);
  std::vector<float> distances_m;
  distances_m.reserve(points.size());
  for (Eigen::Vector3f const& point : points) {
    distances_m.push_back((point - middle).norm());
  }
  float const most_m = kStray * median_of(distances_m);
  std::vector<Eigen::Vector3f> most;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (distances_m[i] <= most_m) {
      most.push_back(points[i]);
    }
  }
  return most;
}

/// Whether the one is as large as the other, along its two longer axes.
bool are_as_large(std::span<Eigen::Vector3f const> one, std::span<Eigen::Vector3f const> other) {
  Eigen::Vector3f const a = extents_of(one);
  Eigen::Vector3f const b = extents_of(other);
  for (Eigen::Index i = 1; i < 3; ++i) {
    auto const [less, more] = std::minmax(a[i], b[i]);
    if (static_cast<double>(more) > kMostSizeRatio * static_cast<double>(less)) {
      return false;
    }
  }
  return true;
}

/// RMS distance of the cluster from the thing's shape, once laid on it; none where they differ.
std::optional<double> fit_of(StuffBelief const& item, SeenCluster const& cluster,
                             Eigen::Vector3d const& camera_world) {
  std::vector<Eigen::Vector3f> const known = without_strays(item.latest().points_world);
  std::vector<Eigen::Vector3f> const seen = without_strays(cluster.points_world);
  Eigen::Vector3f const from = mean_of(known);
  Eigen::Vector3f const to = mean_of(seen);
  if ((from - to).norm() > static_cast<float>(kFarthest_m) || !are_as_large(known, seen)) {
    return std::nullopt;
  }
  IcpConfig config;
  config.max_iterations = kIcpSteps;
  double const noise_m = kRmsPerSquareMetre * (to.cast<double>() - camera_world).squaredNorm();
  config.max_rms_m = std::min(std::max(kLeastRms_m, noise_m),
                              kShareOfSize * static_cast<double>(extents_of(known).z()));
  auto const fit = align_icp(centred(seen, to), centred(known, from), config);
  return fit ? std::optional(fit->rms_m) : std::nullopt;
}

/// How far it would have come; none where that is too far, or the two are not nearly as large.
std::optional<double> way_to(StuffBelief const& item, SeenCluster const& cluster) {
  std::vector<Eigen::Vector3f> const& known = item.latest().points_world;
  // As a list, for its elements are copied.
  auto const [less, more] =
      std::minmax({extents_of(known).z(), extents_of(cluster.points_world).z()});
  auto const way_m = static_cast<double>((mean_of(known) - mean_of(cluster.points_world)).norm());
  return way_m > kFarthest_m || more > kMostGrowth * less ? std::nullopt : std::optional(way_m);
}

/// How far what stood still has come since it was seen; none where it has not set out. What arrived
/// hides its place, is as large, and no farther from there than one walks, nor than the thing is
/// wide: between the two is no room for both.
std::optional<double> way_since_seen(StuffBelief const& item, StuffLook const& look,
                                     SeenCluster const& cluster, FreeCluster const& free,
                                     std::int64_t now_ns) {
  double const elapsed_s = 1e-9 * static_cast<double>(now_ns - item.last_look.stamp_ns);
  if (!free.arrived || !is_gone_behind(look, free.cluster, false)) {
    return std::nullopt;
  }
  std::vector<Eigen::Vector3f> const known = without_strays(item.latest().points_world);
  std::vector<Eigen::Vector3f> const seen = without_strays(cluster.points_world);
  auto const way_m = static_cast<double>((middle_of(known) - middle_of(seen)).norm());
  // A board's standard deviation is its width by the root of 12.
  double const width_m = std::sqrt(12.0) * static_cast<double>(extents_of(known).y());
  bool const may_be_it =
      way_m <= std::min(kWalk_mps * elapsed_s, width_m) && are_as_large(known, seen);
  return may_be_it ? std::optional(way_m) : std::nullopt;
}

}  // namespace

std::vector<SeenCluster> clusters_of(Segmentation const& segmentation) {
  Sight const& sight = segmentation.sight;
  std::vector<SeenCluster> clusters(segmentation.stuff.size());
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    StuffCluster const& cluster = segmentation.stuff[c];
    clusters[c].pixel_count = cluster.pixel_count;
    if (cluster.lies_on) {
      clusters[c].lies_on = static_cast<std::int32_t>(*cluster.lies_on) - kFirstStuff;
    }
  }
  for (auto const& [label, thickness] : thickness_px(sight.labels)) {
    clusters.at(label - std::size_t{kFirstStuff}).thickness_blocks = thickness;
  }
  Eigen::Matrix3f const R = segmentation.T_world_camera.rotation().toRotationMatrix().cast<float>();
  Eigen::Vector3f const t = segmentation.T_world_camera.translation().cast<float>();
  auto const fx = static_cast<float>(sight.intrinsics.fx_px);
  auto const fy = static_cast<float>(sight.intrinsics.fy_px);
  auto const cx = static_cast<float>(sight.intrinsics.cx_px);
  auto const cy = static_cast<float>(sight.intrinsics.cy_px);
  double const block_area =
      sight.block_px * sight.block_px / (sight.intrinsics.fx_px * sight.intrinsics.fy_px);
  for (int v = 0; v < sight.labels.height(); ++v) {
    for (int u = 0; u < sight.labels.width(); ++u) {
      LabelCode const label = sight.labels[{u, v}];
      float const z_m = sight.depth_m[{u, v}];
      if (!is_stuff(label) || !(z_m > 0.0F)) {
        continue;
      }
      SeenCluster& cluster = clusters.at(label - std::size_t{kFirstStuff});
      Pixel const pixel = sight.middle_of({u, v});
      Eigen::Vector3f const p_camera((static_cast<float>(pixel.u) - cx) * z_m / fx,
                                     (static_cast<float>(pixel.v) - cy) * z_m / fy, z_m);
      cluster.blocks.push_back(sight.labels.index({u, v}));
      cluster.points_world.push_back(R * p_camera + t);
      cluster.area_m2 += static_cast<double>(z_m) * static_cast<double>(z_m) * block_area;
    }
  }
  return clusters;
}

std::vector<Move> moves(std::vector<StuffBelief> const& stuff, std::vector<StuffLook> const& looks,
                        std::vector<SeenCluster> const& clusters, std::span<FreeCluster const> free,
                        Look const& now) {
  struct Candidate {
    double misfit_m;
    Move move;
  };
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < stuff.size(); ++i) {
    if (stuff[i].label || stuff[i].model == nullptr) {
      continue;
    }
    for (FreeCluster const& place : free) {
      SeenCluster const& cluster = clusters[place.cluster];
      std::optional<double> misfit_m = stuff[i].verdict == Verdict::kSurelyGone
                                           ? fit_of(stuff[i], cluster, now.camera_world)
                                           : std::nullopt;
      if (!misfit_m && makes_way_for(stuff[i], looks[i], place)) {
        misfit_m = way_to(stuff[i], cluster);
      }
      bool const set_out = !misfit_m;
      if (set_out) {
        misfit_m = way_since_seen(stuff[i], looks[i], cluster, place, now.stamp_ns);
      }
      if (misfit_m) {
        candidates.push_back({*misfit_m, {i, place.cluster, set_out}});
      }
    }
  }
  std::ranges::stable_sort(candidates, {}, &Candidate::misfit_m);
  std::vector<Move> found;
  for (Candidate const& candidate : candidates) {
    bool const taken = std::ranges::any_of(found, [&](Move const& other) {
      return other.item == candidate.move.item || other.cluster == candidate.move.cluster;
    });
    if (!taken) {
      found.push_back(candidate.move);
    }
  }
  return found;
}

SeenCluster without_thing(SeenCluster const& cluster, std::size_t item,
                          Grid<std::int32_t> const& owners) {
  SeenCluster rest = cluster;
  rest.blocks.clear();
  rest.points_world.clear();
  for (std::size_t k = 0; k < cluster.blocks.size(); ++k) {
    if (owners[cluster.blocks[k]] != static_cast<std::int32_t>(item)) {
      rest.blocks.push_back(cluster.blocks[k]);
      rest.points_world.push_back(cluster.points_world[k]);
    }
  }
  auto const all = static_cast<double>(std::max<std::size_t>(cluster.blocks.size(), 1));
  double const part = static_cast<double>(rest.blocks.size()) / all;
  rest.area_m2 *= part;
  rest.pixel_count = static_cast<std::size_t>(part * static_cast<double>(cluster.pixel_count));
  return rest;
}

bool may_have_walked_to(StuffBelief const& item, StuffLook const& look, std::size_t cluster,
                        SeenCluster const& rest) {
  return is_on_its_way(item) && makes_way_for(item, look, {cluster, false}) &&
         way_to(item, rest).has_value();
}

bool has_moved(PointCounts const& look) {
  int const through = look[PointState::kSeenThrough];
  return through > kMostThroughSeen * (through + look[PointState::kAgrees]);
}

void count_look(StuffBelief& item, bool moved) {
  ++item.history_count;
  auto const looks = static_cast<double>(std::min(item.history_count, kLooksRemembered));
  item.moved_share += ((moved ? 1.0 : 0.0) - item.moved_share) / looks;
}

bool is_on_its_way(StuffBelief const& item) {
  return item.history_count >= kFewestLooks && moves_often(item);
}

void count_arrival(StuffBelief& item) {
  item.moved_share = kMovesOften;
}

void lose_sight_of(StuffBelief& item, double elapsed_s, ExistenceConfig const& config) {
  double const stayed = std::exp(-elapsed_s / kTimeOnItsWay_s);
  double const left = log_odds_of(probability_of(item.log_odds) * stayed);
  add_step(item.log_odds, left - item.log_odds, item.why, config);
}

}  // namespace credo
