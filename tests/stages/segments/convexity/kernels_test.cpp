// Each kernel against a plain loop, on every instruction set of this machine.
#include "stages/segments/convexity/kernels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <vector>

#include "stages/segments/padded_grid.hpp"
#include "stages/segments/row_bits.hpp"
#include "support/instruction_sets.hpp"

namespace credo::segments {
namespace {

using Heights = PaddedGrid<std::int16_t>;
using Bytes = PaddedGrid<std::uint8_t>;

constexpr std::array<int, 9> kWidths = {1, 2, 15, 16, 31, 33, 64, 100, 323};
constexpr int kHeight = 5;

template <typename Check>
void for_each_size(Check const& check) {
  test::on_every_instruction_set([&] {
    for (int const width : kWidths) {
      SCOPED_TRACE(width);
      check(width);
    }
  });
}

/// What a kernel wrote: the row, and behind it room for one vector more and a guard.
template <typename T>
class Row {
public:
  explicit Row(int width) : width_(static_cast<std::size_t>(width)), data_(width_ + 80, kGuard) {}

  T* data() { return data_.data(); }
  [[nodiscard]] std::vector<T> values() const {
    EXPECT_TRUE(std::all_of(data_.begin() + static_cast<std::ptrdiff_t>(width_ + 64), data_.end(),
                            [](T value) { return value == kGuard; }));
    return {data_.begin(), data_.begin() + static_cast<std::ptrdiff_t>(width_)};
  }

private:
  static constexpr T kGuard = 77;
  std::size_t width_;
  std::vector<T> data_;
};

/// Of each column of the middle row.
template <typename T, typename Of>
std::vector<T> plain_row(int width, Of const& of) {
  std::vector<T> row;
  for (int u = 0; u < width; ++u) {
    row.push_back(static_cast<T>(of(u)));
  }
  return row;
}

template <typename T, typename Draw>
PaddedGrid<T> drawn(int width, Draw const& draw) {
  PaddedGrid<T> grid(width, kHeight);
  for (int v = 0; v < kHeight; ++v) {
    std::generate_n(grid.row(v), width, [&] { return static_cast<T>(draw()); });
  }
  return grid;
}

/// Of much the same height, with holes and a few that are very near.
Heights rough_surface(int width, int around, int scatter) {
  std::mt19937 random(static_cast<unsigned>(width + around));
  std::uniform_int_distribution<int> height(around - scatter, around + scatter);
  return drawn<std::int16_t>(width, [&]() -> int {
    unsigned const kind = random() % 16;
    return kind == 0 ? 0 : kind == 1 ? 32000 : std::clamp(height(random), 1, 32000);
  });
}

std::vector<Heights> surfaces(int width, int scatter) {
  std::vector<Heights> result;
  for (int const around : {50, 3000, 31990}) {
    result.push_back(rough_surface(width, around, scatter));
  }
  return result;
}

TEST(SegmentKernels, Disparity) {
  constexpr float kUnits_m = 5574.9F;
  constexpr float kOdd[] = {0.0F,
                            -1.0F,
                            std::numeric_limits<float>::quiet_NaN(),
                            std::numeric_limits<float>::infinity(),
                            -std::numeric_limits<float>::infinity(),
                            std::numeric_limits<float>::denorm_min(),
                            std::numeric_limits<float>::max(),
                            0.01F,
                            2e4F};
  for_each_size([&](int width) {
    std::mt19937 random(static_cast<unsigned>(width));
    std::uniform_real_distribution<float> depth(0.15F, 10.0F);
    std::vector<float> depth_m(static_cast<std::size_t>(width) + 64);
    std::generate(depth_m.begin(), depth_m.end(), [&] {
      return random() % 3 == 0 ? kOdd[random() % std::size(kOdd)] : depth(random);
    });
    Row<std::int16_t> out(width);
    disparity_row(depth_m.data(), static_cast<std::size_t>(width), kUnits_m, out.data());
    EXPECT_EQ(out.values(), plain_row<std::int16_t>(width, [&](int u) {
                float const z = depth_m[static_cast<std::size_t>(u)];
                bool const valid = z > 0.0F && std::isfinite(z);
                return valid ? static_cast<int>(std::min(kUnits_m / z, 32000.0F) + 0.5F) : 0;
              }));
  });
}

int plain_smooth(std::int16_t const* centre, std::ptrdiff_t stride, int radius, int limit) {
  int sum = 0;
  int count = 0;
  for (int v = -radius; v <= radius; ++v) {
    for (int u = -radius; u <= radius; ++u) {
      int const other = centre[v * stride + u];
      if (other > 0 && std::abs(other - *centre) < limit) {
        sum += other - *centre;
        ++count;
      }
    }
  }
  return *centre == 0 ? 0
                      : *centre + static_cast<int>(std::nearbyint(static_cast<float>(sum) /
                                                                  static_cast<float>(count)));
}

TEST(SegmentKernels, Smooth) {
  for_each_size([](int width) {
    for (Heights const& heights : surfaces(width, 150)) {
      for (auto const& [radius, limit] : {std::pair(1, 16), std::pair(2, 96), std::pair(8, 112)}) {
        Row<std::int16_t> out(width);
        smooth_row(heights.row(2), heights.stride(), radius, static_cast<std::int16_t>(limit),
                   static_cast<std::size_t>(width), out.data());
        EXPECT_EQ(out.values(), plain_row<std::int16_t>(width, [&](int u) {
                    return plain_smooth(heights.row(2) + u, heights.stride(), radius, limit);
                  }));
      }
    }
  });
}

TEST(SegmentKernels, SmoothHoldsTheSumOfTheLargestWindow) {
  // All of 289 pixels but one as far above it as they may be.
  for_each_size([](int width) {
    PaddedGrid<std::int16_t> heights(width, 17);
    for (int v = 0; v < 17; ++v) {
      std::fill_n(heights.row(v), width, std::int16_t{211});
    }
    heights.row(8)[width / 2] = 100;
    Row<std::int16_t> out(width);
    smooth_row(heights.row(8), heights.stride(), 8, 112, static_cast<std::size_t>(width),
               out.data());
    int const expected = plain_smooth(heights.row(8) + width / 2, heights.stride(), 8, 112);
    EXPECT_EQ(out.values()[static_cast<std::size_t>(width / 2)], expected);
    EXPECT_GE(expected, 204);
  });
}

/// Of the pairs at some offsets: the largest a + b - 2c, and |a - b|.
std::pair<int, int> plain_bend(std::int16_t const* centre, std::array<std::ptrdiff_t, 4> offsets,
                               int times, int limit) {
  std::pair<int, int> most{0, 0};
  int const c = *centre;
  for (std::ptrdiff_t const offset : offsets) {
    int const a = centre[times * offset];
    int const b = centre[-times * offset];
    if (a > 0 && b > 0 && c > 0 && std::abs(a - c) < limit && std::abs(b - c) < limit) {
      most = {std::max(most.first, a + b - 2 * c), std::max(most.second, std::abs(a - b))};
    }
  }
  return most;
}

TEST(SegmentKernels, Concavity) {
  for_each_size([](int width) {
    for (Heights const& heights : surfaces(width, 200)) {
      for (int const limit : {100, 240, 1600}) {
        std::array<std::ptrdiff_t, 4> const offsets = {
            6, 2 * heights.stride(), heights.stride() + 1, 2 - 2 * heights.stride()};
        ConcavityPairs const pairs{offsets, static_cast<std::int16_t>(limit), 21299};
        auto const bend = [&](int u) {
          std::int16_t const* const centre = heights.row(2) + u;
          auto const near = plain_bend(centre, offsets, 1, limit);
          int const far = plain_bend(centre, offsets, 2, limit).first;
          return std::pair(std::max(near.first, far * 21299 / 32768), near.second);
        };
        Row<std::int16_t> concavity(width);
        Row<std::int16_t> steepness(width);
        concavity_row(heights.row(2), pairs, static_cast<std::size_t>(width), concavity.data(),
                      steepness.data());
        EXPECT_EQ(concavity.values(),
                  plain_row<std::int16_t>(width, [&](int u) { return bend(u).first; }));
        EXPECT_EQ(steepness.values(),
                  plain_row<std::int16_t>(width, [&](int u) { return bend(u).second; }));
      }
    }
  });
}

TEST(SegmentKernels, Crease) {
  for_each_size([](int width) {
    std::mt19937 random(static_cast<unsigned>(width));
    Heights const concavity = drawn<std::int16_t>(width, [&] { return random() % 3199; });
    Heights const steepness = drawn<std::int16_t>(width, [&] { return random() % 3199; });
    for (Heights const& heights : surfaces(width, 150)) {
      for (CreaseLimits const limits :
           {CreaseLimits{36, 9557, 144}, CreaseLimits{0, 0, 16}, CreaseLimits{32000, 27307, 1600},
            CreaseLimits{1000, 27307, 144}}) {
        auto const is_wall = [&](int u) {
          int const allowed = limits.crease + ((steepness.row(2)[u] * limits.slope) >> 16);
          return heights.row(2)[u] > 0 && concavity.row(2)[u] > allowed;
        };
        auto const jumps = [&](int u, std::ptrdiff_t to) {
          int const other = heights.row(2)[u + to];
          return other > 0 && std::abs(other - heights.row(2)[u]) >= limits.link;
        };
        Row<std::uint8_t> wall(width);
        Row<std::uint8_t> solid(width);
        crease_row(heights.row(2), heights.stride(), concavity.row(2), steepness.row(2), limits,
                   static_cast<std::size_t>(width), wall.data(), solid.data());
        EXPECT_EQ(wall.values(), plain_row<std::uint8_t>(width, is_wall));
        EXPECT_EQ(solid.values(), plain_row<std::uint8_t>(width, [&](int u) {
                    return heights.row(2)[u] > 0 && !is_wall(u) && !jumps(u, -1) && !jumps(u, 1) &&
                           !jumps(u, -heights.stride()) && !jumps(u, heights.stride());
                  }));
      }
    }
  });
}

TEST(SegmentKernels, Thicken) {
  for_each_size([](int width) {
    for (std::uint8_t level = 1; level <= 3; ++level) {
      std::mt19937 random(static_cast<unsigned>(width + level));
      Bytes const bytes = drawn<std::uint8_t>(width, [&] {
        return random() % 8 == 0 ? random() % (level + 1U) : static_cast<unsigned>(level);
      });
      Row<std::uint8_t> out(width);
      thicken_row(bytes.row(2), bytes.stride(), level, static_cast<std::size_t>(width), out.data());
      EXPECT_EQ(out.values(), plain_row<std::uint8_t>(width, [&](int u) {
                  bool all = true;
                  for (int dv = -1; dv <= 1; ++dv) {
                    for (int du = -1; du <= 1; ++du) {
                      all = all && bytes.row(2 + dv)[u + du] >= level;
                    }
                  }
                  return all ? level + 1 : bytes.row(2)[u];
                }));
    }
  });
}

TEST(SegmentKernels, Worth) {
  for_each_size([](int width) {
    for (Heights const& heights : surfaces(width, 100)) {
      std::mt19937 random(1);
      Bytes thickness = drawn<std::uint8_t>(width, [&] { return random() % 5; });
      for (int u = 0; u < width; ++u) {
        thickness.row(2)[u] = heights.row(2)[u] > 0 ? thickness.row(2)[u] : std::uint8_t{0};
      }
      Row<std::uint8_t> out(width);
      worth_row(heights.row(2), thickness.row(2), static_cast<std::size_t>(width), out.data());
      EXPECT_EQ(out.values(), plain_row<std::uint8_t>(width, [&](int u) {
                  return heights.row(2)[u] > 0 ? 1 + thickness.row(2)[u] : 0;
                }));
    }
  });
}

TEST(SegmentKernels, Flood) {
  constexpr std::int16_t kLink = 40;
  for_each_size([](int width) {
    for (Heights const& heights : surfaces(width, 100)) {
      std::mt19937 random(2);
      Bytes const worth = drawn<std::uint8_t>(width, [&] { return random() % 3; });
      // Up to beyond 31 quanta, 16 units each.
      Heights const concavity = drawn<std::int16_t>(width, [&] { return random() % 800; });
      std::int16_t const* const at = heights.row(2);
      Row<std::uint8_t> out(width);
      flood_row(worth.row(2), at, heights.stride(), concavity.row(2), kLink,
                static_cast<std::size_t>(width), out.data());
      EXPECT_EQ(out.values(), plain_row<std::uint8_t>(width, [&](int u) {
                  int const cost = std::min(concavity.row(2)[u] / 8, 62) + 1;
                  return (worth.row(2)[u] > 0 ? cost : 0) |
                         (std::abs(at[u] - at[u + 1]) < kLink ? kLinkedRight : 0) |
                         (std::abs(at[u] - heights.row(3)[u]) < kLink ? kLinkedDown : 0);
                }));
    }
  });
}

/// What a kernel writes as bits, one value a pixel; bits beyond the row are 0.
template <typename Write>
std::vector<std::uint8_t> written_bits(int width, Write const& write) {
  RowBits bits(width);
  write(bits.data());
  std::vector<std::uint8_t> values;
  for (int u = 0; u < width; ++u) {
    values.push_back(bits.contains(u) ? 1 : 0);
  }
  EXPECT_EQ(width % 64 == 0 ? 0U : bits.data()[width / 64] >> (width % 64), 0U);
  return values;
}

TEST(SegmentKernels, Front) {
  for_each_size([](int width) {
    std::mt19937 random(static_cast<unsigned>(width));
    Bytes const bytes =
        drawn<std::uint8_t>(width, [&] { return random() % 3 == 0 ? 0U : random() % 6; });
    for (std::uint8_t least = 1; least <= 5; ++least) {
      auto const is_front = written_bits(width, [&](std::uint64_t* out) {
        front_bits(bytes.row(2), bytes.stride(), least, static_cast<std::size_t>(width), out);
      });
      EXPECT_EQ(is_front, plain_row<std::uint8_t>(width, [&](int u) {
                  std::uint8_t const* const at = bytes.row(2) + u;
                  return *at >= least && (at[-1] == 0 || at[1] == 0 || at[-bytes.stride()] == 0 ||
                                          at[bytes.stride()] == 0);
                }));
    }
  });
}

TEST(SegmentKernels, AtLeast) {
  for_each_size([](int width) {
    std::mt19937 random(static_cast<unsigned>(width));
    Bytes const bytes = drawn<std::uint8_t>(width, [&] { return random() % 6; });
    for (std::uint8_t least = 1; least <= 5; ++least) {
      auto const enough = written_bits(width, [&](std::uint64_t* out) {
        at_least_bits(bytes.row(2), least, static_cast<std::size_t>(width), out);
      });
      EXPECT_EQ(enough, plain_row<std::uint8_t>(
                            width, [&](int u) { return bytes.row(2)[u] >= least ? 1 : 0; }));
    }
  });
}

TEST(SegmentRowBits, AreFoundOneAfterTheOther) {
  for (int const width : {1, 63, 64, 65, 200}) {
    RowBits bits(width);
    std::mt19937 random(static_cast<unsigned>(width));
    std::vector<bool> expected(static_cast<std::size_t>(width));
    for (int u = 0; u < width; ++u) {
      bool const is_set = random() % 3 == 0 || (u > 70 && u < 150);
      expected[static_cast<std::size_t>(u)] = is_set;
      bits.data()[u / 64] |= std::uint64_t{is_set} << (u % 64);
    }
    for (int u = 0; u <= width; ++u) {
      auto const from = expected.begin() + u;
      EXPECT_EQ(bits.next_set(u), std::find(from, expected.end(), true) - expected.begin());
      EXPECT_EQ(bits.next_clear(u), std::find(from, expected.end(), false) - expected.begin());
    }
  }
}

}  // namespace
}  // namespace credo::segments
