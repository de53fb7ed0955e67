#include "stages/planes/plane_pixels.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

// This file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "stages/planes/plane_pixels.cpp"  // NOLINT(*-macro-usage): Highway
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#include "geometry/mask_lanes-inl.hpp"

#ifndef CREDO_STAGES_PLANES_PLANE_PIXELS_ONCE
#define CREDO_STAGES_PLANES_PLANE_PIXELS_ONCE
namespace credo::planes {

/// A plane in single precision, with its tolerance.
struct FloatPlane {
  float x, y, z, offset_m;
  PlaneTolerance tolerance;
};

/// Words of 64 pixels: where the first one's values begin, and which pixels are asked for.
struct Words {
  float const* point[3];
  float const* normal[3];
  std::uint64_t const* asked;
  std::size_t count;
};

}  // namespace credo::planes
#endif

HWY_BEFORE_NAMESPACE();
namespace credo::planes::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using lanes::HWY_NAMESPACE::bits_of;

using D = hn::CappedTag<float, 16>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

V dot(FloatPlane const& plane, float const* const arrays[3], std::size_t i) {
  D const d;
  V const x = hn::Mul(hn::Set(d, plane.x), hn::LoadU(d, arrays[0] + i));
  V const y = hn::Mul(hn::Set(d, plane.y), hn::LoadU(d, arrays[1] + i));
  V const z = hn::Mul(hn::Set(d, plane.z), hn::LoadU(d, arrays[2] + i));
  return hn::Add(hn::Add(x, y), z);
}

/// The same operations as PlaneTolerance::distance_m.
V tolerance_m(PlaneTolerance const& tolerance, V depth_m) {
  D const d;
  V const beyond_m = hn::Sub(depth_m, hn::Set(d, PlaneTolerance::kNearestM));
  V const noise_m =
      hn::Add(hn::Set(d, PlaneTolerance::kLeastNoiseM),
              hn::Mul(hn::Set(d, PlaneTolerance::kNoiseGrowthPerM), hn::Mul(beyond_m, beyond_m)));
  return hn::Max(hn::Set(d, tolerance.fixed_m),
                 hn::Mul(hn::Set(d, tolerance.noise_sigmas), noise_m));
}

/// Comparisons are false for invalid points.
std::uint64_t near_bits(FloatPlane const& plane, Words const& words, std::size_t begin) {
  D const d;
  std::uint64_t bits = 0;
  for (std::size_t lane = 0; lane < PixelSet::kWordBits; lane += hn::Lanes(d)) {
    std::size_t const i = begin + lane;
    V const limit_m = tolerance_m(plane.tolerance, hn::LoadU(d, words.point[2] + i));
    V const distance_m = hn::Sub(dot(plane, words.point, i), hn::Set(d, plane.offset_m));
    bits |= bits_of(d, hn::Le(hn::Abs(distance_m), limit_m)) << lane;
  }
  return bits;
}

/// False for normals that are NaN.
std::uint64_t turned_bits(FloatPlane const& plane, Words const& words, std::size_t begin) {
  D const d;
  std::uint64_t bits = 0;
  for (std::size_t lane = 0; lane < PixelSet::kWordBits; lane += hn::Lanes(d)) {
    V const cosine = hn::Abs(dot(plane, words.normal, begin + lane));
    bits |= bits_of(d, hn::Lt(cosine, hn::Set(d, plane.tolerance.min_cosine))) << lane;
  }
  return bits;
}

/// What only normals keep out goes to `turned`.
std::size_t mark_inliers(FloatPlane const& plane, Words const& words, std::uint64_t* inliers,
                         std::uint64_t* turned) {
  bool const by_angle = plane.tolerance.min_cosine > 0.0F;
  std::size_t count = 0;
  for (std::size_t w = 0; w < words.count; ++w) {
    std::size_t const begin = w * PixelSet::kWordBits;
    std::uint64_t bits = words.asked[w];
    // Most words lie far from the plane: their normals need not be fetched.
    bits = bits == 0 ? 0 : bits & near_bits(plane, words, begin);
    if (bits != 0 && by_angle) {
      turned[w] = bits & turned_bits(plane, words, begin);
      bits &= ~turned[w];
    }
    inliers[w] = bits;
    count += static_cast<std::size_t>(std::popcount(bits));
  }
  return count;
}

std::size_t mark_behind(FloatPlane const& plane, Words const& words, std::uint64_t* behind) {
  D const d;
  std::size_t count = 0;
  for (std::size_t w = 0; w < words.count; ++w) {
    std::uint64_t bits = 0;
    for (std::size_t lane = 0; words.asked[w] != 0 && lane < PixelSet::kWordBits;
         lane += hn::Lanes(d)) {
      std::size_t const i = w * PixelSet::kWordBits + lane;
      V const limit_m = tolerance_m(plane.tolerance, hn::LoadU(d, words.point[2] + i));
      V const distance_m = hn::Sub(dot(plane, words.point, i), hn::Set(d, plane.offset_m));
      bits |= bits_of(d, hn::Lt(distance_m, hn::Neg(limit_m))) << lane;
    }
    behind[w] = bits & words.asked[w];
    count += static_cast<std::size_t>(std::popcount(behind[w]));
  }
  return count;
}

}  // namespace credo::planes::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace credo {
namespace planes {

HWY_EXPORT(mark_inliers);
HWY_EXPORT(mark_behind);

namespace {

FloatPlane float_plane(Plane const& plane, PlaneTolerance const& tolerance) {
  return {static_cast<float>(plane.normal.x()), static_cast<float>(plane.normal.y()),
          static_cast<float>(plane.normal.z()), static_cast<float>(plane.offset_m), tolerance};
}

/// The pixels of an image as words for a kernel: all whole ones, and the last, filled up with NaN.
class WordsOf {
public:
  WordsOf(OrganizedCloud const& cloud, VectorGrid const& normals, PixelSet const& asked)
      : cloud_(cloud), normals_(normals), asked_(asked) {}

  [[nodiscard]] Words whole() const {
    return {{cloud_.x.data(), cloud_.y.data(), cloud_.z.data()},
            {normals_.x.data(), normals_.y.data(), normals_.z.data()},
            asked_.words().data(),
            whole_count()};
  }

  /// None where the pixels fill whole words.
  [[nodiscard]] Words last() {
    std::size_t const begin = whole_count() * PixelSet::kWordBits;
    std::array<Grid<float> const*, 6> const grids = {&cloud_.x,   &cloud_.y,   &cloud_.z,
                                                     &normals_.x, &normals_.y, &normals_.z};
    for (std::size_t k = 0; k < grids.size(); ++k) {
      last_[k].fill(kNaN);
      std::copy(grids[k]->begin() + static_cast<std::ptrdiff_t>(begin), grids[k]->end(),
                last_[k].begin());
    }
    return {{last_[0].data(), last_[1].data(), last_[2].data()},
            {last_[3].data(), last_[4].data(), last_[5].data()},
            asked_.words().data() + whole_count(),
            asked_.words().size() - whole_count()};
  }

private:
  [[nodiscard]] std::size_t whole_count() const { return cloud_.size() / PixelSet::kWordBits; }

  OrganizedCloud const& cloud_;
  VectorGrid const& normals_;
  PixelSet const& asked_;
  std::array<std::array<float, PixelSet::kWordBits>, 6> last_{};
};

}  // namespace
}  // namespace planes

PlanePixels plane_pixels(Plane const& plane_camera, OrganizedCloud const& cloud,
                         NormalMap const& normals, PixelSet const& among,
                         PlaneTolerance const& tolerance) {
  planes::FloatPlane const plane = planes::float_plane(plane_camera, tolerance);
  planes::WordsOf words(cloud, normals, among);
  PlanePixels found{{PixelSet(cloud.size()), 0}, PixelSet(cloud.size())};
  std::uint64_t* const bits = found.inliers.pixels.words().data();
  std::uint64_t* const turned = found.turned.words().data();
  planes::Words const whole = words.whole();
  found.inliers.count = HWY_DYNAMIC_DISPATCH(planes::mark_inliers)(plane, whole, bits, turned);
  found.inliers.count += HWY_DYNAMIC_DISPATCH(planes::mark_inliers)(
      plane, words.last(), bits + whole.count, turned + whole.count);
  return found;
}

CountedPixels plane_inliers(Plane const& plane_camera, OrganizedCloud const& cloud,
                            NormalMap const& normals, PixelSet const& among,
                            PlaneTolerance const& tolerance) {
  return plane_pixels(plane_camera, cloud, normals, among, tolerance).inliers;
}

CountedPixels pixels_behind(Plane const& plane_camera, OrganizedCloud const& cloud,
                            PixelSet const& among, PlaneTolerance const& tolerance) {
  planes::FloatPlane const plane = planes::float_plane(plane_camera, tolerance);
  planes::WordsOf words(cloud, cloud, among);
  CountedPixels behind{PixelSet(cloud.size()), 0};
  std::uint64_t* const bits = behind.pixels.words().data();
  planes::Words const whole = words.whole();
  behind.count = HWY_DYNAMIC_DISPATCH(planes::mark_behind)(plane, whole, bits);
  behind.count +=
      HWY_DYNAMIC_DISPATCH(planes::mark_behind)(plane, words.last(), bits + whole.count);
  return behind;
}

}  // namespace credo
#endif  // HWY_ONCE
