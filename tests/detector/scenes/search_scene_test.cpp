#include "detector/scenes/search_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "detector/scenes/scene_of_frame.hpp"
#include "detector/views.hpp"

namespace credo::test {
namespace {

using Eigen::Vector3f;

TEST(SearchScene, TheDeskIsALargePlane) {
  BracketView const view = bracket_on_desk(0.4);
  SearchScene const& scene = view.scene;
  Se3 const T_camera_world = before_desk().inverse();
  Vector3f const up = (T_camera_world.rotation() * Eigen::Vector3d::UnitZ()).cast<float>();
  float const offset_m = up.dot(T_camera_world.translation().cast<float>());
  auto const desk = std::ranges::find_if(scene.planes, [&](ScenePlane const& plane) {
    return plane.normal_camera.dot(up) > 0.999F && std::abs(plane.offset_m - offset_m) < 0.005F;
  });
  ASSERT_NE(desk, scene.planes.end());
  EXPECT_GT(desk->extent_m, 0.7F);
  auto const position = static_cast<std::uint8_t>(desk - scene.planes.begin());
  // A place on the desk beside the bracket.
  Eigen::Vector3d const p = T_camera_world * Eigen::Vector3d(0.3, 0.1, 0.0);
  Pixel const pixel{static_cast<int>(std::lround(525.0 * p.x() / p.z() + 319.5)),
                    static_cast<int>(std::lround(525.0 * p.y() / p.z() + 239.5))};
  ScenePixel const& seen = scene.pixels[pixel];
  EXPECT_EQ(seen.plane, position);
  EXPECT_GT(seen.normal_camera().dot(up), 0.98F);
  EXPECT_NEAR(seen.depth_m, p.z(), 0.01);
  EXPECT_LT((scene.point_at(pixel) - p.cast<float>()).norm(), 0.01F);
  EXPECT_TRUE(scene.is_background(seen, 0.2F));
  EXPECT_FALSE(scene.is_background(seen, 1.5F)) << "a thing that is larger than the desk";
}

TEST(SearchScene, SegmentsAreCountedAndMeasured) {
  BracketView const view = bracket_on_desk(0.4);
  std::vector<int> counts(view.scene.segments.size(), 0);
  for (ScenePixel const& pixel : view.scene.pixels) {
    if (pixel.segment > 0 && pixel.depth_m > 0.0F) {
      ++counts.at(pixel.segment - 1U);
    }
  }
  for (std::size_t i = 0; i < counts.size(); ++i) {
    EXPECT_EQ(view.scene.segments[i].pixels, counts[i]);
  }
  // The bracket's own segment is about where it is, and as large.
  Vector3f const centre = view.truth * prepared_bracket().centre_model;
  EXPECT_TRUE(std::ranges::any_of(view.scene.segments, [&](SceneSegment const& segment) {
    return (segment.centre_m - centre).norm() < 0.05F && segment.extent_m > 0.08F &&
           segment.extent_m < 0.3F && segment.area_m2 > 0.005F && segment.area_m2 < 0.04F;
  }));
}

TEST(SearchScene, OfASquareTheAreaIsItsOwnAtAnySlant) {
  for (double const slant : {0.0, 0.6, 1.0}) {
    ObjectModel const plate{
        "plate", std::vector<Solid>{BoxSolid{{-0.15, -0.15, 0.0}, {0.15, 0.15, 0.002}}}, {}};
    Se3 const pose(Eigen::Quaterniond(Eigen::AngleAxisd(slant, Eigen::Vector3d::UnitX())),
                   {0, 0, 1.0});
    SearchScene const scene = scene_of(*frame_of({{plate, pose}}, {}));
    ASSERT_EQ(scene.segments.size(), 1U);
    EXPECT_NEAR(scene.segments[0].area_m2, 0.09F, 0.009F) << slant;
    EXPECT_NEAR(scene.segments[0].extent_m, 0.3F, 0.045F) << slant;
  }
}

TEST(SearchScene, WithoutDepthIsEmpty) {
  Frame frame;
  frame.cloud_camera = cloud_from_depth(Grid<float>(64, 48, 0.0F), frame.intrinsics);
  SearchScene const scene = scene_of(frame);
  EXPECT_EQ(scene.pixels.width(), 64);
  EXPECT_TRUE(scene.segments.empty());
  EXPECT_TRUE(scene.planes.empty());
  EXPECT_TRUE(scene.facets.empty());
  SearchScene const nothing = prepare_scene({}, frame.intrinsics, NormalMap(0, 0), Segments{});
  EXPECT_TRUE(nothing.pixels.empty());
}

TEST(SearchScene, DepthThatIsNoneIsNone) {
  float const nan = std::numeric_limits<float>::quiet_NaN();
  float const infinite = std::numeric_limits<float>::infinity();
  Grid<float> const depth_m(4, 1, {nan, infinite, -1.0F, 0.7F});
  SearchScene const scene = prepare_scene(depth_m, {}, NormalMap(4, 1), Segments{});
  for (int u = 0; u < 3; ++u) {
    EXPECT_EQ((scene.pixels[Pixel{u, 0}].depth_m), 0.0F);
    EXPECT_FALSE((scene.pixels[Pixel{u, 0}].has_normal()));
  }
  EXPECT_EQ((scene.pixels[Pixel{3, 0}].depth_m), 0.7F);
}

}  // namespace
}  // namespace credo::test
