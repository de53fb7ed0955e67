#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace credo {

/// The numbers of a std::mt19937 of that seed, each made when it is drawn. That one makes 624 at
/// once, and who wants a dozen waits for all of them.
class FewDraws {
public:
  explicit FewDraws(std::uint32_t seed) { state_[0] = seed; }

  std::uint32_t operator()() {
    for (; seeded_ < kSize && seeded_ <= next_ + kShift; ++seeded_) {
      std::uint32_t const last = state_[seeded_ - 1];
      state_[seeded_] = 1812433253U * (last ^ (last >> 30U)) + static_cast<std::uint32_t>(seeded_);
    }
    std::uint32_t const mixed =
        (state_[next_] & 0x80000000U) | (state_[(next_ + 1) % kSize] & 0x7FFFFFFFU);
    std::uint32_t bits =
        state_[(next_ + kShift) % kSize] ^ (mixed >> 1U) ^ ((mixed & 1U) * 0x9908B0DFU);
    state_[next_] = bits;
    next_ = (next_ + 1) % kSize;
    bits ^= bits >> 11U;
    bits ^= (bits << 7U) & 0x9D2C5680U;
    bits ^= (bits << 15U) & 0xEFC60000U;
    return bits ^ (bits >> 18U);
  }

private:
  static constexpr std::size_t kSize = 624;
  static constexpr std::size_t kShift = 397;

  /// As far as it has been seeded.
  std::array<std::uint32_t, kSize> state_;
  std::size_t seeded_ = 1;
  /// The number that is drawn next takes this one's place.
  std::size_t next_ = 0;
};

}  // namespace credo
