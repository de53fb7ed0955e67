#include "detector/poses/pose_evidence.hpp"

#include <gtest/gtest.h>
#include <Eigen/LU>

#include <cmath>
#include <cstdint>

#include "detector/poses/pose_refinement.hpp"
#include "detector/views.hpp"

namespace credo::test {
namespace {

using Eigen::Vector3f;

Eigen::Quaterniond some_rotation(double angle = 1.1) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d(1.0, -0.6, 0.4).normalized()));
}

/// Of one point's distance to a plane that stays, by central differences of boxplus.
Vector6d numeric_gradient(Se3 const& pose, Eigen::Vector3d const& p_model,
                          Eigen::Vector3d const& normal_camera) {
  constexpr double kStep = 1e-5;
  Vector6d gradient;
  for (int axis = 0; axis < 6; ++axis) {
    Vector6d error = Vector6d::Zero();
    error[axis] = kStep;
    Eigen::Vector3d const ahead = boxplus(pose, error) * p_model;
    Eigen::Vector3d const behind = boxplus(pose, -error) * p_model;
    gradient[axis] = normal_camera.dot(ahead - behind) / (2.0 * kStep);
  }
  return gradient;
}

/// Whether the scene has its surface there, turned the same way.
bool lies_on(SearchScene const& scene, Eigen::Vector3d const& p, Eigen::Vector3d const& normal) {
  CameraIntrinsics const& camera = scene.intrinsics;
  Pixel const at{static_cast<int>(std::lround(camera.fx_px * p.x() / p.z() + camera.cx_px)),
                 static_cast<int>(std::lround(camera.fy_px * p.y() / p.z() + camera.cy_px))};
  ScenePixel const& seen = scene.pixels[at];
  return std::abs(static_cast<double>(seen.depth_m) - p.z()) < 0.015 &&
         (!seen.has_normal() || seen.normal_camera().cast<double>().dot(normal) > 0.5);
}

TEST(PoseEvidence, IsWhatNumericDerivativesSay) {
  SearchModel const& model = prepared_bracket();
  for (double const angle : {0.3, 1.1, 2.5}) {
    BracketView const view = bracket_alone(some_rotation(angle));
    PoseEvidence const evidence = evidence_of(model, view.scene, view.truth);
    ASSERT_GT(evidence.points, 200);
    Vector3f const centre = view.truth * model.centre_model;
    ModelView const& side = model.view_from(-(view.truth.rotation.transpose() * centre));
    Matrix6d literal = Matrix6d::Zero();
    for (std::uint16_t const i : side.visible) {
      Eigen::Vector3d const normal = (view.truth.rotation * model.normals_model[i]).cast<double>();
      if (!lies_on(view.scene, view.T_camera_model * model.points_model[i].cast<double>(),
                   normal)) {
        continue;
      }
      Vector6d const g =
          numeric_gradient(view.T_camera_model, model.points_model[i].cast<double>(), normal);
      literal += g * g.transpose();
    }
    // The deviation of a point is the sensor's: up to it, the two are the same.
    Matrix6d const told = evidence.hold / evidence.hold.topLeftCorner<3, 3>().trace();
    Matrix6d const wanted = literal / literal.topLeftCorner<3, 3>().trace();
    Vector6d scale;
    scale << 1, 1, 1, 0.07, 0.07, 0.07;  // a radian moves the points by about so much
    Matrix6d const error = ((told - wanted).array() / (scale * scale.transpose()).array()).matrix();
    Matrix6d const size = (wanted.array() / (scale * scale.transpose()).array()).matrix();
    EXPECT_LT(error.norm(), 0.2 * size.norm()) << told << "\n\n" << wanted;
  }
}

TEST(PoseEvidence, ResidualsAreLeastAtTheTruth) {
  BracketView const view = bracket_alone(some_rotation());
  SearchModel const& model = prepared_bracket();
  PoseEvidence const right = evidence_of(model, view.scene, view.truth);
  EXPECT_LT(right.mean_squared_residual, 0.5);
  EXPECT_LE(right.points, 800);
  for (Matrix6d const& matrix : {right.hold, right.surface_noise, right.edge_noise}) {
    EXPECT_TRUE(matrix.isApprox(matrix.transpose(), 1e-9));
  }
  CameraPose const off = perturbed(model, view.truth, {0, 0, 0.006F}, {0, 0, 0});
  EXPECT_GT(evidence_of(model, view.scene, off).mean_squared_residual,
            2.0 * right.mean_squared_residual);
}

/// The scene with all its depths longer.
SearchScene with_longer_depths(SearchScene scene, float by_m) {
  for (int v = 0; v < scene.pixels.height(); ++v) {
    for (int u = 0; u < scene.pixels.width(); ++u) {
      float& depth_m = scene.pixels[{u, v}].depth_m;
      depth_m += depth_m > 0.0F ? by_m : 0.0F;
    }
  }
  return scene;
}

TEST(PoseEvidence, TellsWhatAnErrorOfAllDepthsMakesOfThePose) {
  constexpr float kLonger_m = 0.001F;
  SearchModel const& model = prepared_bracket();
  for (double const angle : {0.3, 1.1, 2.5}) {
    BracketView const view = bracket_alone(some_rotation(angle));
    RefinementConfig fully = kFinestRefinement;
    fully.iterations = 30;
    CameraPose const at_rest = refined(model, view.scene, view.truth, fully);
    CameraPose const moved =
        refined(model, with_longer_depths(view.scene, kLonger_m), at_rest, fully);
    PoseEvidence const evidence = evidence_of(model, view.scene, at_rest);
    Vector6d const told =
        evidence.hold.inverse() * evidence.common_depth.col(0) * static_cast<double>(kLonger_m);
    Vector6d const error = boxminus(se3(moved), se3(at_rest));
    EXPECT_LT((error - told).head<3>().norm(), 0.25 * told.head<3>().norm())
        << error.transpose() << "\n"
        << told.transpose();
    EXPECT_LT((error - told).tail<3>().norm(), 0.003) << error.transpose();
  }
}

/// The scene with what lies a radius from `centre` along `direction` farther away by `by_m` along
/// its ray, and the other end nearer.
SearchScene with_tilted_depths(SearchScene scene, Vector3f const& centre, Vector3f const& direction,
                               float by_m, float radius_m) {
  for (int v = 0; v < scene.pixels.height(); ++v) {
    for (int u = 0; u < scene.pixels.width(); ++u) {
      float& depth_m = scene.pixels[{u, v}].depth_m;
      float const share = (scene.point_at({u, v}) - centre).dot(direction) / radius_m;
      depth_m += depth_m > 0.0F ? by_m * share : 0.0F;
    }
  }
  return scene;
}

TEST(PoseEvidence, TellsWhatDepthsTiltedInCommonMakeOfThePose) {
  constexpr float kTilt_m = 0.001F;
  SearchModel const& model = prepared_bracket();
  for (double const angle : {0.3, 1.1, 2.5}) {
    BracketView const view = bracket_alone(some_rotation(angle));
    RefinementConfig fully = kFinestRefinement;
    fully.iterations = 30;
    CameraPose const at_rest = refined(model, view.scene, view.truth, fully);
    PoseEvidence const evidence = evidence_of(model, view.scene, at_rest);
    Vector3f const centre = at_rest * model.centre_model;
    Vector3f const sideways = centre.cross(Vector3f::UnitY()).normalized();
    Vector3f const upright = centre.normalized().cross(sideways);
    for (int column : {1, 2}) {
      Vector3f const& direction = column == 1 ? sideways : upright;
      SearchScene const tilted =
          with_tilted_depths(view.scene, centre, direction, kTilt_m, model.radius_m);
      Vector6d error = boxminus(se3(refined(model, tilted, at_rest, fully)), se3(at_rest));
      Vector6d told = evidence.hold.inverse() * evidence.common_depth.col(column) *
                      static_cast<double>(kTilt_m);
      for (Vector6d* motion : {&error, &told}) {
        motion->tail<3>() *= 0.07;  // a radian moves the points by about so much
      }
      // Points fall elsewhere when it turns; but it turns that way, and about so far.
      EXPECT_LT((error - told).norm(), 0.7 * told.norm()) << angle << ", column " << column << "\n"
                                                          << error.transpose() << "\n"
                                                          << told.transpose();
    }
  }
}

TEST(PoseEvidence, AnEdgeFartherOutOnOneSidePullsThere) {
  // Where something is behind it, its silhouette is where the surface ends.
  BracketView const view = bracket_on_desk(0.5);
  PoseEvidence const evidence = evidence_of(prepared_bracket(), view.scene, view.truth);
  ASSERT_GT(evidence.edge_noise.trace(), 0.0);
  Eigen::Vector3d const ray = view.T_camera_model.translation().normalized();
  Eigen::Vector3d const sideways = ray.cross(Eigen::Vector3d::UnitY()).normalized();
  // A silhouette that is shifted pulls its own way, at least as much as any other.
  Eigen::Vector3d const pull = evidence.common_edge.col(1).head<3>();
  EXPECT_GT(pull.dot(sideways), 0.7 * pull.norm());
}

TEST(PoseEvidence, WithoutContactsThereIsNone) {
  PoseEvidence const none =
      evidence_of(prepared_bracket(), SearchScene{}, bracket_alone(some_rotation()).truth);
  EXPECT_EQ(none.points, 0);
  EXPECT_EQ(none.hold, Matrix6d::Zero());
  EXPECT_EQ(none.surface_noise, Matrix6d::Zero());
  EXPECT_EQ(none.edge_noise, Matrix6d::Zero());
  EXPECT_EQ(none.mean_squared_residual, 0.0);
  EXPECT_EQ(none.mean_squared_edge_residual, 0.0);
}

}  // namespace
}  // namespace credo::test
