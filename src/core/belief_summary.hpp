#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/belief.hpp"

namespace credo {

// The belief in numbers, without its points: what files and topics tell of it. World frame.
// `why` is missing in files that older versions wrote; log-odds there are those of the probability.

struct FloorSummary {
  /// Unit, up.
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double height_m = 0.0;
  std::uint64_t point_count = 0;
  // Not told, either, where `why` is missing.
  double probability = 0.5;
  double log_odds = 0.0;
  Evidence evidence = Evidence::kNotSeen;
  std::optional<Account> why;
};

struct WallSummary {
  std::uint32_t id = 0;
  Eigen::Vector2d segment_start_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d segment_end_m = Eigen::Vector2d::Zero();
  /// Unit.
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
  std::uint64_t point_count = 0;
  std::optional<LabelCode> label;
  // Not told, either, where `why` is missing.
  double probability = 0.5;
  double log_odds = 0.0;
  Evidence evidence = Evidence::kNotSeen;
  std::optional<Account> why;
};

struct ObjectSummary {
  std::string id;
  std::string type;
  double probability = 0.0;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  /// In the convention of boxplus; symmetric to the last bit.
  Matrix6d covariance = Matrix6d::Zero();
  Evidence evidence = Evidence::kNotSeen;
  std::optional<LabelCode> label;
  double log_odds = 0.0;
  std::optional<Account> why;
};

struct StuffSummary {
  std::uint32_t id = 0;
  double probability = 0.0;
  std::uint64_t history_count = 0;
  // Of the latest cluster.
  std::uint64_t pixel_count = 0;
  Eigen::Vector3f centroid_m = Eigen::Vector3f::Zero();
  Eigen::Vector3f min_m = Eigen::Vector3f::Zero();
  Eigen::Vector3f max_m = Eigen::Vector3f::Zero();
  Evidence evidence = Evidence::kSeen;
  std::optional<LabelCode> label;
  double log_odds = 0.0;
  std::optional<Account> why;
  /// Things that became one with it in this frame.
  std::vector<std::uint32_t> joined_ids;
};

struct BeliefSummary {
  FrameIndex frame = kPriorFrame;
  std::int64_t stamp_ns = 0;
  FrameIndex segmented_with = kPriorFrame;
  Eigen::Matrix4d T_world_camera = Eigen::Matrix4d::Identity();
  std::optional<FloorSummary> floor;
  std::vector<WallSummary> walls;
  std::vector<ObjectSummary> objects;
  std::vector<StuffSummary> stuff;
};

[[nodiscard]] BeliefSummary summary_of(BeliefState const& belief);

}  // namespace credo
