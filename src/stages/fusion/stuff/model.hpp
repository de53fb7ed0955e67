#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/belief.hpp"
#include "core/segmentation.hpp"

namespace credo {

/// A thing as it is first seen: `area_m2` of it, facing the camera. Its points' spacing is a 25th
/// of its size, 8 to 40 mm.
[[nodiscard]] StuffModel new_model(std::span<Eigen::Vector3f const> points_world, double area_m2);

/// The model after one more look at these points: each moves the running mean of its cell, or is
/// the first of it. Beyond 4000 points the spacing grows.
[[nodiscard]] StuffModel fused_model(StuffModel const& model,
                                     std::span<Eigen::Vector3f const> points_world);

/// The cell so many farther along each axis of the grid than a cell of a model is.
[[nodiscard]] std::uint64_t neighbour_cell(std::uint64_t cell, std::int64_t dx, std::int64_t dy,
                                           std::int64_t dz);

/// A mean over so many looks, at most, follows what changes.
inline constexpr float kMostWeight = 12.0F;

/// Both as one, at the spacing of the first.
[[nodiscard]] StuffModel joined_model(StuffModel const& model, StuffModel const& other);

/// Without the points that were seen through too often; at least 20 stay, or as many as there are.
[[nodiscard]] StuffModel carved_model(StuffModel model);

/// Without the points that are marked; all of them stay where fewer than 20 would.
[[nodiscard]] StuffModel without(StuffModel model, std::span<std::uint8_t const> gone);

/// For whoever reads a belief: its points, their centroid and bounds.
[[nodiscard]] StuffCluster cluster_of(StuffModel const& model, LabelCode label,
                                      std::size_t pixel_count);

}  // namespace credo
