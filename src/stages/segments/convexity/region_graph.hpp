#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "stages/segments/convexity/labels.hpp"
#include "stages/segments/convexity/limits.hpp"
#include "stages/segments/convexity/surface_map.hpp"

namespace credo::segments {

/// A plane through points of one part, in a disc of the image: quanta over pixels from its centre.
struct DiscPlane {
  double mean_u = 0.0;
  double mean_v = 0.0;
  double mean_quanta = 0.0;
  double per_u = 0.0;
  double per_v = 0.0;
  double rms_quanta = 0.0;

  [[nodiscard]] double at(double u, double v) const {
    return mean_quanta + per_u * (u - mean_u) + per_v * (v - mean_v);
  }
};

/// A place on the border of two parts where planes could be fitted to both.
struct BorderSample {
  /// The pixel of the first part, and its neighbour in the second.
  std::ptrdiff_t at = 0;
  std::ptrdiff_t beside = 0;
  DiscPlane plane;
  DiscPlane plane_beside;
};

/// What is between two parts that touch.
struct Border {
  std::int32_t low = 0;
  std::int32_t high = 0;
  /// Pairs of neighbours, and those of them that a jump or a crease parts.
  std::uint32_t pairs = 0;
  std::uint32_t parted = 0;
  /// Samples, and those of them whose planes do not go on into each other.
  std::uint32_t samples = 0;
  std::uint32_t unlike = 0;
};

struct RegionGraph {
  /// By low, then high.
  std::vector<Border> borders;
  /// In the order of the raster.
  std::vector<BorderSample> samples;
  /// Pixels of each label; 0 for those without.
  std::vector<std::uint32_t> sizes;
};

[[nodiscard]] RegionGraph region_graph(SurfaceMap const& map, PartLabels const& labels,
                                       Limits const& limits);

}  // namespace credo::segments
