#include "stages/fusion/stuff/joined_names.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "geometry/thinning.hpp"
#include "stages/fusion/findings.hpp"
#include "stages/fusion/points.hpp"
#include "stages/fusion/stuff/learning.hpp"
#include "stages/fusion/stuff/model.hpp"

namespace credo {
namespace {

// So much of the cluster lies where the thing was, as of clusters that go to a thing
// (cluster_owners.cpp): from elsewhere other sides of it show.
constexpr double kShareOfCluster = 0.3;
// As of things (findings.cpp).
constexpr double kShareThrough = 0.6;
constexpr int kLeastTold = 8;

/// The part of the cluster that lies where the thing was.
double share_there(SeenCluster const& seen, JoinedThing const& old, SightView const& view) {
  double const pitch_m =
      std::sqrt(seen.area_m2 / static_cast<double>(std::max<std::size_t>(seen.blocks.size(), 1)));
  double const wide_m = std::max(pitch_m, static_cast<double>(old.spacing_m));
  std::size_t there = 0;
  for (Eigen::Vector3f const& point : seen.points_world) {
    auto const near_m = static_cast<float>(
        wide_m + surface_tolerance_m(static_cast<double>(view.in_camera(point).squaredNorm())));
    there += std::ranges::any_of(*old.points_world, [&](Eigen::Vector3f const& was) {
      return (was - point).squaredNorm() <= near_m * near_m;
    });
  }
  return static_cast<double>(there) /
         static_cast<double>(std::max<std::size_t>(seen.points_world.size(), 1));
}

/// How many more of a thing's points the frame shows in the cluster than in all else; 0 where the
/// cluster is something else.
int lead_of(LabelCode label, SeenCluster const& seen, JoinedThing const& old,
            SightView const& view) {
  int here = 0;
  int elsewhere = 0;
  for (Eigen::Vector3f const& point : *old.points_world) {
    if (view.look_at(point) == PointState::kAgrees) {
      bool const shows = view.sight().labels[*view.block_of(view.in_camera(point))] == label;
      here += shows ? 1 : 0;
      elsewhere += shows ? 0 : 1;
    }
  }
  bool const enough = here >= kLeastTold && here > elsewhere;
  return enough && share_there(seen, old, view) > kShareOfCluster ? here - elsewhere : 0;
}

}  // namespace

void remember_name(StuffBelief& host, StuffBelief const& joined) {
  PointList points_world;
  points_world.reserve(joined.model->points.size());
  for (SurfacePoint const& point : joined.model->points) {
    points_world.push_back(point.p_world);
  }
  float spacing_m = joined.model->spacing_m;
  PointList thinned = points_world;
  while (thinned.size() > kMostPointsKept) {
    spacing_m *= 1.25F;
    thinned = thin_points(points_world, spacing_m);
  }
  std::vector<JoinedThing>& names = host.names_kept;
  names.insert(names.end(), joined.names_kept.begin(), joined.names_kept.end());
  names.push_back({joined.id, joined.history_count,
                   std::make_shared<PointList const>(std::move(thinned)), spacing_m});
  if (names.size() > kMostNamesKept) {
    names.erase(names.begin(), names.end() - static_cast<std::ptrdiff_t>(kMostNamesKept));
  }
}

void become_one(StuffBelief& first, StuffBelief const& second) {
  if (!first.label) {
    first.label = second.label;
    first.evidence = second.evidence;
    double const moved = first.why.moved;
    first.why = second.why;
    first.why.moved = moved;
  }
  raise_to(first, second.log_odds);
  remember_name(first, second);
  first.most_agreeing = std::max(first.most_agreeing, second.most_agreeing);
  set_model(first, joined_model(*first.model, *second.model),
            std::max(first.latest().pixel_count, second.latest().pixel_count));
  first.joined_ids.push_back(second.id);
  first.joined_ids.insert(first.joined_ids.end(), second.joined_ids.begin(),
                          second.joined_ids.end());
}

void forget_what_left(std::vector<StuffBelief>& stuff, SightView const& view) {
  for (StuffBelief& item : stuff) {
    std::erase_if(item.names_kept, [&](JoinedThing const& old) {
      int agreeing = 0;
      int through = 0;
      for (Eigen::Vector3f const& point : *old.points_world) {
        PointState const state = view.look_at(point);
        agreeing += state == PointState::kAgrees ? 1 : 0;
        through += state == PointState::kSeenThrough ? 1 : 0;
      }
      return agreeing + through >= kLeastTold && through > kShareThrough * (agreeing + through);
    });
  }
}

std::optional<JoinedThing> name_of_old(std::vector<StuffBelief>& stuff, LabelCode label,
                                       SeenCluster const& seen, SightView const& view) {
  std::vector<JoinedThing>* kept_by = nullptr;
  std::size_t place = 0;
  int most = 0;
  for (StuffBelief& item : stuff) {
    for (std::size_t k = 0; k < item.names_kept.size(); ++k) {
      JoinedThing const& old = item.names_kept[k];
      bool const is_told = std::ranges::find(item.joined_ids, old.id) != item.joined_ids.end();
      int const lead = is_told ? 0 : lead_of(label, seen, old, view);
      if (lead > most) {
        most = lead;
        kept_by = &item.names_kept;
        place = k;
      }
    }
  }
  if (kept_by == nullptr) {
    return std::nullopt;
  }
  JoinedThing name = std::move((*kept_by)[place]);
  kept_by->erase(kept_by->begin() + static_cast<std::ptrdiff_t>(place));
  return name;
}

}  // namespace credo
