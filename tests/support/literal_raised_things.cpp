#include "support/literal_raised_things.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "stages/segments/raised/flat_surface.hpp"

namespace credo::test {
namespace {

using segments::FlatSurface;

constexpr std::array<float, 4> kLevels = {0.5F, 0.75F, 1.0F, 1.5F};

std::array<Pixel, 4> neighbours(Pixel p) {
  return {Pixel{p.u, p.v - 1}, {p.u - 1, p.v}, {p.u + 1, p.v}, {p.u, p.v + 1}};
}

class Heights {
public:
  Heights(Segments const& segments, Grid<float> const& depth_m, double focal_px,
          SegmentsConfig const& config)
      : labels_(segments.labels),
        depth_m_(depth_m),
        config_(config),
        surfaces_(segments::flat_surfaces(segments, segments::LabelledRows(segments.labels),
                                          depth_m, config.quantum_per_m,
                                          8000.0 * focal_px / 525.0 * focal_px / 525.0)) {}

  [[nodiscard]] Grid<float> smooth() const {
    Grid<float> single(labels_.width(), labels_.height());
    for (std::size_t i = 0; i < single.size(); ++i) {
      single[i] = surface(i) ? height(*surface(i), single.pixel(i)) : 0.0F;
    }
    Grid<float> result(labels_.width(), labels_.height());
    for (std::size_t i = 0; i < result.size(); ++i) {
      if (!surface(i)) {
        continue;
      }
      float sum = 0.0F;
      float count = 0.0F;
      Pixel const p = result.pixel(i);
      for (int const dv : {0, -1, 1}) {
        Pixel const middle{p.u, p.v + dv};
        if (!is(middle, labels_[i])) {
          continue;
        }
        float row = 0.0F;
        for (int const du : {-1, 0, 1}) {
          Pixel const q{middle.u + du, middle.v};
          if (is(q, labels_[i])) {
            row += single[q];
            count += 1.0F;
          }
        }
        sum += row;
      }
      result[i] = sum / count;
    }
    return result;
  }

private:
  [[nodiscard]] std::optional<FlatSurface> const& surface(std::size_t i) const {
    return surfaces_[static_cast<std::size_t>(labels_[i])];
  }
  [[nodiscard]] bool is(Pixel p, std::int32_t label) const {
    return labels_.contains(p) && labels_[p] == label;
  }

  /// In floats, from the run's first pixel on.
  [[nodiscard]] float height(FlatSurface const& surface, Pixel p) const {
    auto const& c = surface.coefficients;
    double const per_px = 1.0 / labels_.width();
    Pixel first = p;
    while (is({first.u - 1, p.v}, labels_[p])) {
      --first.u;
    }
    double const y = segments::across(p.v, labels_.height(), per_px);
    auto const first_x = static_cast<float>(segments::across(first.u, labels_.width(), per_px));
    float const x = first_x + static_cast<float>(per_px) * static_cast<float>(p.u - first.u);
    auto const at_middle = static_cast<float>(c[0] + y * (c[2] + y * c[5]));
    auto const slope = static_cast<float>(c[1] + y * c[4]);
    float const over = static_cast<float>(1.0 / config_.quantum_per_m) / depth_m_[p] -
                       (at_middle + x * (slope + x * static_cast<float>(c[3])));
    auto const share =
        static_cast<float>(1.0 / std::max(config_.raised_quanta, 5.0 * surface.rms_quanta / 3.0));
    return std::clamp(over * share, -4.0F, 4.0F);
  }

  Grid<std::int32_t> const& labels_;
  Grid<float> const& depth_m_;
  SegmentsConfig const& config_;
  std::vector<std::optional<FlatSurface>> surfaces_;
};

class Finder {
public:
  using Pixels = std::vector<std::size_t>;

  Finder(Grid<std::int32_t> const& labels, Grid<float> const& heights, std::size_t least_px,
         double scale)
      : labels_(labels), heights_(heights), least_px_(least_px), scale_(scale) {}

  std::vector<Pixels> found() && {
    Pixels all(labels_.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i] = i;
    }
    look(all, 0);
    return std::move(found_);
  }

private:
  void look(Pixels const& among, std::size_t level) {
    Grid<char> seen(labels_.width(), labels_.height(), 0);
    for (std::size_t const first : among) {
      if (seen[first] != 0 || heights_[first] <= kLevels.at(level)) {
        continue;
      }
      Pixels piece = grown(first, kLevels.at(level), seen);
      std::ranges::sort(piece);
      bool const is_high = std::ranges::any_of(piece, [&](auto i) { return heights_[i] >= 1.0F; });
      if (piece.size() < least_px_ || !is_high) {
        continue;
      }
      if (is_thing(piece, level)) {
        add(upper_half(piece));
      } else if (level + 1 < kLevels.size()) {
        look(piece, level + 1);
      }
    }
  }

  /// Its connected parts of at least a fifth of the largest one, if these are two or more.
  void add(Pixels const& high) {
    Grid<char> out(labels_.width(), labels_.height(), 1);
    for (std::size_t const i : high) {
      out[i] = 0;
    }
    std::vector<Pixels> parts;
    std::size_t most = 0;
    for (std::size_t const first : high) {
      if (out[first] == 0) {
        parts.push_back(grown(first, 0.0F, out));
        std::ranges::sort(parts.back());
        most = std::max(most, parts.back().size());
      }
    }
    std::erase_if(parts, [&](Pixels const& part) {
      return part.size() < least_px_ || 5 * part.size() < most;
    });
    if (parts.size() < 2) {
      parts = {high};
    }
    found_.insert(found_.end(), parts.begin(), parts.end());
  }

  [[nodiscard]] Pixels grown(std::size_t first, float higher_than, Grid<char>& seen) const {
    Pixels piece = {first};
    seen[first] = 1;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      for (Pixel const q : neighbours(labels_.pixel(piece[i]))) {
        if (labels_.contains(q) && labels_[q] == labels_[first] && seen[q] == 0 &&
            heights_[q] > higher_than) {
          seen[q] = 1;
          piece.push_back(labels_.index(q));
        }
      }
    }
    return piece;
  }

  [[nodiscard]] bool is_thing(Pixels const& piece, std::size_t level) const {
    int const rim_px = std::max(1, static_cast<int>(std::lround(8.0 * scale_)));
    int const far_px = std::max(1, static_cast<int>(std::lround(5.0 * scale_)));
    double on_it = 0.0;
    double beside = 0.0;
    double rim = 0.0;
    double steps = 0.0;
    double blurred_steps = 0.0;
    for (std::size_t const i : piece) {
      Pixel const p = labels_.pixel(i);
      for (Pixel const q : neighbours(p)) {
        if (!labels_.contains(q) || labels_[q] == 0) {
          continue;
        }
        Pixel const out{q.u - p.u, q.v - p.v};
        Pixel const beyond{p.u + rim_px * out.u, p.v + rim_px * out.v};
        bool const is_rim =
            labels_.contains(beyond) && labels_[beyond] != 0 && labels_[beyond] != labels_[p];
        if (labels_[q] != labels_[p]) {
          beside += 1.0;
        } else if (heights_[q] <= kLevels.at(level)) {
          rim += is_rim ? 1.0 : 0.0;
          auto const within = [&](int px) { return height_at(p, -px * out.u, -px * out.v); };
          auto const outside = [&](int px) { return height_at(q, px * out.u, px * out.v); };
          on_it += 1.0;
          steps += within(2) - outside(2);
          blurred_steps +=
              std::max(within(2), within(far_px)) - std::min(outside(2), outside(far_px));
        }
      }
    }
    return (middle_height(piece) < 1.5F ? steps : blurred_steps) >= on_it &&
           beside + rim <= 0.4 * (on_it + beside);
  }

  /// So far from p if that is on its segment too, else at p.
  [[nodiscard]] double height_at(Pixel p, int du, int dv) const {
    Pixel const q{p.u + du, p.v + dv};
    return static_cast<double>(heights_[labels_.contains(q) && labels_[q] == labels_[p] ? q : p]);
  }

  [[nodiscard]] float middle_height(Pixels const& piece) const {
    std::vector<float> heights;
    for (std::size_t const i : piece) {
      heights.push_back(heights_[i]);
    }
    std::ranges::sort(heights);
    return heights[heights.size() / 2];
  }

  [[nodiscard]] Pixels upper_half(Pixels piece) const {
    float const least = 0.5F * middle_height(piece);
    std::erase_if(piece, [&](std::size_t i) { return heights_[i] <= least; });
    return piece;
  }

  Grid<std::int32_t> const& labels_;
  Grid<float> const& heights_;
  std::size_t least_px_;
  double scale_;
  std::vector<Pixels> found_;
};

}  // namespace

Segments literal_raised_things(Segments segments, Grid<float> const& depth_m, double focal_px,
                               SegmentsConfig const& config) {
  double const scale = focal_px / 525.0;
  auto const least_px =
      static_cast<std::size_t>(std::max(1.0, std::round(config.raised_min_pixels * scale * scale)));
  Grid<float> const heights = Heights(segments, depth_m, focal_px, config).smooth();
  segments.lies_on.assign(segments.pixel_counts.size(), 0);
  for (auto const& pixels : Finder(segments.labels, heights, least_px, scale).found()) {
    std::int32_t const base = segments.labels[pixels.front()];
    segments.pixel_counts.push_back(static_cast<std::uint32_t>(pixels.size()));
    segments.pixel_counts[static_cast<std::size_t>(base - 1)] -=
        static_cast<std::uint32_t>(pixels.size());
    segments.lies_on.push_back(base);
    for (std::size_t const i : pixels) {
      segments.labels[i] = static_cast<std::int32_t>(segments.pixel_counts.size());
    }
  }
  return segments;
}

}  // namespace credo::test
