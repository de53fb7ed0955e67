#include "stages/planes/pixel_boxes.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>

// This file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "stages/planes/pixel_boxes.cpp"  // NOLINT(*-macro-usage): Highway
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace credo::planes::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using BoxLanes = hn::CappedTag<float, 16>;

/// The least and the greatest value of each word of 64 that is not NaN.
void bound_words(float const* values, std::size_t words, float* least, float* greatest) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  BoxLanes const d;
  for (std::size_t w = 0; w < words; ++w) {
    auto low = hn::Set(d, kInfinity);
    auto high = hn::Set(d, -kInfinity);
    for (std::size_t lane = 0; lane < PixelSet::kWordBits; lane += hn::Lanes(d)) {
      auto const value = hn::LoadU(d, values + w * PixelSet::kWordBits + lane);
      low = hn::IfThenElse(hn::Lt(value, low), value, low);
      high = hn::IfThenElse(hn::Gt(value, high), value, high);
    }
    least[w] = hn::GetLane(hn::MinOfLanes(d, low));
    greatest[w] = hn::GetLane(hn::MaxOfLanes(d, high));
  }
}

}  // namespace credo::planes::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace credo {
namespace planes {

HWY_EXPORT(bound_words);

}  // namespace planes

PixelBoxes::PixelBoxes(OrganizedCloud const& cloud) {
  constexpr std::size_t kBits = PixelSet::kWordBits;
  std::size_t const whole = cloud.size() / kBits;
  std::size_t const words = (cloud.size() + kBits - 1) / kBits;
  std::array<Grid<float> const*, 3> const grids = {&cloud.x, &cloud.y, &cloud.z};
  for (std::size_t axis = 0; axis < grids.size(); ++axis) {
    least_[axis].resize(words);
    greatest_[axis].resize(words);
    float const* const values = grids[axis]->data();
    float* const least = least_[axis].data();
    float* const greatest = greatest_[axis].data();
    HWY_DYNAMIC_DISPATCH(planes::bound_words)(values, whole, least, greatest);
    if (whole < words) {
      std::array<float, kBits> last;
      last.fill(kNaN);
      std::copy(values + whole * kBits, values + cloud.size(), last.begin());
      HWY_DYNAMIC_DISPATCH(planes::bound_words)
      (last.data(), 1, least + whole, greatest + whole);
    }
  }
}

PixelSet PixelBoxes::near(Plane const& plane_camera, PixelSet const& among,
                          PlaneTolerance const& tolerance) const {
  // A pixel's distance is reckoned in floats, and so are the bounds of all distances in a box, by
  // the same steps. Rounding never swaps the greater and the smaller: the bounds hold to the bit.
  Eigen::Vector3f const normal = plane_camera.normal.cast<float>();
  auto const offset_m = static_cast<float>(plane_camera.offset_m);
  std::array<float const*, 3> low{};
  std::array<float const*, 3> high{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    bool const along = normal[static_cast<Eigen::Index>(axis)] >= 0.0F;
    low[axis] = (along ? least_ : greatest_)[axis].data();
    high[axis] = (along ? greatest_ : least_)[axis].data();
  }
  auto const distance_m = [&](std::array<float const*, 3> const& corner, std::size_t w) {
    return normal.x() * corner[0][w] + normal.y() * corner[1][w] + normal.z() * corner[2][w] -
           offset_m;
  };
  PixelSet result = among;
  std::span<std::uint64_t> const words = result.words();
  for (std::size_t w = 0; w < words.size(); ++w) {
    if (words[w] == 0) {
      continue;
    }
    // Noise grows to both sides of one depth.
    float const limit_m =
        std::max(tolerance.distance_m(least_[2][w]), tolerance.distance_m(greatest_[2][w]));
    if (distance_m(low, w) > limit_m || distance_m(high, w) < -limit_m) {
      words[w] = 0;
    }
  }
  return result;
}

}  // namespace credo
#endif  // HWY_ONCE
