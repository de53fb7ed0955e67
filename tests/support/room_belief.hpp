#pragma once

#include <cmath>
#include <cstdint>
#include <memory>

#include "core/belief.hpp"

namespace credo::test {

/// Points around a place, different for every frame.
inline PointList points_around(Eigen::Vector3f const& center, std::size_t count,
                               std::int64_t frame) {
  PointList points;
  points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    auto const turn = static_cast<float>(i) + 0.1F * static_cast<float>(frame);
    points.push_back(center + Eigen::Vector3f(std::cos(turn), std::sin(turn), 0.001F * turn));
  }
  return points;
}

/// A belief of the size of a real kitchen's after 500 frames: floor, four walls, 200 things, 41,000
/// points (half a megabyte on DDS).
inline BeliefState room_belief(std::int64_t frame) {
  BeliefState belief;
  belief.frame = FrameIndex{frame};
  belief.stamp_ns = frame * 33'333'333;
  FloorBelief floor;
  floor.points = std::make_shared<PointList>(points_around({0, 0, 0}, 4000, frame));
  belief.floor = floor;
  for (std::uint32_t id = 1; id <= 4; ++id) {
    WallBelief wall;
    wall.id = id;
    wall.points =
        std::make_shared<PointList>(points_around({static_cast<float>(id), 0, 1}, 1750, frame));
    belief.walls.push_back(wall);
  }
  for (std::uint32_t id = 1; id <= 200; ++id) {
    auto cluster = std::make_shared<StuffCluster>();
    cluster->pixel_count = 2000;
    cluster->points_world = points_around({0, static_cast<float>(id), 1}, 150, frame);
    StuffBelief stuff;
    stuff.id = id;
    stuff.history_count = 3;
    stuff.recent_clusters = {cluster};
    belief.stuff.push_back(stuff);
  }
  return belief;
}

}  // namespace credo::test
