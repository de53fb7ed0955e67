#include "stages/fusion/stuff/looks.hpp"

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace credo {
namespace {

/// The name of the share that a label's blocks count for: clusters have their own, floor, walls and
/// known objects have one, and so has the rest.
LabelCode share_label(LabelCode label) {
  return is_stuff(label) ? label : label >= kFloor ? kFloor : kNoDepth;
}

/// Where the share of that name is found.
std::size_t place_of(LabelCode label) {
  return is_stuff(label) ? label - kFirstStuff + std::size_t{2} : label >= kFloor ? 1 : 0;
}

/// Of what is not negative, halves upward, as std::lround has it, which is a call.
int nearest_integer(float value) {
  auto const below = static_cast<int>(value);
  return below + (value - static_cast<float>(below) >= 0.5F ? 1 : 0);
}

/// What of the thing that is looked at falls on a cluster.
ClusterShare& share_of(LabelCode label, StuffLook& look, std::vector<std::int32_t>& places) {
  std::int32_t& place = places[place_of(label)];
  if (place < 0) {
    place = static_cast<std::int32_t>(look.shares.size());
    look.shares.push_back({.label = share_label(label)});
  }
  return look.shares[static_cast<std::size_t>(place)];
}

}  // namespace

StuffLooks::StuffLooks(Sight const& sight, Se3 const& T_world_camera,
                       std::vector<StuffBelief> const& stuff)
    : view_(sight, T_world_camera),
      looks_(stuff.size()),
      owners_(sight.depth_m.width(), sight.depth_m.height(), -1) {
  std::size_t places = 2;
  for (LabelCode const label : sight.labels) {
    places = std::max(places, place_of(label) + 1);
  }
  int const width = sight.depth_m.width();
  int const height = sight.depth_m.height();
  tbb::enumerable_thread_specific<Desk> desks([&] {
    return Desk{{width, height, -1}, std::vector<std::int32_t>(places, -1), {}, {}};
  });
  std::vector<std::vector<Claim>> claims(stuff.size());
  // What this waits for is its own, never another frame's work.
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(std::size_t{0}, stuff.size(), [&](std::size_t i) {
      Desk& desk = desks.local();
      desk.claims.clear();
      looks_[i] = look_at(stuff[i], static_cast<std::int32_t>(i), desk);
      claims[i] = desk.claims;
    });
  });
  // In the belief's order: of two that fit a block equally well it is the first one's.
  Grid<float> owner_distance_m(width, height, std::numeric_limits<float>::infinity());
  for (std::size_t i = 0; i < claims.size(); ++i) {
    for (Claim const& claim : claims[i]) {
      if (claim.distance_m < owner_distance_m[claim.block]) {
        owner_distance_m[claim.block] = claim.distance_m;
        owners_[claim.block] = static_cast<std::int32_t>(i);
      }
    }
  }
}

// A point stands for the surface around it, as far as the next one.
void StuffLooks::mark_around(Pixel block, float point_m, float spacing_m, std::int32_t item,
                             StuffLook& look, Desk& desk) const {
  Sight const& sight = view_.sight();
  int const radius = nearest_integer(spacing_m * view_.focal_blocks() / (2.0F * point_m));
  float const tolerance_m = agreement_m(point_m);
  int const last_u = std::min(block.u + radius, sight.depth_m.width() - 1);
  int const last_v = std::min(block.v + radius, sight.depth_m.height() - 1);
  for (int v = std::max(block.v - radius, 0); v <= last_v; ++v) {
    for (int u = std::max(block.u - radius, 0); u <= last_u; ++u) {
      std::size_t const place = sight.depth_m.index({u, v});
      float const distance_m = std::abs(sight.depth_m[place] - point_m);
      if (distance_m >= tolerance_m || desk.marked_by[place] == item) {
        continue;
      }
      desk.marked_by[place] = item;
      ++look.blocks;
      ++share_of(sight.labels[place], look, desk.share_of_label).blocks;
      desk.claims.push_back({place, distance_m});
    }
  }
}

StuffLook StuffLooks::look_at(StuffBelief const& thing, std::int32_t item, Desk& desk) const {
  StuffModel const& model = *thing.model;
  Sight const& sight = view_.sight();
  StuffLook look;
  if (view_.is_out_of_view(thing.latest().bounds_world)) {
    look.counts[PointState::kOutOfView] = static_cast<int>(model.points.size());
    return look;
  }
  look.points.resize(model.points.size());
  desk.depths_m.resize(model.points.size());
  for (std::size_t i = 0; i < model.points.size(); ++i) {
    Eigen::Vector3f const p_camera = view_.in_camera(model.points[i].p_world);
    desk.depths_m[i] = p_camera.z();
    if (std::optional<Pixel> const block = view_.block_of(p_camera)) {
      std::size_t const place = sight.depth_m.index(*block);
      look.points[i] = {state_of(p_camera.z(), sight.depth_m[place], sight.nearest_m[place]),
                        static_cast<std::int32_t>(place)};
    }
    ++look.counts[look.points[i].state];
  }
  share_out(model.spacing_m, item, look, desk);
  return look;
}

void StuffLooks::share_out(float spacing_m, std::int32_t item, StuffLook& look, Desk& desk) const {
  Sight const& sight = view_.sight();
  for (std::size_t i = 0; i < look.points.size(); ++i) {
    PointLook const& point = look.points[i];
    float const point_m = desk.depths_m[i];
    auto const place = static_cast<std::size_t>(point.block);
    if (point.state == PointState::kAgrees) {
      ++share_of(sight.labels[place], look, desk.share_of_label).agreeing;
      mark_around(sight.depth_m.pixel(place), point_m, spacing_m, item, look, desk);
    } else if (point.state == PointState::kOccluded && sight.depth_m[place] < point_m) {
      ++share_of(sight.labels[place], look, desk.share_of_label).hidden;
    }
  }
  for (ClusterShare const& share : look.shares) {
    desk.share_of_label[place_of(share.label)] = -1;
  }
  std::ranges::sort(look.shares, {}, &ClusterShare::label);
}

}  // namespace credo
