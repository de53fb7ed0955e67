// Frames that no camera sees: many components side by side, everywhere. The literal algorithm takes
// minutes on them, but what comes out is known.
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "geometry/reachability/reachability.hpp"
#include "support/literal_clustering.hpp"

namespace credo {
namespace {

using Components = Grid<std::int32_t>;
using Pattern = Grid<std::size_t>;

// Unit vectors more than the greatest angle apart.
std::vector<Eigen::Vector3f> far_directions(std::size_t count) {
  std::mt19937 engine(3);
  std::normal_distribution<float> normal;
  std::vector<Eigen::Vector3f> directions;
  while (directions.size() < count) {
    Eigen::Vector3f const next =
        Eigen::Vector3f(normal(engine), normal(engine), normal(engine)).normalized();
    bool far = true;
    for (Eigen::Vector3f const& direction : directions) {
      far = far && direction.dot(next) < std::cos(0.31F);
    }
    if (far) {
      directions.push_back(next);
    }
  }
  return directions;
}

Pattern pattern_of(int width, int height, std::function<std::size_t(int, int)> const& direction) {
  Pattern pattern(width, height);
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    pattern[i] = direction(pattern.pixel(i).u, pattern.pixel(i).v);
  }
  return pattern;
}

// A board across the view whose normals are those of the pattern.
struct Board {
  Board(Pattern const& pattern, float depth_m)
      : cloud(pattern.width(), pattern.height()),
        normals(pattern.width(), pattern.height()),
        active(pattern.width(), pattern.height(), 1) {
    std::vector<Eigen::Vector3f> const directions = far_directions(64);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      Pixel const p = pattern.pixel(i);
      cloud.set(i, depth_m * Eigen::Vector3f(static_cast<float>(p.u - 320) / 525.0F,
                                             static_cast<float>(p.v - 240) / 525.0F, 1.0F));
      normals.set(i, directions[pattern[i]]);
    }
  }
  [[nodiscard]] Components components() const {
    return connected_components(cloud, normals, active, {});
  }

  OrganizedCloud cloud;
  NormalMap normals;
  Grid<std::uint8_t> active;
};

// Every direction is one component, numbered by its first pixel.
Components one_component_a_direction(Pattern const& pattern) {
  Components components(pattern.width(), pattern.height());
  std::vector<std::int32_t> number(64, kNoComponent);
  std::int32_t count = 0;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    std::int32_t& of_direction = number[pattern[i]];
    if (of_direction == kNoComponent) {
      of_direction = count++;
    }
    components[i] = of_direction;
  }
  return components;
}

std::vector<Pattern> patterns(int width, int height) {
  std::mt19937 engine(4);
  return {
      pattern_of(width, height, [](int, int) { return 0; }),
      pattern_of(width, height, [](int u, int v) { return static_cast<std::size_t>((u + v) % 2); }),
      pattern_of(width, height,
                 [](int u, int v) { return static_cast<std::size_t>(u % 2 + 2 * (v % 2)); }),
      pattern_of(width, height,
                 [](int u, int v) { return static_cast<std::size_t>(u % 8 + 8 * (v % 8)); }),
      pattern_of(width, height, [&](int, int) { return std::size_t{engine() % 64}; }),
  };
}

// Close by, where the radius takes in a thirteenth of the image.
TEST(ComponentsOfPatterns, AreFoundInAWholeFrame) {
  for (Pattern const& pattern : patterns(640, 480)) {
    EXPECT_TRUE(Board(pattern, 0.3F).components() == one_component_a_direction(pattern));
  }
}

TEST(ComponentsOfPatterns, AreTheLiteralAlgorithmWhereTheyFallApart) {
  for (float const depth_m : {0.5F, 3.0F, 9.0F}) {
    for (Pattern const& pattern : patterns(70, 50)) {
      Board const board(pattern, depth_m);
      EXPECT_TRUE(board.components() ==
                  test::literal_components(board.cloud, board.normals, board.active, {}))
          << depth_m << " m";
    }
  }
}

TEST(ComponentRuns, CoverTheComponentsInRasterOrder) {
  Board board(patterns(70, 50)[4], 2.0F);
  for (std::size_t i = 0; i < board.active.size(); i += 7) {
    board.active[i] = 0;
  }
  Components painted(70, 50, kNoComponent);
  int last_end = 0;
  for (ComponentRun const& run : component_runs(board.cloud, board.normals, board.active, {})) {
    EXPECT_GE(run.v * 70 + run.begin, last_end);
    EXPECT_LT(run.begin, run.end);
    EXPECT_LE(run.end, 70);
    last_end = run.v * 70 + run.end;
    for (int u = run.begin; u < run.end; ++u) {
      painted[{u, run.v}] = run.component;
    }
  }
  EXPECT_TRUE(painted == board.components());
}

}  // namespace
}  // namespace credo
