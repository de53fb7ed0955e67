#include "stages/fusion/stuff/learning.hpp"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "stages/fusion/stuff/model.hpp"
#include "stages/fusion/stuff/split.hpp"

namespace credo {
namespace {

constexpr double kKnown = 0.8;

/// Whether a block shows another thing that is believed to be there: of those before the item in
/// the belief what is believed after the frame counts, of those behind it what was before.
bool is_anothers(std::size_t block, std::size_t item, Lesson const& lesson) {
  std::int32_t const owner = lesson.looks.owners()[block];
  if (owner < 0 || owner == static_cast<std::int32_t>(item)) {
    return false;
  }
  auto const other = static_cast<std::size_t>(owner);
  return (other < item ? lesson.stuff[other].log_odds : lesson.log_odds_before[other]) > 0.0;
}

/// The points of a cluster that are not another thing's.
void append_own_points(SeenCluster const& cluster, std::size_t item, Lesson const& lesson,
                       std::vector<Eigen::Vector3f>& points_world) {
  for (std::size_t k = 0; k < cluster.blocks.size(); ++k) {
    if (!is_anothers(cluster.blocks[k], item, lesson)) {
      points_world.push_back(cluster.points_world[k]);
    }
  }
}

void learn_anew(FoundThing const& found, StuffBelief& item, Lesson const& lesson) {
  SeenCluster all;
  for (LabelCode const label : found.labels) {
    SeenCluster const& cluster = lesson.clusters[label - std::size_t{kFirstStuff}];
    append_own_points(cluster, found.item, lesson, all.points_world);
    all.area_m2 += cluster.area_m2;
    all.pixel_count += cluster.pixel_count;
  }
  begin_model(item, all);
}

/// Whether most of what a thing shows in beside its main cluster was seen of it before. Else it may
/// be another thing that comes into view beside it, and would be learnt strip by strip.
bool is_known(StuffLook const& look, LabelCode label, SeenCluster const& cluster) {
  auto const share = std::ranges::find(look.shares, label, &ClusterShare::label);
  return share != look.shares.end() &&
         share->blocks >= kKnown * static_cast<double>(cluster.blocks.size());
}

void learn(FoundThing& found, StuffBelief& item, Lesson const& lesson) {
  if (found.is_elsewhere) {
    learn_anew(found, item, lesson);
    return;
  }
  StuffLook const& look = lesson.looks.looks()[found.item];
  StuffModel model = *item.model;
  count_misses(model, look, lesson.shown, found.labels, found.news);
  // Points are as in the look until they are carved.
  SplitModel parted =
      split_model(std::move(model), look, lesson.shown, *item.label, found.labels, found.news);
  found.parts = std::move(parted.parts);
  for (LabelCode const part : found.parts) {
    std::erase(found.labels, part);
  }
  std::size_t pixels = 0;
  std::vector<Eigen::Vector3f> points_world;
  for (LabelCode const label : found.labels) {
    SeenCluster const& cluster = lesson.clusters[label - std::size_t{kFirstStuff}];
    if (label == *item.label || is_known(look, label, cluster)) {
      append_own_points(cluster, found.item, lesson, points_world);
    }
    pixels += cluster.pixel_count;
  }
  set_model(item, fused_model(carved_model(std::move(parted.model)), points_world), pixels);
}

}  // namespace

void learn_of(std::vector<FoundThing>& found, std::vector<StuffBelief>& stuff,
              Lesson const& lesson) {
  // What this waits for is its own, never another frame's work.
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(std::size_t{0}, found.size(),
                      [&](std::size_t k) { learn(found[k], stuff[found[k].item], lesson); });
  });
}

void set_model(StuffBelief& item, StuffModel model, std::size_t pixel_count) {
  item.recent_clusters = {std::make_shared<StuffCluster const>(
      cluster_of(model, item.label.value_or(kFirstStuff), pixel_count))};
  item.model = std::make_shared<StuffModel const>(std::move(model));
}

void begin_model(StuffBelief& item, SeenCluster const& seen) {
  StuffModel model = new_model(seen.points_world, seen.area_m2);
  item.most_agreeing = static_cast<double>(model.points.size());
  // What became one with it stood where it was.
  item.names_kept.clear();
  set_model(item, std::move(model), seen.pixel_count);
}

}  // namespace credo
