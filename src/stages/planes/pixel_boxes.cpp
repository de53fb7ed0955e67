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

void PixelBoxes::bound() const {
  if (!least_[0].empty()) {
    return;
  }
  OrganizedCloud const& cloud = *cloud_;
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

// A pixel's distance is reckoned in floats, and so are the bounds of all distances in a box, by the
// same steps. Rounding never swaps the greater and the smaller: the bounds hold to the bit.
class PixelBoxes::Distances {
public:
  Distances(PixelBoxes const& boxes, Plane const& plane_camera)
      : normal_(plane_camera.normal.cast<float>()),
        offset_m_(static_cast<float>(plane_camera.offset_m)) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bool const along = normal_[static_cast<Eigen::Index>(axis)] >= 0.0F;
      low_[axis] = (along ? boxes.least_ : boxes.greatest_)[axis].data();
      high_[axis] = (along ? boxes.greatest_ : boxes.least_)[axis].data();
    }
  }

  [[nodiscard]] float least_m(std::size_t word) const { return at(low_, word); }
  [[nodiscard]] float greatest_m(std::size_t word) const { return at(high_, word); }

private:
  using Corners = std::array<float const*, 3>;

  [[nodiscard]] float at(Corners const& corner, std::size_t word) const {
    return normal_.x() * corner[0][word] + normal_.y() * corner[1][word] +
           normal_.z() * corner[2][word] - offset_m_;
  }

  Eigen::Vector3f normal_;
  float offset_m_;
  Corners low_{};
  Corners high_{};
};

PixelSet PixelBoxes::near(Plane const& plane_camera, PixelSet const& among,
                          PlaneTolerance const& tolerance) const {
  bound();
  Distances const distances(*this, plane_camera);
  PixelSet result = among;
  std::span<std::uint64_t> const words = result.words();
  for (std::size_t w = 0; w < words.size(); ++w) {
    if (words[w] == 0) {
      continue;
    }
    // Noise grows to both sides of one depth.
    float const limit_m =
        std::max(tolerance.distance_m(least_[2][w]), tolerance.distance_m(greatest_[2][w]));
    if (distances.least_m(w) > limit_m || distances.greatest_m(w) < -limit_m) {
      words[w] = 0;
    }
  }
  return result;
}

PixelBoxes::Behind PixelBoxes::behind(Plane const& plane_camera, PixelSet const& among,
                                      PlaneTolerance const& tolerance) const {
  bound();
  Distances const distances(*this, plane_camera);
  std::span<std::uint64_t const> const asked = among.words();
  Behind result{{PixelSet(asked.size() * PixelSet::kWordBits), 0},
                PixelSet(asked.size() * PixelSet::kWordBits)};
  for (std::size_t w = 0; w < asked.size(); ++w) {
    if (asked[w] == 0) {
      continue;
    }
    // As above; and between the box' ends noise may be as little as at that one depth.
    float const most_m =
        std::max(tolerance.distance_m(least_[2][w]), tolerance.distance_m(greatest_[2][w]));
    float const least_m = tolerance.distance_m(std::max(least_[2][w], PlaneTolerance::kNearestM));
    if (distances.greatest_m(w) < -most_m) {
      result.certain.insert(w, asked[w]);
    } else if (distances.least_m(w) < -least_m) {
      result.open.words()[w] = asked[w];
    }
  }
  return result;
}

}  // namespace credo
#endif  // HWY_ONCE
