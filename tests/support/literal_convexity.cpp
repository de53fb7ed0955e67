#include "support/literal_convexity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <map>
#include <optional>
#include <utility>

namespace credo::test {
namespace {

constexpr int kUnits = 16;  // of a quantum
using Ints = Grid<int>;
constexpr std::array<Pixel, 4> kFour = {{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};

/// All numbers of the method as whole units and pixels of this camera.
struct Scaled {
  int link, smooth, smooth_radius, reach, diagonal, reach_units, crease, disc, min_pixels;
  int min_seed, small_pixels, border_pixels;
};

Scaled scaled(double focal_px, SegmentsConfig const& c) {
  double const scale = focal_px / 525.0;
  auto const px = [&](double value) {
    return std::max(1, static_cast<int>(std::lround(value * scale)));
  };
  auto const area = [&](double value) {
    return std::max(1, static_cast<int>(std::lround(value * scale * scale)));
  };
  auto const units = [](double quanta) { return static_cast<int>(std::lround(quanta * kUnits)); };
  return {units(c.link_quanta),
          units(c.smooth_quanta),
          px(c.smooth_radius_px),
          px(c.reach_px),
          px(c.reach_px * 0.7071),
          units(c.reach_quanta),
          units(c.crease_quanta),
          px(c.disc_radius_px),
          area(c.min_pixels),
          area(4),
          area(1000),
          area(400)};
}

struct Literal {
  SegmentsConfig const& config;
  Scaled const k;
  Ints d, s, e, steep;
  Grid<std::uint8_t> wall, thickness;
  Ints labels;
  int next = 1;

  Literal(Grid<float> const& depth_m, double focal_px, SegmentsConfig const& c)
      : config(c),
        k(scaled(focal_px, c)),
        d(depth_m.width(), depth_m.height()),
        s(d),
        e(d),
        steep(d),
        wall(d.width(), d.height()),
        thickness(wall),
        labels(d) {
    auto const per_m = static_cast<float>(kUnits / c.quantum_per_m);
    for (std::size_t i = 0; i < d.size(); ++i) {
      float const z = depth_m[i];
      bool const valid = z > 0.0F && std::isfinite(z);
      d[i] = valid ? static_cast<int>(std::min(per_m / z, 32000.0F) + 0.5F) : 0;
    }
  }
  int at(Ints const& grid, Pixel p) const { return grid.contains(p) ? grid[p] : 0; }
  bool linked(Pixel a, Pixel b) const {
    return at(d, a) > 0 && at(d, b) > 0 && std::abs(at(d, a) - at(d, b)) < k.link;
  }
  template <typename F>
  void each(F const& f) const {
    for (std::size_t i = 0; i < d.size(); ++i)
      f(d.pixel(i));
  }

  void smooth() {
    each([&](Pixel p) {
      int sum = 0, count = 0;
      for (int v = -k.smooth_radius; v <= k.smooth_radius; ++v)
        for (int u = -k.smooth_radius; u <= k.smooth_radius; ++u) {
          int const other = at(d, {p.u + u, p.v + v});
          if (other > 0 && std::abs(other - d[p]) < k.smooth) {
            sum += other - d[p];
            ++count;
          }
        }
      s[p] = d[p] == 0 ? 0
                       : d[p] + static_cast<int>(std::nearbyint(static_cast<float>(sum) /
                                                                static_cast<float>(count)));
    });
  }
  void concavity() {
    std::array<Pixel, 4> const offsets = {
        {{k.reach, 0}, {0, k.reach}, {k.diagonal, k.diagonal}, {k.diagonal, -k.diagonal}}};
    each([&](Pixel p) {
      int const c = s[p];
      if (c == 0)
        return;
      for (Pixel const o : offsets) {
        int const a = at(s, {p.u + o.u, p.v + o.v});
        int const b = at(s, {p.u - o.u, p.v - o.v});
        if (a == 0 || b == 0 || std::abs(a - c) >= k.reach_units ||
            std::abs(b - c) >= k.reach_units)
          continue;
        e[p] = std::max(e[p], a + b - 2 * c);
        steep[p] = std::max(steep[p], std::abs(a - b));
      }
      int far = 0;
      for (Pixel const o : offsets) {
        int const a = at(s, {p.u + 2 * o.u, p.v + 2 * o.v});
        int const b = at(s, {p.u - 2 * o.u, p.v - 2 * o.v});
        if (a > 0 && b > 0 && std::abs(a - c) < k.reach_units && std::abs(b - c) < k.reach_units)
          far = std::max(far, a + b - 2 * c);
      }
      auto const weight = std::min(std::lround(config.far_weight * 32768), 32767L);
      e[p] = std::max(e[p], static_cast<int>(2 * far * weight / 65536));
    });
  }
  void walls() {
    std::vector<int> sample;
    for (int v = 0; v < d.height(); v += 3)
      for (int u = 0; u < d.width(); u += 5)
        if (d[Pixel{u, v}] > 0)
          sample.push_back(e[Pixel{u, v}]);
    std::sort(sample.begin(), sample.end());
    int const n75 = sample.empty()
                        ? 0
                        : sample[sample.size() * 3 / 4 < sample.size() ? sample.size() * 3 / 4
                                                                       : sample.size() - 1];
    int const e0 = std::max(k.crease, static_cast<int>(std::lround(config.crease_noise * n75)));
    each([&](Pixel p) {
      wall[p] =
          d[p] > 0 && e[p] > e0 + static_cast<int>(std::lround(config.crease_slope / 12 * 65536)) *
                                      steep[p] / 65536;
    });
  }
  void thick() {
    each([&](Pixel p) {
      bool solid = d[p] > 0 && !wall[p];
      for (Pixel const o : kFour) {
        Pixel const q{p.u + o.u, p.v + o.v};
        if (at(d, q) > 0 && !linked(p, q))
          solid = false;
      }
      thickness[p] = solid ? 1 : 0;
    });
    for (int level = 1; level < 4; ++level) {
      Grid<std::uint8_t> const before = thickness;
      each([&](Pixel p) {
        if (before[p] != level)
          return;
        bool inner = true;
        for (int v = -1; v <= 1; ++v)
          for (int u = -1; u <= 1; ++u) {
            Pixel const q{p.u + u, p.v + v};
            inner = inner && before.contains(q) && before[q] >= level;
          }
        if (inner)
          thickness[p] = static_cast<std::uint8_t>(level + 1);
      });
    }
  }
  void components(int level, int min_pixels) {
    Ints seen(d.width(), d.height());
    each([&](Pixel start) {
      if (thickness[start] < level || labels[start] > 0 || seen[start] > 0)
        return;
      std::vector<Pixel> part = {start};
      seen[start] = 1;
      for (std::size_t i = 0; i < part.size(); ++i)
        for (Pixel const o : kFour) {
          Pixel const q{part[i].u + o.u, part[i].v + o.v};
          if (d.contains(q) && thickness[q] >= level && labels[q] == 0 && seen[q] == 0) {
            seen[q] = 1;
            part.push_back(q);
          }
        }
      if (static_cast<int>(part.size()) >= min_pixels) {
        for (Pixel const p : part)
          labels[p] = next;
        ++next;
      }
    });
  }
  void grow(int level) {
    std::deque<Pixel> queue;
    each([&](Pixel p) {
      if (labels[p] > 0)
        queue.push_back(p);
    });
    while (!queue.empty()) {
      Pixel const p = queue.front();
      queue.pop_front();
      for (Pixel const o : kFour) {
        Pixel const q{p.u + o.u, p.v + o.v};
        if (d.contains(q) && thickness[q] >= level && labels[q] == 0) {
          labels[q] = labels[p];
          queue.push_back(q);
        }
      }
    }
  }
  void seeds() {
    components(4, k.min_seed);
    for (int level = 3; level >= 1; --level) {
      grow(level);
      components(level, k.min_pixels);
    }
  }
  void flood(bool across_links) {
    std::array<std::deque<Pixel>, 64> buckets;
    Ints key(d.width(), d.height());
    each([&](Pixel p) {
      if (labels[p] > 0)
        buckets[0].push_back(p);
    });
    for (std::size_t b = 0; b < 64; ++b)
      while (!buckets[b].empty()) {
        Pixel const p = buckets[b].front();
        buckets[b].pop_front();
        for (Pixel const o : kFour) {
          Pixel const q{p.u + o.u, p.v + o.v};
          if (at(d, q) == 0 || labels[q] > 0 || (across_links && !linked(p, q)))
            continue;
          labels[q] = labels[p];
          key[q] = std::max(static_cast<int>(b), std::min(63, e[q] * 2 / kUnits));
          buckets[static_cast<std::size_t>(key[q])].push_back(q);
        }
      }
  }
  struct Edge {
    double tot = 0, w = 0, n = 0, u = 0;
  };
  struct Fit {
    double a = 0, bu = 0, bv = 0, rms = 0, mean_u = 0, mean_v = 0;
    double at(double u, double v) const { return a + bu * (u - mean_u) + bv * (v - mean_v); }
  };
  struct Sample {
    Pixel p, q;
    Fit fit_a, fit_b;
  };
  static double len(double a, double b) { return std::sqrt(a * a + b * b); }
  using Point = std::array<double, 3>;
  static std::optional<Fit> plane(std::vector<Point> const& points) {
    if (points.size() < 20)
      return std::nullopt;
    auto const n = static_cast<double>(points.size());
    double su = 0, sv = 0, sd = 0, suu = 0, suv = 0, svv = 0, sud = 0, svd = 0, sdd = 0;
    for (auto const& [u, v, z] : points) {
      su += u;
      sv += v;
      sd += z;
      suu += u * u;
      suv += u * v;
      svv += v * v;
      sud += u * z;
      svd += v * z;
      sdd += z * z;
    }
    Fit f;
    f.mean_u = su / n;
    f.mean_v = sv / n;
    f.a = sd / n;
    double const cuu = suu / n - f.mean_u * f.mean_u + 0.3,
                 cvv = svv / n - f.mean_v * f.mean_v + 0.3;
    double const cuv = suv / n - f.mean_u * f.mean_v, cud = sud / n - f.mean_u * f.a,
                 cvd = svd / n - f.mean_v * f.a;
    double const det = cuu * cvv - cuv * cuv;
    f.bu = (cud * cvv - cvd * cuv) / det;
    f.bv = (cvd * cuu - cud * cuv) / det;
    double const cdd = sdd / n - f.a * f.a;
    f.rms = std::sqrt(std::max(0.0, cdd - f.bu * cud - f.bv * cvd));
    return f;
  }
  std::map<std::pair<int, int>, Edge> edges;
  std::vector<Sample> samples;
  void sample(Edge& edge, Pixel p, Pixel q) {
    int const a = labels[p], b = labels[q];
    std::vector<Point> pa, pb;
    for (int v = -k.disc; v <= k.disc; v += 2)
      for (int u = -k.disc; u <= k.disc; u += 2) {
        if (u * u + v * v > k.disc * k.disc)
          continue;
        Pixel const r{p.u + u, p.v + v};
        if (at(d, r) == 0)
          continue;
        Point const point = {static_cast<double>(u), static_cast<double>(v),
                             static_cast<double>(d[r]) / kUnits};
        if (labels[r] == a)
          pa.push_back(point);
        if (labels[r] == b)
          pb.push_back(point);
      }
    auto const fa = plane(pa), fb = plane(pb);
    if (!fa || !fb)
      return;
    double const sg = len(fa->rms, fb->rms);
    double const step = std::abs(fa->at(0, 0) - fb->at(0, 0));
    double const gm = std::max(len(fa->bu, fa->bv), len(fb->bu, fb->bv));
    double const c =
        ((fb->a - fa->at(fb->mean_u, fb->mean_v)) + (fa->a - fb->at(fa->mean_u, fa->mean_v))) / 2;
    bool const connected = step < 3 + 3 * sg + gm && c < 1 + 0.6 * sg;
    edge.n += 1;
    edge.u += connected ? 0 : 1;
    samples.push_back({p, q, *fa, *fb});
  }
  void graph() {
    each([&](Pixel p) {
      for (Pixel const o : {Pixel{1, 0}, Pixel{0, 1}}) {
        Pixel const q{p.u + o.u, p.v + o.v};
        if (!d.contains(q) || labels[p] == 0 || labels[q] == 0 || labels[p] == labels[q])
          continue;
        Edge& edge = edges[{std::min(labels[p], labels[q]), std::max(labels[p], labels[q])}];
        edge.tot += 1;
        edge.w += !linked(p, q) || wall[p] || wall[q] ? 1 : 0;
        if (static_cast<int>(edge.tot) % 3 == 1)
          sample(edge, p, q);
      }
    });
  }
  std::vector<int> root;
  std::vector<int> size;
  void merge() {
    root.resize(static_cast<std::size_t>(next));
    size.assign(static_cast<std::size_t>(next), 0);
    for (int i = 0; i < next; ++i)
      root[static_cast<std::size_t>(i)] = i;
    for (int const l : labels)
      ++size[static_cast<std::size_t>(l)];
    while (true) {
      double best = 0.5;
      std::pair<int, int> pair{0, 0};
      for (auto const& [ab, edge] : edges) {
        if (edge.tot < 8)
          continue;
        double score =
            edge.n > 0 ? 0.3 * (edge.w / edge.tot) + 0.7 * (edge.u / edge.n) : edge.w / edge.tot;
        int const smaller = std::min(size[static_cast<std::size_t>(ab.first)],
                                     size[static_cast<std::size_t>(ab.second)]);
        score -= smaller < k.small_pixels ? 0.1 : 0.0;
        if (score < best) {
          best = score;
          pair = ab;
        }
      }
      if (pair.second == 0)
        break;
      auto const [into, from] = pair;
      size[static_cast<std::size_t>(into)] += size[static_cast<std::size_t>(from)];
      for (int& r : root)
        r = r == from ? into : r;
      std::map<std::pair<int, int>, Edge> joined;
      for (auto const& [ab, edge] : edges) {
        int a = ab.first == from ? into : ab.first, b = ab.second == from ? into : ab.second;
        if (a == b)
          continue;
        Edge& e2 = joined[{std::min(a, b), std::max(a, b)}];
        e2.tot += edge.tot;
        e2.w += edge.w;
        e2.n += edge.n;
        e2.u += edge.u;
      }
      edges = std::move(joined);
    }
    for (int& l : labels)
      l = root[static_cast<std::size_t>(l)];
  }
  void border() {
    for (Sample const& sample : samples) {
      int const a = labels[sample.p], b = labels[sample.q];
      if (a == b || size[static_cast<std::size_t>(a)] < k.border_pixels ||
          size[static_cast<std::size_t>(b)] < k.border_pixels)
        continue;
      for (int v = -1; v <= 1; ++v)
        for (int u = -1; u <= 1; ++u) {
          Pixel const r{sample.p.u + u, sample.p.v + v};
          if (!d.contains(r) || (labels[r] != a && labels[r] != b))
            continue;
          double const value = static_cast<double>(d[r]) / kUnits;
          double const ra = std::abs(value - sample.fit_a.at(u, v)),
                       rb = std::abs(value - sample.fit_b.at(u, v));
          if (labels[r] == a && rb + 1 < ra)
            labels[r] = b;
          else if (labels[r] == b && ra + 1 < rb)
            labels[r] = a;
        }
    }
  }
  Segments result() {
    Segments out;
    out.labels = Grid<std::int32_t>(d.width(), d.height());
    std::map<int, std::int32_t> numbers;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      if (labels[i] == 0)
        continue;
      auto const [it, is_new] =
          numbers.try_emplace(labels[i], static_cast<std::int32_t>(numbers.size() + 1));
      if (is_new)
        out.pixel_counts.push_back(0);
      ++out.pixel_counts[static_cast<std::size_t>(it->second - 1)];
      out.labels[i] = it->second;
    }
    return out;
  }
};

}  // namespace

Segments literal_convex_segments(Grid<float> const& depth_m, double focal_px,
                                 SegmentsConfig const& config) {
  Literal l(depth_m, focal_px, config);
  l.smooth();
  l.concavity();
  l.walls();
  l.thick();
  l.seeds();
  l.flood(true);
  l.flood(false);
  l.graph();
  l.merge();
  l.border();
  return l.result();
}

}  // namespace credo::test
