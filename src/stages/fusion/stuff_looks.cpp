#include "stages/fusion/stuff_looks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace credo {
namespace {

/// The place of a label among clusters: 0 for all that is none.
std::size_t place_of(LabelCode label) {
  return is_stuff(label) ? label - kFirstStuff + std::size_t{1} : 0;
}

PointState state_of(float point_m, float measured_m, float nearest_m) {
  float const tolerance_m = agreement_m(point_m);
  if (!(measured_m > 0.0F)) {
    return PointState::kUnmeasured;
  }
  if (std::abs(measured_m - point_m) < tolerance_m) {
    return PointState::kAgrees;
  }
  return nearest_m > point_m + tolerance_m ? PointState::kSeenThrough : PointState::kOccluded;
}

}  // namespace

StuffLooks::StuffLooks(Sight const& sight, Se3 const& T_world_camera,
                       std::vector<StuffBelief> const& stuff)
    : sight_(sight),
      owners_(sight.depth_m.width(), sight.depth_m.height(), -1),
      owner_distance_m_(sight.depth_m.width(), sight.depth_m.height(),
                        std::numeric_limits<float>::infinity()),
      marked_by_(sight.depth_m.width(), sight.depth_m.height(), -1) {
  Se3 const T_camera_world = T_world_camera.inverse();
  R_camera_world_ = T_camera_world.rotation().toRotationMatrix().cast<float>();
  t_camera_world_ = T_camera_world.translation().cast<float>();
  std::size_t places = 1;
  for (LabelCode const label : sight.labels) {
    places = std::max(places, place_of(label) + 1);
  }
  share_of_label_.assign(places, -1);
  looks_.reserve(stuff.size());
  for (StuffBelief const& item : stuff) {
    looks_.push_back(look_at(*item.model, static_cast<std::int32_t>(looks_.size())));
  }
}

StuffLook StuffLooks::look_at(StuffModel const& model, std::int32_t item) {
  StuffLook look;
  look.points.resize(model.points.size());
  auto const fx = static_cast<float>(sight_.intrinsics.fx_px);
  auto const fy = static_cast<float>(sight_.intrinsics.fy_px);
  auto const cx = static_cast<float>(sight_.intrinsics.cx_px) + 0.5F;
  auto const cy = static_cast<float>(sight_.intrinsics.cy_px) + 0.5F;
  auto const block_px = static_cast<float>(sight_.block_px);
  auto const share_of = [&](LabelCode label) -> ClusterShare& {
    std::int32_t& place = share_of_label_[place_of(label)];
    if (place < 0) {
      place = static_cast<std::int32_t>(look.shares.size());
      look.shares.push_back({.label = is_stuff(label) ? label : LabelCode{0}});
    }
    return look.shares[static_cast<std::size_t>(place)];
  };
  for (std::size_t i = 0; i < model.points.size(); ++i) {
    PointLook& point = look.points[i];
    Eigen::Vector3f const p_camera = R_camera_world_ * model.points[i].p_world + t_camera_world_;
    if (p_camera.z() > 0.0F) {
      float const u = std::floor((fx * p_camera.x() / p_camera.z() + cx) / block_px);
      float const v = std::floor((fy * p_camera.y() / p_camera.z() + cy) / block_px);
      if (u >= 0.0F && v >= 0.0F && u < static_cast<float>(sight_.depth_m.width()) &&
          v < static_cast<float>(sight_.depth_m.height())) {
        Pixel const block{static_cast<int>(u), static_cast<int>(v)};
        point.block = static_cast<std::int32_t>(sight_.depth_m.index(block));
        point.state = state_of(p_camera.z(), sight_.depth_m[block], sight_.nearest_m[block]);
        ClusterShare& share = share_of(sight_.labels[block]);
        share.agreeing += point.state == PointState::kAgrees ? 1 : 0;
        share.hidden +=
            point.state == PointState::kOccluded && sight_.depth_m[block] < p_camera.z() ? 1 : 0;
        if (point.state == PointState::kAgrees) {
          auto const radius = static_cast<int>(
              std::lround(model.spacing_m * fx / (2.0F * block_px * p_camera.z())));
          for (int dv = -radius; dv <= radius; ++dv) {
            for (int du = -radius; du <= radius; ++du) {
              Pixel const beside{block.u + du, block.v + dv};
              if (!sight_.depth_m.contains(beside) || marked_by_[beside] == item) {
                continue;
              }
              float const distance_m = std::abs(sight_.depth_m[beside] - p_camera.z());
              if (distance_m >= agreement_m(p_camera.z())) {
                continue;
              }
              marked_by_[beside] = item;
              ++look.blocks;
              ++share_of(sight_.labels[beside]).blocks;
              if (distance_m < owner_distance_m_[beside]) {
                owner_distance_m_[beside] = distance_m;
                owners_[beside] = item;
              }
            }
          }
        }
      }
    }
    ++look.counts[static_cast<std::size_t>(point.state)];
  }
  for (ClusterShare const& share : look.shares) {
    share_of_label_[place_of(share.label)] = -1;
  }
  std::ranges::sort(look.shares, {}, &ClusterShare::label);
  return look;
}

}  // namespace credo
