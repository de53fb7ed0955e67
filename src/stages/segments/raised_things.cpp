#include "stages/segments/raised_things.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace credo {
namespace {

/// Of the surfaces that things lie on, at the reference focal length.
constexpr double kSurface_px = 8000.0;
/// Points that a surface is fitted to, about, and planes that are tried.
constexpr std::size_t kSamples = 1500;
constexpr int kHypotheses = 60;
/// Points so near are on it, and so much of a segment must be.
constexpr double kOn_quanta = 2.0;
constexpr double kMostlyOn = 0.5;
/// What stands out does so by so many times the noise of a mean of nine pixels.
constexpr double kNoises = 5.0;
/// What is around a thing is the surface, but for this part.
constexpr double kBeside = 0.4;

/// A pixel and its inverse depth; across the image's width, u and v go from -0.5 to 0.5.
struct Sample {
  double u = 0.0;
  double v = 0.0;
  double quanta = 0.0;
};

/// Inverse depth of a surface that is bent a little.
struct FlatSurface {
  /// Of 1, u, v, u^2, u v, v^2.
  Eigen::Matrix<double, 6, 1> coefficients = Eigen::Matrix<double, 6, 1>::Zero();
  double rms_quanta = 0.0;

  [[nodiscard]] double quanta(double u, double v) const {
    auto const& c = coefficients;
    return c[0] + u * (c[1] + u * c[3] + v * c[4]) + v * (c[2] + v * c[5]);
  }
  [[nodiscard]] bool has(Sample const& s) const {
    return std::abs(s.quanta - quanta(s.u, s.v)) < kOn_quanta;
  }
};

/// Least squares over what is on the surface so far; `terms` 3 for a plane, 6 for a bent one.
FlatSurface fitted(std::vector<Sample> const& samples, FlatSurface const& so_far, int terms) {
  Eigen::Matrix<double, 6, 6> squares = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> products = Eigen::Matrix<double, 6, 1>::Zero();
  double square_sum = 0.0;
  double count = 0.0;
  for (Sample const& s : samples) {
    if (so_far.has(s)) {
      Eigen::Matrix<double, 6, 1> row;
      row << 1.0, s.u, s.v, s.u * s.u, s.u * s.v, s.v * s.v;
      squares += row * row.transpose();
      products += row * s.quanta;
      square_sum += s.quanta * s.quanta;
      count += 1.0;
    }
  }
  FlatSurface surface;
  auto const used_squares = squares.topLeftCorner(terms, terms);
  surface.coefficients.head(terms) = used_squares.ldlt().solve(products.head(terms));
  double const left = square_sum - surface.coefficients.dot(products);
  surface.rms_quanta = count > 0.0 ? std::sqrt(std::max(0.0, left / count)) : 0.0;
  return surface;
}

/// The plane through three points; none where they are nearly in line.
std::optional<FlatSurface> through(Sample const& a, Sample const& b, Sample const& c) {
  double const determinant = (b.u - a.u) * (c.v - a.v) - (c.u - a.u) * (b.v - a.v);
  constexpr double kLeast = 1e-4;
  if (std::abs(determinant) < kLeast) {
    return std::nullopt;
  }
  double const per_u =
      ((b.quanta - a.quanta) * (c.v - a.v) - (c.quanta - a.quanta) * (b.v - a.v)) / determinant;
  double const per_v =
      ((b.u - a.u) * (c.quanta - a.quanta) - (c.u - a.u) * (b.quanta - a.quanta)) / determinant;
  FlatSurface plane;
  plane.coefficients.head<3>() << a.quanta - per_u * a.u - per_v * a.v, per_u, per_v;
  return plane;
}

std::size_t points_on(FlatSurface const& surface, std::vector<Sample> const& samples) {
  return static_cast<std::size_t>(
      std::ranges::count_if(samples, [&](Sample const& s) { return surface.has(s); }));
}

/// The surface that most of the samples are on; none where few are. Points are taken by a sequence
/// that fills the unit cube evenly (Roberts 2018), so there is no seed.
std::optional<FlatSurface> flat_surface(std::vector<Sample> const& samples) {
  constexpr std::array<double, 3> kSteps = {0.8191725133961645, 0.6710436067037893,
                                            0.5497004779019703};
  FlatSurface best;
  std::size_t most = 0;
  auto const n = static_cast<double>(samples.size());
  for (int k = 1; k <= kHypotheses; ++k) {
    auto const pick = [&](double step) -> Sample const& {
      double const at = k * step;
      return samples[static_cast<std::size_t>((at - std::floor(at)) * n)];
    };
    auto const plane = through(pick(kSteps[0]), pick(kSteps[1]), pick(kSteps[2]));
    if (!plane) {
      continue;
    }
    if (std::size_t const count = points_on(*plane, samples); count > most) {
      most = count;
      best = *plane;
    }
  }
  for (int const terms : {3, 3, 6, 6}) {
    best = fitted(samples, best, terms);
  }
  bool const is_flat = static_cast<double>(points_on(best, samples)) >= kMostlyOn * n;
  return is_flat ? std::optional(best) : std::nullopt;
}

/// What stands out of the large flat segments of an image.
class Relief {
public:
  Relief(Segments const& segments, Grid<float> const& depth_m, double focal_px,
         SegmentsConfig const& config)
      : segments_(segments),
        depth_m_(depth_m),
        per_px_(1.0 / std::max(depth_m.width(), 1)),
        quantum_per_m_(config.quantum_per_m),
        raised_quanta_(config.raised_quanta),
        scale_(focal_px / 525.0),
        surfaces_(segments.pixel_counts.size() + 1) {
    find_surfaces();
  }

  /// Of each pixel, by how much of what a thing must stand out it does, as the mean over what is of
  /// its segment among itself and its eight neighbours: 1 or more is a thing's middle. 0 where
  /// there is no flat surface.
  [[nodiscard]] Grid<float> heights() const {
    int const width = depth_m_.width();
    int const height = depth_m_.height();
    Grid<float> result(width, height);
    // Of three rows each; the row before the first has nothing.
    RowSums const none(static_cast<std::size_t>(width));
    std::array<RowSums, 3> rows = {none, none, none};
    for (int v = 0; v <= height; ++v) {
      fill(v, rows[static_cast<std::size_t>(v % 3)]);
      if (v == 0) {
        continue;
      }
      RowSums const& above = rows[static_cast<std::size_t>((v + 1) % 3)];
      RowSums const& here = rows[static_cast<std::size_t>((v + 2) % 3)];
      RowSums const& below = rows[static_cast<std::size_t>(v % 3)];
      std::span<float> const row = result.row(v - 1);
      for (std::size_t u = 0; u < row.size(); ++u) {
        bool const up = above.surface[u] == here.surface[u];
        bool const down = below.surface[u] == here.surface[u];
        float const sum =
            here.sums[u] + (up ? above.sums[u] : 0.0F) + (down ? below.sums[u] : 0.0F);
        float const count =
            here.counts[u] + (up ? above.counts[u] : 0.0F) + (down ? below.counts[u] : 0.0F);
        row[u] = here.surface[u] != 0 ? sum / count : 0.0F;
      }
    }
    return result;
  }

private:
  void find_surfaces() {
    double const least_px = kSurface_px * scale_ * scale_;
    std::vector<std::vector<Sample>> samples(surfaces_.size());
    std::vector<std::uint32_t> every(surfaces_.size(), 0);
    std::vector<std::uint32_t> next(surfaces_.size(), 0);
    for (std::size_t i = 1; i < surfaces_.size(); ++i) {
      std::uint32_t const pixels = segments_.pixel_counts[i - 1];
      every[i] =
          pixels < least_px ? 0 : std::max(1U, pixels / static_cast<std::uint32_t>(kSamples));
    }
    for (int v = 0; v < depth_m_.height(); ++v) {
      std::span<std::int32_t const> const row = segments_.labels.row(v);
      for (int u = 0; u < depth_m_.width(); ++u) {
        auto const label = static_cast<std::size_t>(row[static_cast<std::size_t>(u)]);
        if (every[label] > 0 && ++next[label] == every[label]) {
          next[label] = 0;
          samples[label].push_back(
              {across(u, depth_m_.width()), across(v, depth_m_.height()), quanta({u, v})});
        }
      }
    }
    for (std::size_t i = 1; i < surfaces_.size(); ++i) {
      if (!samples[i].empty()) {
        surfaces_[i] = flat_surface(samples[i]);
      }
    }
  }

  [[nodiscard]] double across(int at, int size) const { return (at - 0.5 * (size - 1)) * per_px_; }
  [[nodiscard]] double quanta(Pixel p) const {
    return 1.0 / (static_cast<double>(depth_m_[p]) * quantum_per_m_);
  }

  /// Of a row: the segment whose flat surface is there, 0 for none, and of each pixel and those
  /// beside it that have the same, how many and their heights together.
  struct RowSums {
    explicit RowSums(std::size_t width) : surface(width, 0), sums(width), counts(width) {}
    std::vector<std::int32_t> surface;
    std::vector<float> sums;
    std::vector<float> counts;
  };

  void fill(int v, RowSums& row) const {
    std::ranges::fill(row.surface, 0);
    if (v == depth_m_.height()) {
      return;
    }
    std::span<std::int32_t const> const labels = segments_.labels.row(v);
    for (std::size_t begin = 0, end = 0; begin < labels.size(); begin = end) {
      end = begin + 1;
      while (end < labels.size() && labels[end] == labels[begin]) {
        ++end;
      }
      if (auto const& surface = surfaces_[static_cast<std::size_t>(labels[begin])]) {
        std::fill(row.surface.begin() + static_cast<std::ptrdiff_t>(begin),
                  row.surface.begin() + static_cast<std::ptrdiff_t>(end), labels[begin]);
        fill_run(*surface, v, begin, end, row);
      }
    }
  }

  void fill_run(FlatSurface const& surface, int v, std::size_t begin, std::size_t end,
                RowSums& row) const {
    double const least = std::max(raised_quanta_, kNoises * surface.rms_quanta / 3.0);
    double const y = across(v, depth_m_.height());
    float before = 0.0F;
    float here = 0.0F;
    // One behind, since a sum needs the height after it.
    for (std::size_t u = begin; u <= end; ++u) {
      float after = 0.0F;
      if (u < end) {
        auto const column = static_cast<int>(u);
        double const over =
            quanta({column, v}) - surface.quanta(across(column, depth_m_.width()), y);
        // Far below or above is no height of a thing that lies there, but of another.
        after = static_cast<float>(std::clamp(over / least, -4.0, 4.0));
      }
      if (u > begin) {
        row.sums[u - 1] = before + here + after;
        row.counts[u - 1] = 1.0F + (u - 1 > begin ? 1.0F : 0.0F) + (u < end ? 1.0F : 0.0F);
      }
      before = here;
      here = after;
    }
  }

  Segments const& segments_;
  Grid<float> const& depth_m_;
  double per_px_;
  double quantum_per_m_;
  double raised_quanta_;
  double scale_;
  /// By label.
  std::vector<std::optional<FlatSurface>> surfaces_;
};

/// A connected piece of one segment that stands out.
struct Raised {
  std::vector<std::size_t> pixels;
  float highest = 0.0F;
  /// Pairs of a pixel and a neighbour outside: on the same segment, and on others.
  std::size_t on_it = 0;
  std::size_t beside = 0;
  /// Of its edge, the differences across four pixels.
  double steps = 0.0;
};

/// Levels at which pieces are looked for, the lower the better; where the surface itself is bent
/// more than that, the next.
constexpr std::array<float, 4> kLevels = {0.5F, 0.75F, 1.0F, 1.5F};
/// A thing has an edge; what a sensor bends has none.
constexpr double kLeastStep = 1.0;

class RaisedFinder {
public:
  RaisedFinder(Segments const& segments, Grid<float> const& heights, std::size_t least_px)
      : segments_(segments),
        heights_(heights),
        least_px_(least_px),
        levels_(heights.width(), heights.height()) {}

  /// In the order of their first pixels at the level where they were found.
  std::vector<Raised> found() && {
    for (std::size_t i = 0; i < heights_.size(); ++i) {
      if (heights_[i] > kLevels.front() && levels_[i] == 0) {
        look(i, 0);
      }
    }
    return std::move(found_);
  }

private:
  /// The piece around a pixel, or what of it stands out at the next level.
  void look(std::size_t first, std::size_t level) {
    Raised raised = grow(first, level);
    if (raised.highest < 1.0F || raised.pixels.size() < least_px_) {
      return;
    }
    if (is_thing(raised)) {
      keep_upper_half(raised);
      found_.push_back(std::move(raised));
    } else if (level + 1 < kLevels.size()) {
      for (std::size_t const i : raised.pixels) {
        if (heights_[i] > kLevels[level + 1] && levels_[i] == level + 1) {
          look(i, level + 1);
        }
      }
    }
  }

  /// Means over neighbours have made it wider: its edge is where it is half as high as its middle.
  void keep_upper_half(Raised& raised) const {
    std::vector<float> heights;
    for (std::size_t const i : raised.pixels) {
      heights.push_back(heights_[i]);
    }
    auto const middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
    std::ranges::nth_element(heights, middle);
    std::erase_if(raised.pixels, [&](std::size_t i) { return heights_[i] < 0.5F * *middle; });
  }

  [[nodiscard]] static bool is_thing(Raised const& raised) {
    auto const on_it = static_cast<double>(raised.on_it);
    auto const beside = static_cast<double>(raised.beside);
    return raised.steps >= kLeastStep * on_it && beside <= kBeside * (on_it + beside);
  }

  /// Marks the piece's pixels as looked at on that level.
  Raised grow(std::size_t first, std::size_t level) {
    Raised raised;
    auto const mark = static_cast<std::uint8_t>(level + 1);
    raised.pixels.push_back(first);
    levels_[first] = mark;
    std::int32_t const base = segments_.labels[first];
    for (std::size_t i = 0; i < raised.pixels.size(); ++i) {
      raised.highest = std::max(raised.highest, heights_[raised.pixels[i]]);
      Pixel const p = heights_.pixel(raised.pixels[i]);
      for (Pixel const q :
           {Pixel{p.u, p.v - 1}, Pixel{p.u - 1, p.v}, Pixel{p.u + 1, p.v}, Pixel{p.u, p.v + 1}}) {
        if (!heights_.contains(q) || segments_.labels[q] == 0) {
          continue;
        }
        std::size_t const at = heights_.index(q);
        if (segments_.labels[q] != base) {
          ++raised.beside;
        } else if (heights_[at] <= kLevels[level]) {
          ++raised.on_it;
          raised.steps += step_across(p, q);
        } else if (levels_[at] < mark) {
          levels_[at] = mark;
          raised.pixels.push_back(at);
        }
      }
    }
    return raised;
  }

  /// How much lower it is two pixels beyond q than two pixels before p.
  [[nodiscard]] double step_across(Pixel p, Pixel q) const {
    constexpr int kAway = 2;
    Pixel const inside{p.u - kAway * (q.u - p.u), p.v - kAway * (q.v - p.v)};
    Pixel const outside{q.u + kAway * (q.u - p.u), q.v + kAway * (q.v - p.v)};
    auto const height = [&](Pixel at, Pixel otherwise) {
      bool const same = heights_.contains(at) && segments_.labels[at] == segments_.labels[p];
      return static_cast<double>(heights_[same ? at : otherwise]);
    };
    return height(inside, p) - height(outside, q);
  }

  Segments const& segments_;
  Grid<float> const& heights_;
  std::size_t least_px_;
  /// Of each pixel the level on which it was looked at last, from 1; 0 for never.
  Grid<std::uint8_t> levels_;
  std::vector<Raised> found_;
};

}  // namespace

Segments with_raised_things(Segments segments, Grid<float> const& depth_m, double focal_px,
                            SegmentsConfig const& config) {
  double const scale = focal_px / 525.0;
  auto const least_px =
      static_cast<std::size_t>(std::max(1.0, std::round(config.raised_min_pixels * scale * scale)));
  Grid<float> const heights = Relief(segments, depth_m, focal_px, config).heights();
  segments.lies_on.assign(segments.pixel_counts.size(), 0);
  for (Raised const& raised : RaisedFinder(segments, heights, least_px).found()) {
    std::int32_t const base = segments.labels[raised.pixels.front()];
    auto const pixels = static_cast<std::uint32_t>(raised.pixels.size());
    segments.pixel_counts[static_cast<std::size_t>(base - 1)] -= pixels;
    segments.pixel_counts.push_back(pixels);
    segments.lies_on.push_back(base);
    for (std::size_t const i : raised.pixels) {
      segments.labels[i] = static_cast<std::int32_t>(segments.pixel_counts.size());
    }
  }
  return segments;
}

}  // namespace credo
