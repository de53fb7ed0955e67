#include "geometry/label_bits.hpp"

// This file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/label_bits.cpp"  // NOLINT(*-macro-usage): Highway
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#include "geometry/mask_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace credo::label_bits::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using lanes::HWY_NAMESPACE::bits_of;

/// Whole words of what `mask_at` tells, then one of what `is_at` tells of what is left.
template <class D, class MaskAt, class IsAt>
HWY_INLINE void mark(D d, std::size_t count, std::uint64_t* bits, MaskAt const& mask_at,
                     IsAt const& is_at) {
  std::size_t const whole = count - count % kWordBits;
  for (std::size_t begin = 0; begin < whole; begin += kWordBits) {
    std::uint64_t word = 0;
    for (std::size_t i = 0; i < kWordBits; i += hn::Lanes(d)) {
      word |= bits_of(d, mask_at(begin + i)) << i;
    }
    bits[begin / kWordBits] = word;
  }
  if (whole < count) {
    std::uint64_t word = 0;
    for (std::size_t i = whole; i < count; ++i) {
      word |= std::uint64_t{is_at(i)} << (i - whole);
    }
    bits[whole / kWordBits] = word;
  }
}

template <typename T>
HWY_INLINE void mark_different_lanes(T const* a, T const* b, std::size_t count,
                                     std::uint64_t* bits) {
  // At most so many lanes that a word holds them all.
  hn::CappedTag<T, 32> const d;
  mark(
      d, count, bits,
      [&](std::size_t i) HWY_ATTR { return hn::Ne(hn::LoadU(d, a + i), hn::LoadU(d, b + i)); },
      [&](std::size_t i) { return a[i] != b[i]; });
}

void different_segments(std::int32_t const* a, std::int32_t const* b, std::size_t count,
                        std::uint64_t* bits) {
  mark_different_lanes(a, b, count, bits);
}

void different_codes(LabelCode const* a, LabelCode const* b, std::size_t count,
                     std::uint64_t* bits) {
  mark_different_lanes(a, b, count, bits);
}

void equal_codes(LabelCode const* labels, LabelCode label, std::size_t count, std::uint64_t* bits) {
  hn::CappedTag<LabelCode, 32> const d;
  auto const wanted = hn::Set(d, label);
  mark(
      d, count, bits,
      [&](std::size_t i) HWY_ATTR { return hn::Eq(hn::LoadU(d, labels + i), wanted); },
      [&](std::size_t i) { return labels[i] == label; });
}

}  // namespace credo::label_bits::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace credo {
namespace label_bits {

HWY_EXPORT(different_segments);
HWY_EXPORT(different_codes);
HWY_EXPORT(equal_codes);

}  // namespace label_bits

void mark_different(std::int32_t const* a, std::int32_t const* b, std::size_t count,
                    std::uint64_t* bits) {
  HWY_DYNAMIC_DISPATCH(label_bits::different_segments)(a, b, count, bits);
}

void mark_different(LabelCode const* a, LabelCode const* b, std::size_t count,
                    std::uint64_t* bits) {
  HWY_DYNAMIC_DISPATCH(label_bits::different_codes)(a, b, count, bits);
}

void mark_equal(LabelCode const* labels, LabelCode label, std::size_t count, std::uint64_t* bits) {
  HWY_DYNAMIC_DISPATCH(label_bits::equal_codes)(labels, label, count, bits);
}

}  // namespace credo
#endif  // HWY_ONCE
