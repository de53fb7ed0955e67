#include "stages/fusion/stuff_looks.hpp"

#include <algorithm>
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

}  // namespace

StuffLooks::StuffLooks(Sight const& sight, Se3 const& T_world_camera,
                       std::vector<StuffBelief> const& stuff)
    : view_(sight, T_world_camera),
      owners_(sight.depth_m.width(), sight.depth_m.height(), -1),
      owner_distance_m_(sight.depth_m.width(), sight.depth_m.height(),
                        std::numeric_limits<float>::infinity()),
      marked_by_(sight.depth_m.width(), sight.depth_m.height(), -1) {
  std::size_t places = 2;
  for (LabelCode const label : sight.labels) {
    places = std::max(places, place_of(label) + 1);
  }
  share_of_label_.assign(places, -1);
  looks_.reserve(stuff.size());
  for (StuffBelief const& item : stuff) {
    looks_.push_back(look_at(*item.model, static_cast<std::int32_t>(looks_.size())));
  }
}

ClusterShare& StuffLooks::share_of(LabelCode label, StuffLook& look) {
  std::int32_t& place = share_of_label_[place_of(label)];
  if (place < 0) {
    place = static_cast<std::int32_t>(look.shares.size());
    look.shares.push_back({.label = share_label(label)});
  }
  return look.shares[static_cast<std::size_t>(place)];
}

// A point stands for the surface around it, as far as the next one.
void StuffLooks::mark_around(Pixel block, float point_m, float spacing_m, std::int32_t item,
                             StuffLook& look) {
  auto const radius =
      static_cast<int>(std::lround(spacing_m * view_.focal_blocks() / (2.0F * point_m)));
  float const tolerance_m = agreement_m(point_m);
  for (int v = block.v - radius; v <= block.v + radius; ++v) {
    for (int u = block.u - radius; u <= block.u + radius; ++u) {
      if (!view_.sight().depth_m.contains({u, v}) || marked_by_[{u, v}] == item) {
        continue;
      }
      float const distance_m = std::abs(view_.sight().depth_m[{u, v}] - point_m);
      if (distance_m >= tolerance_m) {
        continue;
      }
      marked_by_[{u, v}] = item;
      ++look.blocks;
      ++share_of(view_.sight().labels[{u, v}], look).blocks;
      if (distance_m < owner_distance_m_[{u, v}]) {
        owner_distance_m_[{u, v}] = distance_m;
        owners_[{u, v}] = item;
      }
    }
  }
}

StuffLook StuffLooks::look_at(StuffModel const& model, std::int32_t item) {
  StuffLook look;
  look.points.resize(model.points.size());
  for (std::size_t i = 0; i < model.points.size(); ++i) {
    PointLook& point = look.points[i];
    Eigen::Vector3f const p_camera = view_.in_camera(model.points[i].p_world);
    if (std::optional<Pixel> const block = view_.block_of(p_camera)) {
      float const measured_m = view_.sight().depth_m[*block];
      point.block = static_cast<std::int32_t>(view_.sight().depth_m.index(*block));
      point.state = state_of(p_camera.z(), measured_m, view_.sight().nearest_m[*block]);
      if (point.state == PointState::kAgrees) {
        ++share_of(view_.sight().labels[*block], look).agreeing;
        mark_around(*block, p_camera.z(), model.spacing_m, item, look);
      } else if (point.state == PointState::kOccluded && measured_m < p_camera.z()) {
        ++share_of(view_.sight().labels[*block], look).hidden;
      }
    }
    ++look.counts[point.state];
  }
  for (ClusterShare const& share : look.shares) {
    share_of_label_[place_of(share.label)] = -1;
  }
  std::ranges::sort(look.shares, {}, &ClusterShare::label);
  return look;
}

}  // namespace credo
