#include "geometry/reachability/reachability.hpp"

#include <gmock/gmock.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>
#include <vector>

#include "support/literal_clustering.hpp"

namespace credo {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using Components = Grid<std::int32_t>;

constexpr float kInf = std::numeric_limits<float>::infinity();

struct Scene {
  Scene(int width, int height)
      : cloud(width, height), normals(width, height), active(width, height, 1) {}

  OrganizedCloud cloud;
  NormalMap normals;
  Grid<std::uint8_t> active;
  ReachabilityLimits limits;
};

Components components_of(Scene const& scene) {
  return connected_components(scene.cloud, scene.normals, scene.active, scene.limits);
}

void expect_literal(Scene const& scene) {
  Components const expected =
      test::literal_components(scene.cloud, scene.normals, scene.active, scene.limits);
  EXPECT_TRUE(components_of(scene) == expected)
      << scene.cloud.width() << "x" << scene.cloud.height() << ", radius " << scene.limits.radius_m
      << ", angle " << scene.limits.max_angle_rad << ", "
      << *std::max_element(expected.begin(), expected.end()) + 1 << " components expected";
}

class Random {
public:
  explicit Random(unsigned seed) : engine_(seed) {}
  float uniform(float min, float max) {
    return min + (max - min) * std::uniform_real_distribution<float>()(engine_);
  }
  int integer(int min, int max) { return std::uniform_int_distribution<int>(min, max)(engine_); }
  bool chance(float probability) { return uniform(0.0F, 1.0F) < probability; }
  Eigen::Vector3f vector(float spread) {
    std::normal_distribution<float> normal(0.0F, spread);
    return {normal(engine_), normal(engine_), normal(engine_)};
  }
  std::mt19937& engine() { return engine_; }

private:
  std::mt19937 engine_;
};

// Points anywhere in a cube, normals around a few directions, some of everything missing.
Scene random_scene(Random& random, int width, int height) {
  Scene scene(width, height);
  float const edge_m = random.uniform(0.02F, 1.0F);
  scene.limits = {.radius_m = random.uniform(0.0F, 0.2F),
                  .max_angle_rad = random.uniform(0.0F, 1.0F)};
  for (std::size_t i = 0; i < scene.cloud.size(); ++i) {
    if (!random.chance(0.1F)) {
      scene.cloud.set(i, {random.uniform(0.0F, edge_m), random.uniform(0.0F, edge_m),
                          1.0F + random.uniform(0.0F, edge_m)});
    }
    if (!random.chance(0.1F)) {
      Eigen::Vector3f const main = -Eigen::Vector3f::Unit(random.integer(0, 2));
      scene.normals.set(i, (main + random.vector(0.2F)).normalized());
    }
    scene.active[i] = random.chance(0.9F) ? static_cast<std::uint8_t>(random.integer(1, 255)) : 0;
  }
  return scene;
}

struct Ball {
  Eigen::Vector3f center;
  float radius_m = 0.0F;
};

// Depth and true normal of floor, wall and balls along one ray (z = 1).
struct Hit {
  float depth_m = kInf;
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
};

Hit hit_along(Eigen::Vector3f const& ray, std::vector<Ball> const& balls) {
  Hit hit{.depth_m = 3.0F, .normal = -Eigen::Vector3f::UnitZ()};
  if (ray.y() > 0.0F && 0.8F / ray.y() < hit.depth_m) {
    hit = {.depth_m = 0.8F / ray.y(), .normal = -Eigen::Vector3f::UnitY()};
  }
  for (Ball const& ball : balls) {
    float const a = ray.squaredNorm();
    float const b = ray.dot(ball.center);
    float const discriminant =
        b * b - a * (ball.center.squaredNorm() - ball.radius_m * ball.radius_m);
    if (discriminant > 0.0F && (b - std::sqrt(discriminant)) / a < hit.depth_m) {
      hit.depth_m = (b - std::sqrt(discriminant)) / a;
      hit.normal = (hit.depth_m * ray - ball.center).normalized();
    }
  }
  return hit;
}

// A room as a depth camera sees it: noise and steps that grow with depth, noisy normals, holes.
Scene room_scene(Random& random, int width, int height) {
  Scene scene(width, height);
  auto const focal_px = 0.9F * static_cast<float>(width);
  std::vector<Ball> balls(12);
  for (Ball& ball : balls) {
    ball.center = {random.uniform(-1.0F, 1.0F), random.uniform(-0.6F, 0.8F),
                   random.uniform(0.7F, 2.8F)};
    ball.radius_m = random.uniform(0.02F, 0.25F);
  }
  for (std::size_t i = 0; i < scene.cloud.size(); ++i) {
    Pixel const pixel = scene.active.pixel(i);
    Eigen::Vector3f const ray(
        (static_cast<float>(pixel.u) - 0.5F * static_cast<float>(width)) / focal_px,
        (static_cast<float>(pixel.v) - 0.5F * static_cast<float>(height)) / focal_px, 1.0F);
    Hit const hit = hit_along(ray, balls);
    float const noise_m = random.vector(0.002F * hit.depth_m * hit.depth_m).x();
    float const depth_m = std::round((hit.depth_m + noise_m) / 0.003F) * 0.003F;
    if (!random.chance(0.02F)) {
      scene.cloud.set(i, depth_m * ray);
      scene.normals.set(i, (hit.normal + random.vector(0.1F)).normalized());
    }
    if (random.chance(0.02F)) {
      scene.normals.set(i, Eigen::Vector3f::Constant(kNaN));
    }
  }
  return scene;
}

Scene permuted(Scene const& scene, std::vector<std::size_t> const& source) {
  Scene result = scene;
  for (std::size_t i = 0; i < source.size(); ++i) {
    result.cloud.set(i, scene.cloud.at(source[i]));
    result.normals.set(i, scene.normals.at(source[i]));
    result.active[i] = scene.active[source[i]];
  }
  return result;
}

// Points in a row along x, all with one normal.
Scene row_of_points(int count, float spacing_m) {
  Scene scene(count, 1);
  for (int u = 0; u < count; ++u) {
    scene.cloud.set(static_cast<std::size_t>(u), {static_cast<float>(u) * spacing_m, 0.0F, 1.0F});
    scene.normals.set(static_cast<std::size_t>(u), -Eigen::Vector3f::UnitZ());
  }
  return scene;
}

TEST(ConnectedComponents, NumbersByFirstPixelInRasterOrder) {
  Scene scene = row_of_points(5, 0.04F);
  scene.cloud.x[0] = 9.0F;
  scene.cloud.x[3] = 7.0F;
  EXPECT_THAT(components_of(scene), ElementsAre(0, 1, 1, 2, 3));
  scene.cloud.x[4] = 9.01F;
  EXPECT_THAT(components_of(scene), ElementsAre(0, 1, 1, 2, 0));
}

TEST(ConnectedComponents, LeavesOutWhatIsInactiveOrInvalid) {
  Scene scene = row_of_points(8, 0.01F);
  scene.active[0] = 0;
  scene.cloud.y[2] = kNaN;
  scene.normals.z[4] = kNaN;
  scene.cloud.z[5] = kInf;
  scene.normals.x[6] = -kInf;
  EXPECT_THAT(components_of(scene), ElementsAre(-1, 0, -1, 0, -1, -1, -1, 0));
}

TEST(ConnectedComponents, TakesADistanceOfExactlyTheRadiusAndNoMore) {
  for (int const count : {2, 9, 40, 700}) {
    Scene scene = row_of_points(count, 0.0625F);
    scene.limits.radius_m = 0.0625F;
    EXPECT_THAT(components_of(scene), Each(0));
    scene.limits.radius_m = std::nextafter(0.0625F, 0.0F);
    EXPECT_EQ(components_of(scene)[static_cast<std::size_t>(count) - 1], count - 1);
  }
}

TEST(ConnectedComponents, RefusesAnAngleOfExactlyTheLimit) {
  Scene scene = row_of_points(2, 0.01F);
  scene.normals.set(1, {0.0F, -1.0F, 0.0F});
  scene.limits.max_angle_rad = std::acos(0.0F);
  ReachThresholds const reach(scene.limits);
  // A second normal whose cosine to the first is the limit to the last bit, then one step inside.
  scene.normals.set(1, {0.0F, 1.0F, -reach.min_cosine});
  EXPECT_THAT(components_of(scene), ElementsAre(0, 1));
  scene.normals.set(1, {0.0F, 1.0F, -std::nextafter(reach.min_cosine, 1.0F)});
  EXPECT_THAT(components_of(scene), ElementsAre(0, 0));
}

TEST(ConnectedComponents, JoinsNeighboursInSpaceThatAreFarApartInTheImage) {
  Scene scene(640, 480);
  std::size_t const last = scene.cloud.size() - 1;
  for (std::size_t i : {std::size_t{0}, last}) {
    scene.cloud.set(i, {0.01F * static_cast<float>(i % 2), 0.0F, 1.0F});
    scene.normals.set(i, -Eigen::Vector3f::UnitZ());
  }
  EXPECT_EQ(components_of(scene)[0], 0);
  EXPECT_EQ(components_of(scene)[last], 0);
}

TEST(ConnectedComponents, IsTheLiteralAlgorithmOnRandomPoints) {
  Random random(1);
  for (int round = 0; round < 400; ++round) {
    expect_literal(random_scene(random, random.integer(1, 45), random.integer(1, 40)));
  }
}

TEST(ConnectedComponents, IsTheLiteralAlgorithmOnRooms) {
  Random random(2);
  for (int round = 0; round < 30; ++round) {
    Scene scene = room_scene(random, random.integer(60, 200), random.integer(40, 160));
    scene.limits = {.radius_m = random.uniform(0.005F, 0.1F),
                    .max_angle_rad = random.uniform(0.05F, 0.5F)};
    expect_literal(scene);
  }
  expect_literal(room_scene(random, 640, 480));
}

TEST(ConnectedComponents, NeedsNoProjection) {
  Random random(3);
  Scene const scene = room_scene(random, 112, 84);
  std::vector<std::size_t> source(scene.cloud.size());

  // Registered to another camera: pixels far from where this camera would see them.
  for (std::size_t i = 0; i < source.size(); ++i) {
    Pixel const pixel = scene.active.pixel(i);
    source[i] = scene.active.index({(pixel.u + 7 * (pixel.v % 9)) % 112, 83 - pixel.v});
  }
  expect_literal(permuted(scene, source));

  std::iota(source.begin(), source.end(), 0U);
  std::shuffle(source.begin(), source.end(), random.engine());
  expect_literal(permuted(scene, source));

  // Stretched, as wrong focal lengths do.
  Scene stretched = scene;
  std::transform(scene.cloud.x.begin(), scene.cloud.x.end(), stretched.cloud.x.begin(),
                 [](float x) { return 0.3F * x; });
  expect_literal(stretched);
}

TEST(ConnectedComponents, HoldsForNonsenseNormals) {
  Random random(4);
  Scene scene = room_scene(random, 120, 90);
  for (float const angle_rad : {0.01F, 0.3F, 1.0F, 3.0F}) {
    scene.limits.max_angle_rad = angle_rad;
    for (std::size_t i = 0; i < scene.normals.size(); ++i) {
      scene.normals.set(i, random.vector(1.0F).normalized());
    }
    expect_literal(scene);
    for (std::size_t i = 0; i < scene.normals.size(); ++i) {
      scene.normals.set(i, random.uniform(0.0F, 3.0F) * scene.normals.at(i));
    }
    expect_literal(scene);
  }
  for (std::size_t i = 0; i < scene.normals.size(); i += 5) {
    scene.normals.set(i, Eigen::Vector3f::Zero());
    scene.normals.set((i + 1) % scene.normals.size(), {1e30F, -1e30F, 1e30F});
    scene.normals.set((i + 2) % scene.normals.size(), {kInf, 0.0F, 0.0F});
  }
  expect_literal(scene);
}

TEST(ConnectedComponents, DoesNotDependOnTheScanOrder) {
  Random random(5);
  Scene const scene = room_scene(random, 200, 150);
  std::vector<std::size_t> mirrored(scene.cloud.size());
  std::iota(mirrored.rbegin(), mirrored.rend(), 0U);
  Components const there = components_of(scene);
  Components const back = components_of(permuted(scene, mirrored));
  // The same partition: numbers correspond one to one.
  std::vector<std::int32_t> other(there.size(), kNoComponent);
  std::vector<std::int32_t> one(there.size(), kNoComponent);
  for (std::size_t i = 0; i < there.size(); ++i) {
    std::int32_t const a = there[i];
    std::int32_t const b = back[mirrored[i]];
    ASSERT_EQ(a == kNoComponent, b == kNoComponent);
    if (a != kNoComponent) {
      other[static_cast<std::size_t>(a)] = b;
      one[static_cast<std::size_t>(b)] = a;
    }
  }
  for (std::size_t i = 0; i < there.size(); ++i) {
    if (there[i] != kNoComponent) {
      ASSERT_EQ(other[static_cast<std::size_t>(there[i])], back[mirrored[i]]);
      ASSERT_EQ(one[static_cast<std::size_t>(back[mirrored[i]])], there[i]);
    }
  }
}

// Every instruction set that this machine can run, from the plainest to the widest.
TEST(ConnectedComponents, IsTheSameOnEveryInstructionSet) {
  Random random(6);
  std::vector<Scene> scenes;
  std::vector<Components> expected;
  for (int const width : {9, 10, 63, 64, 65, 200}) {
    for (Scene const& scene : {random_scene(random, width, 30), room_scene(random, width, 90)}) {
      scenes.push_back(scene);
      expected.push_back(
          test::literal_components(scene.cloud, scene.normals, scene.active, scene.limits));
    }
  }
  for (std::int64_t const target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      EXPECT_TRUE(components_of(scenes[i]) == expected[i])
          << hwy::TargetName(target) << ", scene " << i;
    }
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

TEST(ConnectedComponents, DegenerateSizes) {
  EXPECT_TRUE(components_of(Scene(0, 0)).empty());
  EXPECT_TRUE(components_of(Scene(0, 7)).empty());
  EXPECT_TRUE(components_of(Scene(7, 0)).empty());
  EXPECT_THAT(components_of(Scene(1, 1)), ElementsAre(kNoComponent));
  EXPECT_THAT(components_of(Scene(33, 17)), Each(kNoComponent));
  EXPECT_THAT(components_of(row_of_points(1, 0.0F)), ElementsAre(0));
  Random random(7);
  for (int const length : {1, 7, 8, 9, 63, 64, 65, 129}) {
    expect_literal(random_scene(random, length, 1));
    expect_literal(random_scene(random, 1, length));
  }
}

TEST(ConnectedComponents, RefusesABrokenContract) {
  Scene scene = row_of_points(4, 0.01F);
  scene.active = Grid<std::uint8_t>(3, 1);
  EXPECT_THROW(components_of(scene), std::logic_error);
  for (ReachabilityLimits const& limits :
       std::vector<ReachabilityLimits>{{.radius_m = -0.1F},
                                       {.radius_m = kNaN},
                                       {.max_angle_rad = kNaN},
                                       {.max_angle_rad = 4.0F}}) {
    EXPECT_THROW(ReachThresholds{limits}, std::logic_error);
  }
}

}  // namespace
}  // namespace credo
