#include "support/literal_clustering.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <queue>
#include <vector>

namespace credo::test {
namespace {

// Points that have no cluster yet, in cubes a little larger than the radius: whatever lies within
// the radius of a point is in its cube or in the 26 around it.
class LonelyPoints {
public:
  explicit LonelyPoints(float radius_m) : edge_m_(1.001 * static_cast<double>(radius_m) + 1e-9) {}

  void add(Eigen::Vector3f const& point, std::size_t i) { cubes_[cube_of(point)].push_back(i); }

  template <typename Predicate>
  std::vector<std::size_t> take_near(Eigen::Vector3f const& point, Predicate const& joins) {
    std::vector<std::size_t> taken;
    Cube const center = cube_of(point);
    for (int k = 0; k < 27; ++k) {
      auto const found =
          cubes_.find({center[0] + k % 3 - 1, center[1] + k / 3 % 3 - 1, center[2] + k / 9 - 1});
      if (found == cubes_.end()) {
        continue;
      }
      auto const rest = std::partition(found->second.begin(), found->second.end(),
                                       [&](std::size_t i) { return !joins(i); });
      taken.insert(taken.end(), rest, found->second.end());
      found->second.erase(rest, found->second.end());
    }
    return taken;
  }

private:
  using Cube = std::array<long, 3>;

  [[nodiscard]] Cube cube_of(Eigen::Vector3f const& point) const {
    auto const cell = [this](float value) {
      return static_cast<long>(std::floor(static_cast<double>(value) / edge_m_));
    };
    return {cell(point.x()), cell(point.y()), cell(point.z())};
  }

  double edge_m_;
  std::map<Cube, std::vector<std::size_t>> cubes_;
};

}  // namespace

Grid<std::int32_t> literal_components(OrganizedCloud const& cloud, NormalMap const& normals,
                                      Grid<std::uint8_t> const& active,
                                      ReachabilityLimits const& limits) {
  ReachThresholds const reach(limits);
  auto const takes_part = [&](std::size_t i) {
    return active[i] != 0 && cloud.at(i).allFinite() && normals.at(i).allFinite();
  };
  LonelyPoints lonely(limits.radius_m);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (takes_part(i)) {
      lonely.add(cloud.at(i), i);
    }
  }
  Grid<std::int32_t> components(cloud.width(), cloud.height(), kNoComponent);
  std::int32_t count = 0;
  for (std::size_t seed = 0; seed < cloud.size(); ++seed) {
    if (!takes_part(seed) || components[seed] != kNoComponent) {
      continue;
    }
    std::queue<std::size_t> queue;
    for (std::size_t i : lonely.take_near(cloud.at(seed), [&](auto j) { return j == seed; })) {
      components[i] = count;
      queue.push(i);
    }
    for (; !queue.empty(); queue.pop()) {
      std::size_t const p = queue.front();
      auto const joins = [&](std::size_t q) {
        return within_reach(cloud.at(p), normals.at(p), cloud.at(q), normals.at(q), reach);
      };
      for (std::size_t q : lonely.take_near(cloud.at(p), joins)) {
        components[q] = count;
        queue.push(q);
      }
    }
    ++count;
  }
  return components;
}

}  // namespace credo::test
