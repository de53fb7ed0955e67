// The second half of the literal convexity: which parts belong together.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "support/literal_convexity.hpp"

namespace credo::test {
namespace {

constexpr double kUnitsPerQuantum = 16.0;

using Pair = std::pair<int, int>;

Pair ordered(int a, int b) {
  return {std::min(a, b), std::max(a, b)};
}

/// What is between two parts that touch.
struct Border {
  int pairs = 0;
  int parted = 0;
  int samples = 0;
  int unlike = 0;
};

/// Quanta over pixels from the centre of a disc.
struct Plane {
  double mean_u = 0.0;
  double mean_v = 0.0;
  double mean_quanta = 0.0;
  double per_u = 0.0;
  double per_v = 0.0;
  double rms_quanta = 0.0;

  [[nodiscard]] double at(double u, double v) const {
    return mean_quanta + per_u * (u - mean_u) + per_v * (v - mean_v);
  }
  [[nodiscard]] double slope() const { return std::sqrt(per_u * per_u + per_v * per_v); }
};

/// A place on a border, and the planes of its two sides.
struct Sample {
  Pixel p;
  Pixel q;
  Plane plane_p;
  Plane plane_q;
};

struct Point {
  double u = 0.0;
  double v = 0.0;
  double quanta = 0.0;
};

/// The mean over points of something of them. All that is added is a multiple of 2^-8: exact.
template <typename Of>
double mean(std::vector<Point> const& points, Of const& of) {
  double sum = 0.0;
  for (Point const& point : points) {
    sum += of(point);
  }
  return sum / static_cast<double>(points.size());
}

std::optional<Plane> fitted(std::vector<Point> const& points) {
  if (points.size() < 20) {
    return std::nullopt;
  }
  Plane plane;
  plane.mean_u = mean(points, [](Point const& p) { return p.u; });
  plane.mean_v = mean(points, [](Point const& p) { return p.v; });
  plane.mean_quanta = mean(points, [](Point const& p) { return p.quanta; });
  auto const spread = [&](auto const& product, double mean_a, double mean_b) {
    return mean(points, product) - mean_a * mean_b;
  };
  double const uu =
      spread([](Point const& p) { return p.u * p.u; }, plane.mean_u, plane.mean_u) + 0.3;
  double const vv =
      spread([](Point const& p) { return p.v * p.v; }, plane.mean_v, plane.mean_v) + 0.3;
  double const uv = spread([](Point const& p) { return p.u * p.v; }, plane.mean_u, plane.mean_v);
  double const ud =
      spread([](Point const& p) { return p.u * p.quanta; }, plane.mean_u, plane.mean_quanta);
  double const vd =
      spread([](Point const& p) { return p.v * p.quanta; }, plane.mean_v, plane.mean_quanta);
  double const dd = spread([](Point const& p) { return p.quanta * p.quanta; }, plane.mean_quanta,
                           plane.mean_quanta);
  double const determinant = uu * vv - uv * uv;
  plane.per_u = (ud * vv - vd * uv) / determinant;
  plane.per_v = (vd * uu - ud * uv) / determinant;
  plane.rms_quanta = std::sqrt(std::max(0.0, dd - plane.per_u * ud - plane.per_v * vd));
  return plane;
}

/// Whether both are one convex surface.
bool go_on(Plane const& a, Plane const& b) {
  double const noise = std::sqrt(a.rms_quanta * a.rms_quanta + b.rms_quanta * b.rms_quanta);
  double const step = std::abs(a.at(0, 0) - b.at(0, 0));
  double const b_above_a = b.mean_quanta - a.at(b.mean_u, b.mean_v);
  double const a_above_b = a.mean_quanta - b.at(a.mean_u, a.mean_v);
  return step < 3.0 + 3.0 * noise + std::max(a.slope(), b.slope()) &&
         (b_above_a + a_above_b) / 2.0 < 1.0 + 0.6 * noise;
}

class Joining {
public:
  Joining(LiteralSurfaces const& surfaces, LiteralLimits const& limits, Grid<int>& labels)
      : surfaces_(surfaces), limits_(limits), labels_(labels) {
    for (int const label : labels) {
      ++sizes_[label];
    }
  }

  void look() {
    for (std::size_t i = 0; i < labels_.size(); ++i) {
      Pixel const p = labels_.pixel(i);
      look_between(p, {p.u + 1, p.v});
      look_between(p, {p.u, p.v + 1});
    }
  }

  void join() {
    while (std::optional<Pair> const weakest = weakest_border()) {
      auto const [into, from] = *weakest;
      sizes_[into] += sizes_[from];
      std::ranges::replace(labels_, from, into);
      std::map<Pair, Border> joined;
      for (auto const& [pair, border] : borders_) {
        int const a = pair.first == from ? into : pair.first;
        int const b = pair.second == from ? into : pair.second;
        if (a != b) {
          Border& sum = joined[ordered(a, b)];
          sum.pairs += border.pairs;
          sum.parted += border.parted;
          sum.samples += border.samples;
          sum.unlike += border.unlike;
        }
      }
      borders_ = std::move(joined);
    }
  }

  void sharpen() {
    for (Sample const& sample : samples_) {
      int const a = labels_[sample.p];
      int const b = labels_[sample.q];
      if (a != b && sizes_[a] >= limits_.border_px && sizes_[b] >= limits_.border_px) {
        sharpen_at(sample, a, b);
      }
    }
  }

private:
  [[nodiscard]] bool is_parted(Pixel p, Pixel q) const {
    int const step = surfaces_.disparity[p] - surfaces_.disparity[q];
    return std::abs(step) >= limits_.link || surfaces_.wall[p] != 0 || surfaces_.wall[q] != 0;
  }

  void look_between(Pixel p, Pixel q) {
    if (!labels_.contains(q) || labels_[p] == 0 || labels_[q] == 0 || labels_[p] == labels_[q]) {
      return;
    }
    Border& border = borders_[ordered(labels_[p], labels_[q])];
    border.parted += is_parted(p, q) ? 1 : 0;
    // Every third.
    if (border.pairs++ % 3 == 0) {
      look_closely(border, p, q);
    }
  }

  void look_closely(Border& border, Pixel p, Pixel q) {
    if (std::abs(surfaces_.disparity[p] - surfaces_.disparity[q]) >= 8 * limits_.link) {
      ++border.samples;
      ++border.unlike;
      return;
    }
    auto const plane_p = fitted(disc_around(p, labels_[p]));
    auto const plane_q = fitted(disc_around(p, labels_[q]));
    if (plane_p && plane_q) {
      ++border.samples;
      border.unlike += go_on(*plane_p, *plane_q) ? 0 : 1;
      samples_.push_back({p, q, *plane_p, *plane_q});
    }
  }

  /// Every second pixel of a label.
  [[nodiscard]] std::vector<Point> disc_around(Pixel centre, int label) const {
    std::vector<Point> points;
    int const radius = limits_.disc_px;
    for (int v = -radius; v <= radius; v += 2) {
      for (int u = -radius; u <= radius; u += 2) {
        Pixel const p{centre.u + u, centre.v + v};
        if (u * u + v * v <= radius * radius && labels_.contains(p) && labels_[p] == label) {
          points.push_back({static_cast<double>(u), static_cast<double>(v),
                            surfaces_.disparity[p] / kUnitsPerQuantum});
        }
      }
    }
    return points;
  }

  /// Of equals the first.
  [[nodiscard]] std::optional<Pair> weakest_border() {
    std::optional<Pair> weakest;
    double least = 0.5;
    for (auto const& [pair, border] : borders_) {
      if (border.pairs < 8) {
        continue;
      }
      double score = static_cast<double>(border.parted) / border.pairs;
      if (border.samples > 0) {
        score = 0.3 * score + 0.7 * (static_cast<double>(border.unlike) / border.samples);
      }
      bool const is_small = std::min(sizes_[pair.first], sizes_[pair.second]) < limits_.small_px;
      score -= is_small ? 0.1 : 0.0;
      if (score < least) {
        least = score;
        weakest = pair;
      }
    }
    return weakest;
  }

  void sharpen_at(Sample const& sample, int a, int b) {
    for (int v = -1; v <= 1; ++v) {
      for (int u = -1; u <= 1; ++u) {
        Pixel const p{sample.p.u + u, sample.p.v + v};
        if (!labels_.contains(p)) {
          continue;
        }
        double const quanta = surfaces_.disparity[p] / kUnitsPerQuantum;
        double const error_a = std::abs(quanta - sample.plane_p.at(u, v));
        double const error_b = std::abs(quanta - sample.plane_q.at(u, v));
        if (labels_[p] == a && error_b + 1.0 < error_a) {
          labels_[p] = b;
        } else if (labels_[p] == b && error_a + 1.0 < error_b) {
          labels_[p] = a;
        }
      }
    }
  }

  LiteralSurfaces const& surfaces_;
  LiteralLimits const& limits_;
  Grid<int>& labels_;
  std::map<int, int> sizes_;
  std::map<Pair, Border> borders_;
  std::vector<Sample> samples_;
};

}  // namespace

void join_literal_parts(LiteralSurfaces const& surfaces, LiteralLimits const& limits,
                        Grid<int>& labels) {
  Joining joining(surfaces, limits, labels);
  joining.look();
  joining.join();
  joining.sharpen();
}

}  // namespace credo::test
