#include "geometry/shapes/seen_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/se3.hpp"

namespace credo::test {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr float kPitch_m = 0.002F;
constexpr float kRadius_m = 0.0075F;

/// A sheet of 4 cm in the plane through the origin with this normal.
std::vector<Vector3f> sheet(Vector3f const& normal) {
  Vector3f const u = normal.unitOrthogonal();
  Vector3f const v = normal.cross(u);
  std::vector<Vector3f> points;
  for (int i = -10; i <= 10; ++i) {
    for (int j = -10; j <= 10; ++j) {
      points.emplace_back(kPitch_m * (static_cast<float>(i) * u + static_cast<float>(j) * v));
    }
  }
  return points;
}

TEST(SeenPoints, NormalsAreThePlanesAndFaceTheCamera) {
  Vector3f const normal = Vector3f(0.3F, -0.5F, 0.8F).normalized();
  for (float const side : {1.0F, -1.0F}) {
    SeenPoints const seen{sheet(normal), side * Vector3f(0, 0, 1)};
    std::vector<OrientedPoint> const oriented = with_normals({seen}, kRadius_m);
    ASSERT_EQ(oriented.size(), seen.points.size());
    for (OrientedPoint const& p : oriented) {
      EXPECT_NEAR(p.normal.dot(side * normal), 1.0F, 1e-5F);
    }
  }
}

TEST(SeenPoints, FarFromTheOriginNormalsAreAsGood) {
  Vector3f const normal = Vector3f(0.3F, -0.5F, 0.8F).normalized();
  SeenPoints seen{sheet(normal), Vector3f::Zero()};
  for (Vector3f& point : seen.points) {
    point += Vector3f(3.0F, -2.0F, -4.0F);
  }
  for (OrientedPoint const& p : with_normals({seen}, kRadius_m)) {
    EXPECT_GT(p.normal.dot(normal), 0.9999F);
  }
}

TEST(SeenPoints, APointBesideThePlaneStillHasItsNormal) {
  SeenPoints seen{sheet(Vector3f::UnitZ()), {0, 0, 1}};
  seen.points.emplace_back(0.0F, 0.0F, 0.005F);
  std::vector<OrientedPoint> const oriented = with_normals({seen}, kRadius_m);
  EXPECT_EQ(oriented.back().point, seen.points.back());
  EXPECT_GT(oriented.back().normal.z(), 0.99F);
}

TEST(SeenPoints, EachViewIsItsOwn) {
  SeenPoints const above{sheet(Vector3f::UnitZ()), {0, 0, 1}};
  SeenPoints below{sheet(Vector3f::UnitZ()), {0, 0, -1}};
  for (Vector3f& point : below.points) {
    point.z() -= 0.003F;
  }
  std::vector<OrientedPoint> const oriented = with_normals({above, below}, kRadius_m);
  ASSERT_EQ(oriented.size(), above.points.size() + below.points.size());
  for (OrientedPoint const& p : oriented) {
    EXPECT_NEAR(p.normal.z(), p.point.z() < -0.001F ? -1.0F : 1.0F, 1e-5F);
  }
}

TEST(SeenPoints, FlatAnglesAndLonelyPointsAreLeftOut) {
  auto const seen_at = [](double degrees_from_surface) {
    double const angle = degrees_from_surface * std::numbers::pi / 180.0;
    Vector3f const camera = 50.0F * Vector3d(std::cos(angle), 0, std::sin(angle)).cast<float>();
    return with_normals({SeenPoints{sheet(Vector3f::UnitZ()), camera}}, kRadius_m).size();
  };
  EXPECT_EQ(seen_at(10.0), 0U);
  EXPECT_EQ(seen_at(13.0), sheet(Vector3f::UnitZ()).size());
  SeenPoints lonely{sheet(Vector3f::UnitZ()), {0, 0, 1}};
  lonely.points.emplace_back(0.1F, 0.0F, 0.0F);
  EXPECT_EQ(with_normals({lonely}, kRadius_m).size(), lonely.points.size() - 1);
  // Eight around one are enough, seven are not.
  for (int others : {8, 7}) {
    SeenPoints few{{Vector3f::Zero()}, {0, 0, 1}};
    for (int i = 0; i < others; ++i) {
      auto const turn = static_cast<float>(i);
      few.points.emplace_back(0.003F * std::cos(turn), 0.003F * std::sin(turn), 0.0F);
    }
    EXPECT_EQ(with_normals({few}, kRadius_m).size(), others == 8 ? 9U : 0U);
  }
}

TEST(SeenPoints, ThePitchIsThatOfMostPoints) {
  SeenPoints seen{sheet(Vector3f::UnitZ()), {0, 0, 1}};
  seen.points.emplace_back(1.0F, 1.0F, 1.0F);
  EXPECT_NEAR(typical_pitch_m({seen, seen}), kPitch_m, 1e-6F);
  EXPECT_EQ(typical_pitch_m({}), 0.0F);
  EXPECT_EQ(typical_pitch_m({SeenPoints{{Vector3f::Zero()}, Vector3f::UnitX()}}), 0.0F);
}

TEST(SeenPoints, AFrameShowsWhatLiesInTheBox) {
  Frame frame;
  frame.cloud_camera = OrganizedCloud(3, 1);
  frame.cloud_camera.set(0, {0.0F, 0.0F, 1.0F});
  frame.cloud_camera.set(1, {0.2F, 0.0F, 1.0F});
  // A quarter turn about z, and 2 m along x.
  frame.T_source_camera =
      Se3(Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 2, Vector3d::UnitZ())),
          {2.0, 0.0, 0.0});
  Eigen::AlignedBox3d const box(Vector3d(1.8, 0.1, 0.9), Vector3d(2.2, 0.3, 1.3));
  SeenPoints const seen = seen_in(frame, box);
  ASSERT_EQ(seen.points.size(), 1U) << "the first is beside it, the last is none";
  EXPECT_TRUE(seen.points[0].isApprox(Vector3f(0.0F, 0.0F, -0.1F), 1e-5F))
      << seen.points[0].transpose();
  EXPECT_TRUE(seen.camera.isApprox(Vector3f(0.0F, -0.2F, -1.1F), 1e-5F));
}

}  // namespace
}  // namespace credo::test
