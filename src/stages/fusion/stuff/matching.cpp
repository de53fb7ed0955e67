#include "stages/fusion/stuff/matching.hpp"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <utility>

#include "geometry/icp.hpp"
#include "geometry/thinning.hpp"

namespace credo {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// A cluster as ICP sees it.
struct Sample {
  PointList points;
  double spacing_m = 0.0;
};

/// Thinned until few enough; each spacing is sqrt 2 times the one before, where a surface has half
/// the cells. Spacings that would by far not do are left out. The grids are fixed in the world, so
/// that a thing that stands still is sampled alike each time; eight cells meet at the origin, so
/// that fewer than eight points may be out of reach.
Sample sampled(StuffCluster const& cluster, StuffFusionConfig const& config) {
  constexpr double kCoarser = std::numbers::sqrt2;
  auto const most = static_cast<std::size_t>(config.max_icp_points);
  Sample sample{cluster.points_world, config.point_spacing_m};
  for (std::size_t expected = sample.points.size(); expected > 4 * most; expected /= 2) {
    sample.spacing_m *= kCoarser;
  }
  while (sample.points.size() > most) {
    sample.points = thin_points(sample.points, static_cast<float>(sample.spacing_m));
    sample.spacing_m *= kCoarser;
  }
  return sample;
}

/// One candidate and its scores; lower is better, none where a limit is exceeded.
struct Pair {
  std::size_t known = 0;
  std::size_t seen = 0;
  std::optional<double> seen_to_known;
  std::optional<double> known_to_seen;

  [[nodiscard]] bool aligned() const { return seen_to_known && known_to_seen; }
};

std::vector<Pair> overlapping_pairs(std::span<StuffCluster const* const> known,
                                    std::span<StuffCluster const> seen, double margin_m) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < known.size(); ++i) {
    Eigen::AlignedBox3f box = known[i]->bounds_world;
    Eigen::Vector3f const margin = Eigen::Vector3f::Constant(static_cast<float>(margin_m));
    box.min() -= margin;
    box.max() += margin;
    for (std::size_t j = 0; j < seen.size(); ++j) {
      if (box.intersects(seen[j].bounds_world)) {
        pairs.push_back({i, j, std::nullopt, std::nullopt});
      }
    }
  }
  return pairs;
}

std::optional<double> score(Sample const& source, Sample const& target,
                            StuffFusionConfig const& config) {
  double const sampling_m = 0.5 * std::max(source.spacing_m, target.spacing_m);
  IcpConfig const icp{
      .max_iterations = config.max_icp_iterations,
      .min_step_m = config.min_icp_step_m,
      .max_rms_m = config.max_rms_m == 0.0 ? kNoLimit : config.max_rms_m + sampling_m,
      .max_displacement_m =
          config.max_displacement_m == 0.0 ? kNoLimit : config.max_displacement_m};
  std::optional<IcpAlignment> const alignment = align_icp(source.points, target.points, icp);
  if (!alignment) {
    return std::nullopt;
  }
  return alignment->sum_squared_m2;
}

/// Both ways, or none. The larger cluster goes first: where the two are not the same thing, it is
/// the one that does not fit.
void align_pair(Pair& pair, Sample const& known, Sample const& seen, bool known_first,
                StuffFusionConfig const& config) {
  auto& first = known_first ? pair.known_to_seen : pair.seen_to_known;
  auto& second = known_first ? pair.seen_to_known : pair.known_to_seen;
  first = known_first ? score(known, seen, config) : score(seen, known, config);
  if (first) {
    second = known_first ? score(seen, known, config) : score(known, seen, config);
  }
}

using Matches = std::vector<std::optional<std::size_t>>;

/// Thesis 4.3: those that are each the other's best.
Matches best_of_each_other(std::vector<Pair> const& pairs, std::size_t known_count,
                           std::span<StuffCluster const> seen) {
  std::vector<Pair const*> best_for_known(known_count, nullptr);
  std::vector<Pair const*> best_for_seen(seen.size(), nullptr);
  for (Pair const& pair : pairs) {
    Pair const*& of_known = best_for_known[pair.known];
    if (of_known == nullptr || *pair.seen_to_known < *of_known->seen_to_known ||
        (*pair.seen_to_known == *of_known->seen_to_known &&
         seen[pair.seen].label < seen[of_known->seen].label)) {
      of_known = &pair;
    }
    // Pairs come by ascending known cluster: of equals the first stays.
    Pair const*& of_seen = best_for_seen[pair.seen];
    if (of_seen == nullptr || *pair.known_to_seen < *of_seen->known_to_seen) {
      of_seen = &pair;
    }
  }
  Matches matches(known_count);
  for (std::size_t i = 0; i < known_count; ++i) {
    if (best_for_known[i] != nullptr &&
        best_for_seen[best_for_known[i]->seen] == best_for_known[i]) {
      matches[i] = best_for_known[i]->seen;
    }
  }
  return matches;
}

}  // namespace

std::vector<std::optional<std::size_t>> match_clusters(std::span<StuffCluster const* const> known,
                                                       std::span<StuffCluster const> seen,
                                                       StuffFusionConfig const& config) {
  std::vector<Pair> pairs = overlapping_pairs(known, seen, config.box_margin_m);
  // Those without a partner stay empty: most of what is out of view.
  std::vector<Sample> known_samples(known.size());
  std::vector<Sample> seen_samples(seen.size());
  for (Pair const& pair : pairs) {
    if (known_samples[pair.known].points.empty()) {
      known_samples[pair.known] = sampled(*known[pair.known], config);
    }
    if (seen_samples[pair.seen].points.empty()) {
      seen_samples[pair.seen] = sampled(seen[pair.seen], config);
    }
  }
  // Isolated: a thread that waits here must not take up another frame's work.
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(std::size_t{0}, pairs.size(), [&](std::size_t i) {
      Pair& pair = pairs[i];
      bool const known_first = known[pair.known]->bounds_world.diagonal().squaredNorm() >
                               seen[pair.seen].bounds_world.diagonal().squaredNorm();
      align_pair(pair, known_samples[pair.known], seen_samples[pair.seen], known_first, config);
    });
  });

  std::erase_if(pairs, [](Pair const& pair) { return !pair.aligned(); });
  return best_of_each_other(pairs, known.size(), seen);
}

}  // namespace credo
