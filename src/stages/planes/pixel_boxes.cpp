#include "stages/planes/pixel_boxes.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>

namespace credo {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Interval {
  float least = kInfinity;
  float greatest = -kInfinity;
};

/// Of the values that are not NaN.
Interval bounds_of(std::span<float const> values) {
  // Several at once, each in its lane, so that it vectorises.
  constexpr std::size_t kLanes = 16;
  std::array<float, kLanes> least;
  std::array<float, kLanes> greatest;
  least.fill(kInfinity);
  greatest.fill(-kInfinity);
  std::size_t i = 0;
  for (; i + kLanes <= values.size(); i += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      float const value = values[i + lane];
      least[lane] = value < least[lane] ? value : least[lane];
      greatest[lane] = value > greatest[lane] ? value : greatest[lane];
    }
  }
  for (; i < values.size(); ++i) {
    least[0] = values[i] < least[0] ? values[i] : least[0];
    greatest[0] = values[i] > greatest[0] ? values[i] : greatest[0];
  }
  return {*std::ranges::min_element(least), *std::ranges::max_element(greatest)};
}

}  // namespace

PixelBoxes::PixelBoxes(OrganizedCloud const& cloud) {
  constexpr std::size_t kBits = PixelSet::kWordBits;
  std::size_t const words = (cloud.size() + kBits - 1) / kBits;
  std::array<Grid<float> const*, 3> const grids = {&cloud.x, &cloud.y, &cloud.z};
  for (std::size_t axis = 0; axis < grids.size(); ++axis) {
    least_[axis].resize(words);
    greatest_[axis].resize(words);
    for (std::size_t w = 0; w < words; ++w) {
      std::size_t const begin = w * kBits;
      auto const [least, greatest] =
          bounds_of({grids[axis]->data() + begin, std::min(kBits, cloud.size() - begin)});
      least_[axis][w] = least;
      greatest_[axis][w] = greatest;
    }
  }
}

PixelSet PixelBoxes::near(Plane const& plane_camera, PixelSet const& among,
                          PlaneTolerance const& tolerance) const {
  // A pixel's distance is reckoned in floats, and so are the bounds of all distances in a box, by
  // the same steps. Rounding never swaps the greater and the smaller: the bounds hold to the bit.
  Eigen::Vector3f const normal = plane_camera.normal.cast<float>();
  auto const offset_m = static_cast<float>(plane_camera.offset_m);
  std::array<Axes::value_type const*, 3> low{};
  std::array<Axes::value_type const*, 3> high{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    bool const along = normal[static_cast<Eigen::Index>(axis)] >= 0.0F;
    low[axis] = along ? &least_[axis] : &greatest_[axis];
    high[axis] = along ? &greatest_[axis] : &least_[axis];
  }
  auto const distance_m = [&](auto const& corner, std::size_t w) {
    return normal.x() * (*corner[0])[w] + normal.y() * (*corner[1])[w] +
           normal.z() * (*corner[2])[w] - offset_m;
  };
  PixelSet result = among;
  std::span<std::uint64_t> const words = result.words();
  for (std::size_t w = 0; w < words.size(); ++w) {
    // Noise grows to both sides of one depth.
    float const limit_m =
        std::max(tolerance.distance_m(least_[2][w]), tolerance.distance_m(greatest_[2][w]));
    bool const far = (distance_m(low, w) > limit_m) | (distance_m(high, w) < -limit_m);
    words[w] &= far ? 0 : ~std::uint64_t{0};
  }
  return result;
}

}  // namespace credo
