#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/belief.hpp"
#include "core/se3.hpp"
#include "core/sight.hpp"
#include "stages/fusion/sight_view.hpp"

namespace credo {

struct PointLook {
  PointState state = PointState::kOutOfView;
  /// Block that it lies on; -1 out of view.
  std::int32_t block = -1;
};

/// What of a thing falls on one cluster of the frame.
struct ClusterShare {
  /// Of the cluster; kFloor for floor, walls and known objects together, kNoDepth for the rest.
  LabelCode label = 0;
  /// Points that agree there, and that what is there hides.
  int agreeing = 0;
  int hidden = 0;
  /// Blocks of it that agree with the thing.
  int blocks = 0;

  [[nodiscard]] double agreement() const {
    return agreeing == 0 ? 0.0 : static_cast<double>(agreeing) / (agreeing + hidden);
  }
};

/// What a frame says of one thing.
struct StuffLook {
  /// Of the model's, in its order; none where all of it is out of view.
  std::vector<PointLook> points;
  PointCounts counts;
  /// Blocks that agree, each once.
  int blocks = 0;
  /// Clusters that it shares blocks or hidden points with, by ascending label.
  std::vector<ClusterShare> shares;
};

/// A frame, seen from which things are looked at.
class StuffLooks {
public:
  StuffLooks(Sight const& sight, Se3 const& T_world_camera, std::vector<StuffBelief> const& stuff);

  /// In the order of the belief.
  [[nodiscard]] std::vector<StuffLook> const& looks() const { return looks_; }
  /// Of each block the thing that fits it best, by its place in the belief; -1 where none does.
  [[nodiscard]] Grid<std::int32_t> const& owners() const { return owners_; }

private:
  /// A block that agrees with a thing, and by how much.
  struct Claim {
    std::size_t block = 0;
    float distance_m = 0.0F;
  };
  /// What one thread needs to look at one thing after the other.
  struct Desk {
    /// The last thing that marked a block.
    Grid<std::int32_t> marked_by;
    /// Of the thing that is looked at; places in its shares by label, -1 where there is none.
    std::vector<std::int32_t> share_of_label;
    std::vector<Claim> claims;
    /// Of its points, along the optical axis.
    std::vector<float> depths_m;
  };

  /// Claims are left on the desk.
  [[nodiscard]] StuffLook look_at(StuffBelief const& thing, std::int32_t item, Desk& desk) const;
  /// The clusters on which the points of a look fall.
  void share_out(float spacing_m, std::int32_t item, StuffLook& look, Desk& desk) const;
  void mark_around(Pixel block, float point_m, float spacing_m, std::int32_t item, StuffLook& look,
                   Desk& desk) const;

  SightView view_;
  std::vector<StuffLook> looks_;
  Grid<std::int32_t> owners_;
};

}  // namespace credo
