#include "stages/planes/plane_sample.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

namespace credo {
namespace {

/// Those in every `step`-th row, or, where rows do not end with a word, of as many words as hold
/// one.
CountedPixels in_every_row(CountedPixels const& pixels, std::size_t width, std::size_t step) {
  std::size_t const row_words = (width + PixelSet::kWordBits - 1) / PixelSet::kWordBits;
  std::span<std::uint64_t const> const words = pixels.pixels.words();
  CountedPixels some{PixelSet(words.size() * PixelSet::kWordBits), 0};
  for (std::size_t begin = 0; begin < words.size(); begin += step * row_words) {
    for (std::size_t w = begin; w < std::min(begin + row_words, words.size()); ++w) {
      some.insert(w, words[w]);
    }
  }
  return some;
}

}  // namespace

PlaneSearchPoints sample_of(CountedPixels const& pixels, std::size_t most,
                            OrganizedCloud const& cloud, NormalMap const& normals,
                            PlaneTolerance const& tolerance) {
  // As far apart across rows as along them: then a line of the cache holds several.
  double const points_per_sample =
      std::max(1.0, static_cast<double>(pixels.count) / static_cast<double>(most));
  CountedPixels const some = in_every_row(pixels, static_cast<std::size_t>(cloud.z.width()),
                                          static_cast<std::size_t>(std::sqrt(points_per_sample)));
  PlaneSearchPoints sample;
  sample.source.reserve(std::min(some.count, most));
  some.pixels.for_every((some.count + most - 1) / most, [&](std::size_t i) {
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
