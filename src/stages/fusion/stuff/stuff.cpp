#include "stages/fusion/stuff/stuff.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

#include "stages/fusion/stuff/matching.hpp"

namespace credo {
namespace {

bool shows_something(StuffCluster const& cluster) {
  return !cluster.points_world.empty() && cluster.centroid_world.allFinite() &&
         !cluster.bounds_world.isEmpty();
}

/// As seen or not seen in this frame, and before.
void believe(StuffBelief& item, Evidence before, double news, ExistenceConfig const& config) {
  ExistenceConfig unbounded = config;
  unbounded.max_log_odds = 0.0;
  double const log_odds = updated_log_odds(item.log_odds, before, item.evidence, news, unbounded);
  bool const changed = (item.evidence == Evidence::kSeen) != (before == Evidence::kSeen);
  double const bounded = bounded_log_odds(log_odds, config);
  item.why = {};
  item.why.news = changed ? 1.0 : news;
  item.why.moved = bounded - item.log_odds;
  item.why.bounded = bounded != log_odds;
  item.log_odds = bounded;
}

void append(StuffBelief& item, StuffCluster const& cluster, StuffFusionConfig const& config) {
  item.recent_clusters.push_back(std::make_shared<StuffCluster const>(cluster));
  ++item.history_count;
  if (item.recent_clusters.size() > static_cast<std::size_t>(config.kept_clusters)) {
    item.recent_clusters.erase(item.recent_clusters.begin());
  }
  item.label = cluster.label;
}

std::vector<std::optional<std::size_t>> matches_of(std::vector<StuffBelief> const& stuff,
                                                   std::vector<StuffCluster> const& seen,
                                                   StuffFusionConfig const& config) {
  std::vector<StuffCluster const*> latest;
  latest.reserve(stuff.size());
  for (StuffBelief const& item : stuff) {
    latest.push_back(&item.latest());
  }
  return match_clusters(latest, seen, config);
}

}  // namespace

FusedStuff fused_stuff(FusedStuff known, std::vector<StuffCluster> const& seen,
                       ViewChange const& change, FusionConfig const& config) {
  std::vector<StuffBelief>& stuff = known.stuff;
  std::vector<std::optional<std::size_t>> const matches = matches_of(stuff, seen, config.stuff);
  std::vector<bool> is_new(seen.size(), true);
  for (std::size_t i = 0; i < stuff.size(); ++i) {
    StuffBelief& item = stuff[i];
    double const news =
        novelty(change, item.latest().centroid_world.cast<double>(), config.existence);
    Evidence const before = std::exchange(item.evidence, Evidence::kNotSeen);
    item.label.reset();
    if (std::optional<std::size_t> const match = matches[i]) {
      append(item, seen[*match], config.stuff);
      item.evidence = Evidence::kSeen;
      is_new[*match] = false;
    }
    believe(item, before, news, config.existence);
  }
  std::erase_if(stuff, [&](StuffBelief const& item) {
    return probability_of(item.log_odds) < config.existence.min_probability;
  });
  for (std::size_t j = 0; j < seen.size(); ++j) {
    if (is_new[j] && shows_something(seen[j])) {
      StuffBelief& item = stuff.emplace_back();
      item.id = known.next_id++;
      item.log_odds = log_odds_of(config.prior_probability);
      item.why.news = 1.0;
      append(item, seen[j], config.stuff);
    }
  }
  return known;
}

}  // namespace credo
