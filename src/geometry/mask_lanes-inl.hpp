// What kernels do with masks of lanes, once per instruction set: Highway's per-target guard takes
// the place of #pragma once.
#if defined(CREDO_GEOMETRY_MASK_LANES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef CREDO_GEOMETRY_MASK_LANES_INL_HPP
#undef CREDO_GEOMETRY_MASK_LANES_INL_HPP
#else
#define CREDO_GEOMETRY_MASK_LANES_INL_HPP
#endif

#include <hwy/highway.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

HWY_BEFORE_NAMESPACE();
namespace credo::lanes::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Bit i is set where lane i is; of at most 64 lanes, all bits beyond are 0.
template <class D>
HWY_INLINE std::uint64_t bits_of(D d, hn::Mask<D> mask) {
  static_assert(std::endian::native == std::endian::little);
  constexpr std::size_t kMost = hn::MaxLanes(D());
  static_assert(kMost <= 64);
  // What was stored is loaded as it is, without a detour by single bytes.
  using Bits = std::conditional_t<
      (kMost <= 8), std::uint8_t,
      std::conditional_t<(kMost <= 16), std::uint16_t,
                         std::conditional_t<(kMost <= 32), std::uint32_t, std::uint64_t>>>;
  std::array<std::uint8_t, 8> bytes{};
  hn::StoreMaskBits(d, mask, bytes.data());
  Bits bits = 0;
  std::memcpy(&bits, bytes.data(), sizeof(bits));
  // Lanes that fill no byte leave the rest of it open.
  return hn::Lanes(d) < 8 ? bits & ((std::uint64_t{1} << hn::Lanes(d)) - 1) : bits;
}

/// Of `count` pixels, 64 a word: what `mask_at(i)` tells of pixel i and as many more as there are
/// lanes. It is asked of all pixels of the last word; bits from `count` on are 0.
template <class D, class MaskAt>
HWY_INLINE void store_bits(D d, std::size_t count, MaskAt const& mask_at, std::uint64_t* out) {
  constexpr std::size_t kWord = 64;
  for (std::size_t begin = 0; begin < count; begin += kWord) {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < kWord; i += hn::Lanes(d)) {
      bits |= bits_of(d, mask_at(begin + i)) << i;
    }
    std::size_t const left = count - begin;
    out[begin / kWord] = left < kWord ? bits & ((std::uint64_t{1} << left) - 1) : bits;
  }
}

/// Of whole numbers: sum + value where the mask is set, the sum elsewhere.
template <class M, class V>
HWY_INLINE V add_where(M mask, V sum, V value) {
#if HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
  // One instruction: masks have registers of their own.
  return hn::IfThenElse(mask, hn::Add(sum, value), sum);
#else
  return hn::Add(sum, hn::IfThenElseZero(mask, value));
#endif
}

/// Of whole numbers, `most` not below 0: the larger of most and value where the mask is set, most
/// elsewhere.
template <class M, class V>
HWY_INLINE V max_where(M mask, V most, V value) {
#if HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
  return hn::IfThenElse(mask, hn::Max(most, value), most);
#else
  return hn::Max(most, hn::IfThenElseZero(mask, value));
#endif
}

}  // namespace credo::lanes::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
