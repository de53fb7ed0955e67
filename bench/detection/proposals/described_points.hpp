#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "detector/models/search_model.hpp"
#include "detector/scenes/search_scene.hpp"
#include "fpfh_settings.hpp"

namespace credo {

/// A point with its normal and the direction in which it bends most, unless it is about as flat or
/// as round in all directions.
struct BentPoint {
  Eigen::Vector3f point;
  /// Unit.
  Eigen::Vector3f normal;
  /// Unit, at right angles to the normal; its sign means nothing.
  Eigen::Vector3f bend;
  bool has_bend = false;
  /// Of the scene, from 1; 0 in a model.
  std::uint16_t segment = 0;
  /// Where it is in the image; nothing in a model.
  Pixel pixel;
};

/// Points and their fast point feature histograms (Rusu, Blodow and Beetz 2009), one a column.
struct DescribedPoints {
  std::vector<BentPoint> points;
  Eigen::MatrixXf features;
};

/// Of what some of a model's views show. Model frame.
[[nodiscard]] DescribedPoints described(SearchModel const& model, FpfhSettings const& settings);

/// Of all of a frame but its background. Camera frame.
[[nodiscard]] DescribedPoints described(SearchScene const& scene, FpfhSettings const& settings);

}  // namespace credo
