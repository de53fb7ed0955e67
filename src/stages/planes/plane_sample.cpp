#include "stages/planes/plane_sample.hpp"

#include <algorithm>
#include <cstdint>

namespace credo {

PlaneSearchPoints sample_of(CountedPixels const& pixels, std::size_t most,
                            OrganizedCloud const& cloud, NormalMap const& normals,
                            PlaneTolerance const& tolerance) {
  PlaneSearchPoints sample;
  sample.source.reserve(std::min(pixels.count, most));
  pixels.pixels.for_every((pixels.count + most - 1) / most, [&](std::size_t i) {
    sample.source.push_back(static_cast<std::uint32_t>(i));
  });
  // A column at a time: many loads are then under way at once.
  auto const column = [&](Grid<float> const& values, std::vector<float>& target) {
    target.resize(sample.source.size());
    for (std::size_t k = 0; k < target.size(); ++k) {
      target[k] = values[sample.source[k]];
    }
  };
  column(cloud.x, sample.x);
  column(cloud.y, sample.y);
  column(cloud.z, sample.z);
  column(normals.x, sample.normal_x);
  column(normals.y, sample.normal_y);
  column(normals.z, sample.normal_z);
  sample.tolerance_m.resize(sample.size());
  std::ranges::transform(sample.z, sample.tolerance_m.begin(),
                         [&](float depth_m) { return tolerance.distance_m(depth_m); });
  return sample;
}

}  // namespace credo
