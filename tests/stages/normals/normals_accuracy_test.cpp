#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "stages/normals/angles.hpp"
#include "stages/normals/normals.hpp"
#include "stages/normals/pca_normals.hpp"
#include "support/rendered_scene.hpp"

namespace credo {
namespace {

using Eigen::Vector3d;
using test::angle_deg;
using test::kinect_intrinsics;
using test::quantile;
using test::share_within;

NormalMap normals_of(Grid<float> const& depth_m) {
  return estimate_normals(cloud_from_depth(depth_m, kinect_intrinsics()), kinect_intrinsics(), {});
}

/// A plane through the point straight ahead at a depth, leaning by an angle towards a direction.
test::Scene leaning_plane(double depth_m, double tilt_rad, double direction_rad) {
  Vector3d const normal(std::sin(tilt_rad) * std::cos(direction_rad),
                        std::sin(tilt_rad) * std::sin(direction_rad), -std::cos(tilt_rad));
  return {{{normal, normal.z() * depth_m}}, {}, {}};
}

/// Errors at the pixels that have a normal, in degrees; and the pixels with depth but without.
struct Errors {
  std::vector<float> angle_deg;
  std::size_t missing = 0;
};

/// Of all pixels at least `margin` from the image's border.
Errors errors_of(NormalMap const& normals, test::Rendering const& truth, int margin) {
  Errors errors;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    Pixel const p = truth.depth_m.pixel(i);
    bool const inside = p.u >= margin && p.u < normals.width() - margin && p.v >= margin &&
                        p.v < normals.height() - margin;
    if (inside && normals.valid(i)) {
      errors.angle_deg.push_back(angle_deg(normals.at(i), truth.normals.at(i)));
    } else if (inside && truth.depth_m[i] > 0.0F) {
      ++errors.missing;
    }
  }
  return errors;
}

TEST(NormalsAccuracy, PlanesWithoutNoiseAreExact) {
  // Depth in float: half a unit in the last place over a window of a few pixels.
  constexpr float kFloatDepth_deg = 0.05F;
  // A window reaches 40 pixels. Where it meets the image's border, means over 2 or 4 blocks have
  // half of them and stand for a place up to a block aside, among 5 to 9 samples at 60 degrees.
  constexpr int kReach = 40;
  constexpr float kAtBorder_deg = 10.0F;
  // At 60 degrees a depth tolerance of 2 cm holds a third of a window of 3 cm to each side, and in
  // a corner a quarter of that.
  constexpr double kMissingAtBorder = 0.05;
  constexpr CameraIntrinsics kCamera{585.0, 585.0, 99.5, 74.5};
  for (double const depth_m : {0.3, 0.5, 0.8, 1.2, 2.0, 4.0, 8.0}) {
    for (double const tilt_deg : {0.0, 20.0, 45.0, 60.0}) {
      for (double const direction_deg : {0.0, 90.0, 215.0}) {
        SCOPED_TRACE(std::to_string(depth_m) + " m, " + std::to_string(tilt_deg) + " deg towards " +
                     std::to_string(direction_deg));
        auto const plane = test::render(
            leaning_plane(depth_m, tilt_deg / 57.3, direction_deg / 57.3), 200, 150, kCamera);
        NormalMap const normals =
            estimate_normals(cloud_from_depth(plane.depth_m, kCamera), kCamera, {});
        Errors const inside = errors_of(normals, plane, kReach);
        EXPECT_LT(quantile(inside.angle_deg, 1.0), kFloatDepth_deg);
        EXPECT_EQ(inside.missing, 0);
        Errors const all = errors_of(normals, plane, 0);
        EXPECT_LT(quantile(all.angle_deg, 1.0), tilt_deg > 0.0 ? kAtBorder_deg : kFloatDepth_deg);
        EXPECT_LE(static_cast<double>(all.missing),
                  kMissingAtBorder * static_cast<double>(normals.size()));
      }
    }
  }
}

TEST(NormalsAccuracy, PlanesWithKinectNoiseAreGood) {
  // Scatter is even in inverse depth, a window of 3 cm holds fewer pixels the farther it is. What
  // limits it is the disparity step of 1/351 per metre: leaning by 10 degrees a plane at 2 m has
  // one every 19 pixels and at 3.5 m every 33, more than a window is wide, and looks straight
  // ahead between two of them. Each bound is a quarter above what a sound fit of these pixels has.
  struct Case {
    double depth_m;
    double tilt_deg;
    float median_deg;
    float p95_deg;
  };
  for (Case const& c : {Case{0.6, 10.0, 0.045F, 0.4F},
                        {0.6, 50.0, 0.04F, 1.35F},
                        {1.0, 10.0, 0.135F, 0.35F},
                        {1.0, 50.0, 0.10F, 1.8F},
                        {2.0, 10.0, 3.0F, 5.3F},
                        {2.0, 50.0, 0.45F, 1.5F},
                        {3.5, 10.0, 8.5F, 15.0F},
                        {3.5, 50.0, 1.85F, 4.1F}}) {
    SCOPED_TRACE(std::to_string(c.depth_m) + " m, " + std::to_string(c.tilt_deg) + " deg");
    auto plane = test::render(leaning_plane(c.depth_m, c.tilt_deg / 57.3, 1.0), 320, 240,
                              kinect_intrinsics());
    plane.depth_m = test::with_kinect_noise(plane.depth_m, 1);
    Errors const errors = errors_of(normals_of(plane.depth_m), plane, 0);
    EXPECT_LT(quantile(errors.angle_deg, 0.5), c.median_deg);
    EXPECT_LT(quantile(errors.angle_deg, 0.95), c.p95_deg);
    EXPECT_EQ(errors.missing, 0);
  }
}

TEST(NormalsAccuracy, ABallIsRound) {
  // A window of 3 cm on a ball of 10 cm turns by 17 degrees to each side: what one side of it says
  // more than the other is a fraction of that, the more the farther the ball turns away.
  constexpr float kMedian_deg = 2.0F;
  constexpr float kWorst_deg = 6.0F;
  test::Scene const ball{{}, {}, {{Vector3d(0.02, -0.01, 1.0), 0.1}}};
  auto const truth = test::render(ball, 640, 480, kinect_intrinsics());
  NormalMap const normals = normals_of(truth.depth_m);
  std::vector<float> front_deg;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    // Turned away by less than 45 degrees.
    if (truth.normals.valid(i) && truth.normals.z[i] < -0.7F) {
      ASSERT_TRUE(normals.valid(i));
      front_deg.push_back(angle_deg(normals.at(i), truth.normals.at(i)));
    }
  }
  ASSERT_GT(front_deg.size(), 1000);
  EXPECT_LT(quantile(front_deg, 0.5), kMedian_deg);
  EXPECT_LT(quantile(front_deg, 1.0), kWorst_deg);
}

/// How the pixels of a room lie: on open surfaces, beside depth jumps or holes, beside creases.
enum class Place : std::uint8_t { kOpen, kEdge, kCrease };

Place place_of(test::Rendering const& truth, Grid<float> const& depth_m, Pixel p) {
  constexpr int kReach = 6;
  if (test::beside_edge(truth.depth_m, p, kReach)) {
    return Place::kEdge;
  }
  Eigen::Vector3f const normal = truth.normals.at(p);
  for (int v = p.v - kReach; v <= p.v + kReach; ++v) {
    for (int u = p.u - kReach; u <= p.u + kReach; ++u) {
      if (depth_m.contains({u, v}) && truth.normals.at(Pixel{u, v}).dot(normal) < 0.9F) {
        return Place::kCrease;
      }
    }
  }
  return test::beside_edge(depth_m, p, kReach) ? Place::kEdge : Place::kOpen;
}

/// Errors of ours and of PCL's normals of all points within 3 cm, at the same pixels.
struct Comparison {
  std::vector<float> ours_deg;
  std::vector<float> pca_deg;
  std::size_t missing = 0;

  [[nodiscard]] double missing_share() const {
    return static_cast<double>(missing) / static_cast<double>(missing + ours_deg.size());
  }
};

/// Every 41st pixel of the noisy room, by place, where the noise left it on its own surface.
std::array<Comparison, 3> compare_in_room() {
  auto const truth = test::render(test::room_scene(), 640, 480, kinect_intrinsics());
  Grid<float> const depth_m = test::with_kinect_noise(truth.depth_m, 1);
  OrganizedCloud const cloud = cloud_from_depth(depth_m, kinect_intrinsics());
  NormalMap const normals = estimate_normals(cloud, kinect_intrinsics(), {});
  std::vector<std::size_t> pixels;
  for (std::size_t i = 0; i < cloud.size(); i += 41) {
    float const z = truth.depth_m[i];
    if (truth.normals.valid(i) && std::abs(cloud.z[i] - z) < 0.02F + 0.01F * z * z) {
      pixels.push_back(i);
    }
  }
  auto const pca = test::pca_normals(cloud, pixels, 0.03);
  std::array<Comparison, 3> places;
  for (std::size_t k = 0; k < pixels.size(); ++k) {
    Place const place = place_of(truth, depth_m, cloud.z.pixel(pixels[k]));
    Comparison& to = places.at(static_cast<std::size_t>(place));
    Eigen::Vector3f const expected = truth.normals.at(pixels[k]);
    if (!normals.valid(pixels[k])) {
      ++to.missing;
    } else if (pca[k].allFinite()) {
      to.ours_deg.push_back(angle_deg(normals.at(pixels[k]), expected));
      to.pca_deg.push_back(angle_deg(pca[k], expected));
    }
  }
  return places;
}

TEST(NormalsAccuracy, BeatsAllPointsWithinARadiusInTheRoom) {
  // Clusters end where normals differ by 0.3 rad: a normal that is farther off joins the wrong
  // side.
  constexpr float kClusterAngle_deg = 17.2F;
  auto const [open, edge, crease] = compare_in_room();
  for (Comparison const* place : {&open, &edge, &crease}) {
    ASSERT_GT(place->ours_deg.size(), 400);
    EXPECT_LT(quantile(place->ours_deg, 0.5), quantile(place->pca_deg, 0.5));
    EXPECT_GT(share_within(place->ours_deg, kClusterAngle_deg),
              share_within(place->pca_deg, kClusterAngle_deg));
  }
  // Where there is nothing but noise: far surfaces keep a window of many pixels.
  EXPECT_LT(quantile(open.ours_deg, 0.5), 0.65F * quantile(open.pca_deg, 0.5));
  EXPECT_LT(quantile(open.ours_deg, 0.95), 4.0F);
  EXPECT_EQ(open.missing, 0);
  EXPECT_LT(quantile(edge.ours_deg, 0.9), 0.6F * quantile(edge.pca_deg, 0.9));
  // Blocks of one pixel or two of a surface that goes no further.
  EXPECT_LT(edge.missing_share(), 0.06);
  // A ball around a point beside a crease holds both sides, whichever it is on.
  EXPECT_LT(quantile(crease.ours_deg, 0.5), 0.25F * quantile(crease.pca_deg, 0.5));
  EXPECT_EQ(crease.missing, 0);
}

}  // namespace
}  // namespace credo
