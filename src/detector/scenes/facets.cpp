#include "detector/scenes/facets.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>

namespace credo {
namespace {

constexpr std::size_t kMostFacets = 6;
constexpr float kSameNormalCosine = 0.95F;
constexpr int kBins = 6;
constexpr int kTurns = 36;
/// A rectangle is as good by so many of its points; the floor has ten thousand.
constexpr std::size_t kRectanglePoints = 300;
/// Points beyond on each side of a rectangle are noise.
constexpr float kTrimmed = 0.02F;

std::size_t bin_of(Eigen::Vector3f const& normal) {
  Eigen::Array3i const bin =
      ((normal.array() + 1.0F) * (0.5F * kBins)).cast<int>().min(kBins - 1).max(0);
  return static_cast<std::size_t>((bin[0] * kBins + bin[1]) * kBins + bin[2]);
}

/// The commonest direction among the normals.
Eigen::Vector3f commonest_normal(std::vector<OrientedPoint> const& points) {
  struct Bin {
    int count = 0;
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  };
  std::array<Bin, static_cast<std::size_t>(kBins * kBins * kBins)> bins;
  for (OrientedPoint const& p : points) {
    Bin& bin = bins[bin_of(p.normal)];
    ++bin.count;
    bin.sum += p.normal;
  }
  Eigen::Vector3f normal = std::ranges::max_element(bins, {}, &Bin::count)->sum.normalized();
  // The cube's bins cut directions anyhow: the mean of what is around settles in two rounds.
  for (int round = 0; round < 2; ++round) {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (OrientedPoint const& p : points) {
      if (p.normal.dot(normal) > kSameNormalCosine) {
        sum += p.normal;
      }
    }
    if (sum.squaredNorm() > 0.0F) {
      normal = sum.normalized();
    }
  }
  return normal;
}

float middle(std::vector<float> values) {
  auto const half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, half);
  return *half;
}

struct Interval {
  float low = 0.0F;
  float high = 0.0F;
};

Interval trimmed(std::vector<float>& values) {
  auto const cut = static_cast<std::ptrdiff_t>(kTrimmed * static_cast<float>(values.size()));
  std::ranges::nth_element(values, values.begin() + cut);
  float const low = values[static_cast<std::size_t>(cut)];
  auto const top = static_cast<std::ptrdiff_t>(values.size()) - 1 - cut;
  std::ranges::nth_element(values, values.begin() + top);
  return {low, values[static_cast<std::size_t>(top)]};
}

/// So many of them, evenly, in their order.
std::vector<Eigen::Vector3f> some_of(std::vector<Eigen::Vector3f> const& points, std::size_t most) {
  std::size_t const count = std::min(points.size(), most);
  std::vector<Eigen::Vector3f> some;
  some.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    some.push_back(points[i * points.size() / count]);
  }
  return some;
}

/// The rectangle of least area, in a plane, that holds points.
void set_rectangle(Facet& facet, std::vector<Eigen::Vector3f> const& points) {
  Eigen::Vector3f const first = facet.normal.unitOrthogonal();
  Eigen::Vector3f const second = facet.normal.cross(first);
  float least_m2 = std::numeric_limits<float>::infinity();
  std::vector<float> along_m(points.size());
  std::vector<float> across_m(points.size());
  for (int turn = 0; turn < kTurns; ++turn) {
    float const angle = 0.5F * std::numbers::pi_v<float> * static_cast<float>(turn) / kTurns;
    Eigen::Vector3f const along = std::cos(angle) * first + std::sin(angle) * second;
    Eigen::Vector3f const across = facet.normal.cross(along);
    for (std::size_t i = 0; i < points.size(); ++i) {
      along_m[i] = along.dot(points[i]);
      across_m[i] = across.dot(points[i]);
    }
    Interval const length = trimmed(along_m);
    Interval const width = trimmed(across_m);
    float const area_m2 = (length.high - length.low) * (width.high - width.low);
    if (area_m2 >= least_m2) {
      continue;
    }
    least_m2 = area_m2;
    facet.centre_m = 0.5F * (length.low + length.high) * along +
                     0.5F * (width.low + width.high) * across +
                     facet.normal * facet.normal.dot(points.front());
    facet.half_length_m = 0.5F * (length.high - length.low);
    facet.half_width_m = 0.5F * (width.high - width.low);
    facet.along = along;
  }
  if (facet.half_width_m > facet.half_length_m) {
    facet.along = facet.across();
    std::swap(facet.half_width_m, facet.half_length_m);
  }
}

/// Takes the commonest flat piece out of the points; none where it is too small.
std::optional<Facet> take_facet(std::vector<OrientedPoint>& points, float tolerance_m,
                                std::size_t least) {
  Facet facet;
  facet.normal = commonest_normal(points);
  std::vector<float> offsets_m;
  for (OrientedPoint const& p : points) {
    if (p.normal.dot(facet.normal) > kSameNormalCosine) {
      offsets_m.push_back(facet.normal.dot(p.point));
    }
  }
  if (offsets_m.size() < least) {
    return std::nullopt;
  }
  float const offset_m = middle(std::move(offsets_m));
  std::vector<Eigen::Vector3f> own;
  std::erase_if(points, [&](OrientedPoint const& p) {
    bool const is_own = p.normal.dot(facet.normal) > kSameNormalCosine &&
                        std::abs(facet.normal.dot(p.point) - offset_m) < tolerance_m;
    if (is_own) {
      own.push_back(p.point);
    }
    return is_own;
  });
  if (own.size() < least) {
    return std::nullopt;
  }
  facet.points = own.size();
  set_rectangle(facet, some_of(own, kRectanglePoints));
  return facet;
}

}  // namespace

std::vector<Facet> facets_of(std::vector<OrientedPoint> points, float tolerance_m, float min_share,
                             std::size_t min_points) {
  auto const share = static_cast<std::size_t>(min_share * static_cast<float>(points.size()));
  std::size_t const least = std::max({share, min_points, std::size_t{1}});
  std::vector<Facet> facets;
  while (facets.size() < kMostFacets && points.size() >= least) {
    std::size_t const before = points.size();
    if (auto const facet = take_facet(points, tolerance_m, least)) {
      facets.push_back(*facet);
    }
    if (points.size() == before) {
      break;
    }
  }
  std::ranges::stable_sort(facets, std::greater{}, &Facet::points);
  return facets;
}

}  // namespace credo
