// Planes that segments suggest, and what becomes of them.
#include "stages/planes/segment_planes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "stages/planes/plane_sample.hpp"
#include "stages/planes/small_shots.hpp"

namespace credo::test {
namespace {

/// In the world, normals up or towards +x or +y.
std::vector<Plane> suggested(Shot const& shot, Segments const& segments, bool floor_at_zero,
                             PlanesConfig const& config = small_planes()) {
  PlaneView const view = plane_view_of(shot, segments, config, floor_at_zero);
  CountedPixels const& valid = view.valid;
  PlaneSearchPoints const sample = sample_of(valid, 4096, view.cloud, shot.normals, view.tolerance);
  double const pixels_per_point =
      static_cast<double>(valid.count) / std::max(1.0, static_cast<double>(sample.size()));
  std::vector<Plane> planes = segment_planes(view, segments, sample, pixels_per_point);
  for (Plane& plane : planes) {
    plane = transformed(shot.T_world_camera, plane);
    plane = plane.normal.sum() < 0.0 ? plane.flipped() : plane;
  }
  return planes;
}

bool has_plane(std::vector<Plane> const& planes, Plane const& wanted) {
  return std::ranges::any_of(planes, [&](Plane const& plane) {
    return plane.normal.dot(wanted.normal) > 0.9999 &&
           std::abs(plane.offset_m - wanted.offset_m) < 0.01;
  });
}

Segmentation planes_of(Shot const& shot, SegmentOf const& segment_of) {
  Segmentation segmentation = shot.unassigned();
  segmentation.segments = segments_of(shot, segment_of);
  return extract_planes(shot.frame, shot.normals, std::move(segmentation), small_planes());
}

bool is_on_floor(Eigen::Vector3d const& p) {
  return p.z() < 1e-3;
}

Plane const kZero{Eigen::Vector3d::UnitZ(), 0.0};

/// A table on four legs, of one segment.
WorldScene table() {
  WorldScene scene = WorldScene().with_floor().with_box({-0.6, 1.0, 0.68}, {0.6, 1.8, 0.72});
  for (double const x_m : {-0.6, 0.5}) {
    for (double const y_m : {1.0, 1.7}) {
      scene.with_box({x_m, y_m, 0.0}, {x_m + 0.1, y_m + 0.1, 0.68});
    }
  }
  return scene;
}

TEST(SegmentPlanes, AreNotTableTops) {
  Shot const shot = shot_of(table(), camera_looking_along_y(1.4, 0.7));
  Segments const segments =
      segments_of(shot, [](Eigen::Vector3d const& p) { return is_on_floor(p) ? 1 : 2; });
  std::vector<Plane> const planes = suggested(shot, segments, true);
  EXPECT_TRUE(has_plane(planes, kZero));
  EXPECT_TRUE(std::ranges::none_of(
      planes, [](Plane const& plane) { return plane.normal.z() > 0.5 && plane.offset_m > 0.3; }));
}

TEST(SegmentPlanes, AreNotLevelWhereNothingIsKnownToBe) {
  Shot const shot = shot_of(table(), camera_looking_along_y(1.4, 0.7));
  Segments const segments =
      segments_of(shot, [](Eigen::Vector3d const& p) { return is_on_floor(p) ? 1 : 2; });
  for (Plane const& plane : suggested(shot, segments, false)) {
    EXPECT_LT(std::abs(plane.normal.z()), 0.1);
  }
}

TEST(SegmentPlanes, OfOneSegmentMayBeTwo) {
  // The edge of a wall, and what one sees of it on both sides.
  WorldScene scene;
  scene.with_box({-3.0, 2.0, 0.0}, {-0.3, 9.0, 2.6}).with_wall(5.0);
  Shot const shot = shot_of(scene, camera_looking_along_y(1.3, 0.0));
  Segments const segments =
      segments_of(shot, [](Eigen::Vector3d const& p) { return p.y() > 4.99 ? 1 : 2; });
  std::vector<Plane> const planes = suggested(shot, segments, true);
  EXPECT_TRUE(has_plane(planes, {Eigen::Vector3d::UnitY(), 2.0}));
  EXPECT_TRUE(has_plane(planes, {Eigen::Vector3d::UnitX(), -0.3}));
  EXPECT_TRUE(has_plane(planes, {Eigen::Vector3d::UnitY(), 5.0}));
}

TEST(SegmentPlanes, AreSortedBySize) {
  WorldScene const scene = WorldScene().with_floor().with_wall(3.0);
  for (double const pitch_rad : {0.2, 0.9}) {
    Shot const shot = shot_of(scene, camera_looking_along_y(1.3, pitch_rad));
    std::vector<Plane> const planes = suggested(
        shot, segments_of(shot, [](auto const& p) { return is_on_floor(p) ? 2 : 1; }), true);
    ASSERT_FALSE(planes.empty());
    EXPECT_EQ(planes[0].normal.z() > 0.5, pitch_rad > 0.5);
  }
}

TEST(SegmentPlanes, OfAWallThatIsSeenInPieces) {
  Shot const shot = shot_of(WorldScene().with_wall(3.0), camera_looking_along_y(1.3, 0.1));
  // Each piece is less than half of what a plane must have, together they are enough.
  auto const piece_of = [](Eigen::Vector3d const& p) {
    return 1 + std::clamp(static_cast<int>(std::floor((p.x() + 2.0) * 2.0)), 0, 7);
  };
  Segments const segments = segments_of(shot, piece_of);
  PlanesConfig config = small_planes();
  config.min_plane_pixels =
      2 * static_cast<int>(*std::ranges::max_element(segments.pixel_counts)) + 1;
  EXPECT_TRUE(has_plane(suggested(shot, segments, true, config), {Eigen::Vector3d::UnitY(), 3.0}));
}

TEST(SegmentPlanes, OfNothingAreNone) {
  Shot const shot = shot_of(WorldScene(), camera_looking_along_y(1.3, 0.0));
  EXPECT_TRUE(suggested(shot, segments_of(shot, [](auto const&) { return 1; }), true).empty());
  Segmentation const result = planes_of(shot, [](Eigen::Vector3d const&) { return 1; });
  EXPECT_FALSE(result.floor);
  EXPECT_TRUE(result.walls.empty());
}

TEST(SegmentPlanes, GiveTheFloorUnderATable) {
  Shot const shot = shot_of(table(), camera_looking_along_y(1.4, 0.7));
  Segmentation const result =
      planes_of(shot, [](Eigen::Vector3d const& p) { return is_on_floor(p) ? 1 : 2; });
  ASSERT_TRUE(result.floor);
  EXPECT_TRUE(result.walls.empty());
  for (std::size_t i = 0; i < result.labels.size(); ++i) {
    if (shot.frame.cloud_camera.valid(i)) {
      ASSERT_EQ(result.labels[i] == kFloor, is_on_floor(position_m(shot, i))) << "pixel " << i;
    }
  }
}

TEST(SegmentPlanes, GiveBothWallsOfACornerThatIsOneSegment) {
  // The camera looks along two walls that meet at an edge towards it.
  Se3 const turned(so3_exp({0.0, 0.0, M_PI / 4.0}), {2.0, 1.0, 0.0});
  WorldScene scene = WorldScene().with_floor();
  scene.with_box({-6.0, 2.0, 0.0}, {1.0, 9.0, 2.6});
  Shot const shot = shot_of(scene, turned * camera_looking_along_y(1.3, 0.0));
  Segmentation const result =
      planes_of(shot, [](Eigen::Vector3d const& p) { return is_on_floor(p) ? 1 : 2; });
  EXPECT_EQ(result.walls.size(), 2U);
}

TEST(SegmentPlanes, GiveOneWallOfCoplanarSegments) {
  // A pillar before the wall parts it.
  WorldScene scene = WorldScene().with_floor().with_wall(3.0);
  scene.with_box({-0.1, 2.0, 0.0}, {0.1, 2.2, 2.6});
  Shot const shot = shot_of(scene, camera_looking_along_y(1.3, 0.1));
  Segmentation const result = planes_of(shot, [](Eigen::Vector3d const& p) {
    if (is_on_floor(p)) {
      return 1;
    }
    return p.y() < 2.99 ? 2 : p.x() < 0.0 ? 3 : 4;
  });
  ASSERT_EQ(result.walls.size(), 1U);
  for (std::size_t i = 0; i < result.labels.size(); ++i) {
    if (shot.frame.cloud_camera.valid(i) && !is_on_floor(position_m(shot, i))) {
      ASSERT_EQ(result.labels[i] == kFirstWall, position_m(shot, i).y() > 2.99) << "pixel " << i;
    }
  }
}

TEST(SegmentPlanes, FindAFloorThatIsSeenInPatchesTooSmallForAPlane) {
  Shot const shot = shot_of(WorldScene().with_floor(), camera_looking_along_y(1.0, 0.6));
  Segments segments = segments_of(shot, [](auto const&) { return 1; });
  // Patches of 8 x 8 pixels, each a segment.
  std::int32_t const per_row = segments.labels.width() / 8;
  for (std::size_t i = 0; i < segments.labels.size(); ++i) {
    auto const [u, v] = segments.labels.pixel(i);
    segments.labels[i] = segments.labels[i] == 0 ? 0 : 1 + v / 8 * per_row + u / 8;
  }
  segments.pixel_counts.assign(static_cast<std::size_t>(per_row * segments.labels.height() / 8),
                               64);
  EXPECT_TRUE(has_plane(suggested(shot, segments, true), kZero));
  EXPECT_TRUE(suggested(shot, segments, false).empty());
}

}  // namespace
}  // namespace credo::test
