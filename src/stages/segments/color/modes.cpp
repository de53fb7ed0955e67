#include "stages/segments/color/modes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace credo::segments {
namespace {

constexpr std::size_t kMostModes = 3;
/// Of all cells, what a colour has at least.
constexpr double kLeastShare = 0.08;
/// Of all cells, what may have none of the colours: the borders between them, and a little print.
/// On printed boxes it is a quarter to three quarters.
constexpr double kMostStrays = 0.15;
/// A cell has a colour that is nearer to it than so many times the distance between two.
constexpr double kNear = 0.35;

struct Chroma {
  double red = 0.0;
  double green = 0.0;

  [[nodiscard]] double distance(Chroma const& other) const {
    double const dr = red - other.red;
    double const dg = green - other.green;
    return std::sqrt(dr * dr + dg * dg);
  }
};

Chroma chroma(ColorCell const& cell) {
  return {cell.red, cell.green};
}

/// How many cells have about the same colour.
class Histogram {
public:
  explicit Histogram(std::span<ColorCell const> cells) {
    for (ColorCell const& cell : cells) {
      if (cell.has_color()) {
        ++counts_.at(index(cell));
      }
    }
  }
  /// In a square of three bins' side.
  [[nodiscard]] std::uint32_t around(ColorCell const& cell) const {
    std::size_t const middle = index(cell);
    std::uint32_t sum = 0;
    for (std::size_t const row : {middle - kStride, middle, middle + kStride}) {
      sum += counts_.at(row - 1) + counts_.at(row) + counts_.at(row + 1);
    }
    return sum;
  }

private:
  static constexpr std::size_t kBins = 48;
  /// A margin of one bin all around.
  static constexpr std::size_t kStride = kBins + 2;

  static std::size_t index(ColorCell const& cell) {
    auto const bin = [](float share) {
      return std::min(kBins - 1, static_cast<std::size_t>(share * static_cast<float>(kBins)));
    };
    return (bin(cell.green) + 1) * kStride + bin(cell.red) + 1;
  }

  std::array<std::uint32_t, kStride* kStride> counts_ = {};
};

/// The mean of the cells near to a colour.
Chroma settled(Chroma at, std::span<ColorCell const> cells, double near) {
  Chroma sum;
  double count = 0.0;
  for (ColorCell const& cell : cells) {
    if (cell.has_color() && chroma(cell).distance(at) < near) {
      sum.red += cell.red;
      sum.green += cell.green;
      ++count;
    }
  }
  return {sum.red / count, sum.green / count};
}

/// The most frequent colours, each far from those before.
std::vector<Chroma> frequent(std::span<ColorCell const> cells, double apart) {
  Histogram const histogram(cells);
  std::vector<Chroma> modes;
  while (modes.size() < kMostModes) {
    std::uint32_t most = 0;
    Chroma best;
    for (ColorCell const& cell : cells) {
      if (!cell.has_color() || std::ranges::any_of(modes, [&](Chroma const& mode) {
            return mode.distance(chroma(cell)) < apart;
          })) {
        continue;
      }
      if (std::uint32_t const count = histogram.around(cell); count > most) {
        most = count;
        best = chroma(cell);
      }
    }
    if (most == 0 || most < kLeastShare * static_cast<double>(cells.size())) {
      break;
    }
    modes.push_back(settled(best, cells, apart / 2.0));
  }
  return modes;
}

double least_distance(std::vector<Chroma> const& modes) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < modes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      least = std::min(least, modes[i].distance(modes[j]));
    }
  }
  return least;
}

}  // namespace

std::optional<ColorModes> color_modes(std::span<ColorCell const> cells, double apart) {
  std::vector<Chroma> const modes = frequent(cells, apart);
  double const distance = least_distance(modes);
  if (modes.size() < 2 || distance < apart) {
    return std::nullopt;
  }
  ColorModes result{static_cast<int>(modes.size()), std::vector<int>(cells.size(), -1)};
  std::size_t strays = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    Chroma const own = chroma(cells[i]);
    auto const nearest =
        std::ranges::min_element(modes, {}, [&](Chroma const& mode) { return mode.distance(own); });
    if (cells[i].has_color() && nearest->distance(own) < kNear * distance) {
      result.of_cell[i] = static_cast<int>(nearest - modes.begin());
    } else {
      ++strays;
    }
  }
  if (static_cast<double>(strays) > kMostStrays * static_cast<double>(cells.size())) {
    return std::nullopt;
  }
  return result;
}

}  // namespace credo::segments
