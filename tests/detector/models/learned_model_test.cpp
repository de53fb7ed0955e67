// Models made of what a simulated sensor saw, found again in other scenes.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "detector/bpa_detector.hpp"
#include "detector/views.hpp"
#include "geometry/shapes/learned_surface.hpp"
#include "geometry/shapes/mesh_distance.hpp"
#include "geometry/shapes/model_mesh.hpp"
#include "io/pcd.hpp"
#include "sim/household.hpp"
#include "support/milk_pose.hpp"
#include "support/recordings.hpp"

namespace credo::test {
namespace {

using Eigen::Vector3d;

ObjectModel household(std::string const& name) {
  std::vector<ObjectModel> const models = household_models();
  return *std::ranges::find(models, name, &ObjectModel::name);
}

double half_height_m(ObjectModel const& object) {
  double low_m = 0.0;
  for (Eigen::Vector3f const& vertex : mesh_of(object).vertices) {
    low_m = std::min(low_m, static_cast<double>(vertex.z()));
  }
  return -low_m;
}

/// A camera 0.8 m before the middle of the desk, so far around it.
Se3 look_from(double turn_rad, double height_m) {
  return looking_at({0.8 * std::sin(turn_rad), -0.8 * std::cos(turn_rad), height_m},
                    {0.0, 0.0, 0.08});
}

/// What holds an object on the middle of the desk, from 6 mm above it on.
Eigen::AlignedBox3d around(ObjectModel const& object) {
  return {Vector3d(-0.25, -0.25, 0.006), Vector3d(0.25, 0.25, 2.0 * half_height_m(object) + 0.05)};
}

/// The surface of what was seen in that box, in the object's own frame.
TriangleMesh surface_of(std::vector<SeenPoints> const& views, ObjectModel const& object) {
  TriangleMesh mesh = learned_surface(views).mesh;
  auto const up_m = static_cast<float>(around(object).center().z() - half_height_m(object));
  for (Eigen::Vector3f& vertex : mesh.vertices) {
    vertex.z() += up_m;
  }
  return mesh;
}

/// A one-sided model of an object that stood on the middle of a desk, seen from all around by a
/// noisy sensor.
ObjectModel learned(ObjectModel const& object, int looks) {
  std::vector<Placed> things = desk_and_floor();
  things.push_back({object, placed_at({0, 0, half_height_m(object)})});
  std::vector<SeenPoints> views;
  for (int look = 0; look < looks; ++look) {
    double const turn = 2.0 * std::numbers::pi * look / looks;
    double const height_m = look % 2 == 0 ? 0.35 : 0.75;
    views.push_back(seen_in(
        *frame_of(things, look_from(turn, height_m), {SensorModel::kDisparity, 1 + look, look}),
        around(object)));
  }
  ObjectModel model{"learned", surface_of(views, object), object.symmetry};
  model.one_sided = true;
  return model;
}

/// Share of a model's surface, in corners, that lies within a distance of the true one.
double share_within(ObjectModel const& learned_model, ObjectModel const& truth, double distance_m) {
  MeshDistance const distance(mesh_of(truth));
  auto const& vertices = mesh_of(learned_model).vertices;
  auto const near = std::ranges::count_if(vertices, [&](Eigen::Vector3f const& vertex) {
    return std::abs(distance(vertex.cast<double>()).distance_m) <= distance_m;
  });
  return static_cast<double>(near) / static_cast<double>(vertices.size());
}

double angle_deg(Se3 const& a, Se3 const& b) {
  return so3_log(a.rotation().conjugate() * b.rotation()).norm() * 180.0 / std::numbers::pi;
}

/// Of where the object is found on another desk, from another side and beside another thing.
struct Found {
  double distance_m = 1.0;
  double angle_deg = 180.0;
};
Found found(ObjectModel const& model, ObjectModel const& object) {
  std::vector<Placed> things = desk_and_floor();
  // Turned so that handles show.
  Se3 const T_world_model = placed_at({0.12, 0.05, half_height_m(object)}, 3.3);
  things.push_back({object, T_world_model});
  things.push_back({bracket(), placed_at({-0.2, 0.1, 0}, 0.4)});
  Se3 const T_world_camera = looking_at({0.1, -0.9, 0.55}, {0.0, 0.0, 0.05});
  FramePtr const frame = frame_of(things, T_world_camera, {SensorModel::kDisparity, 77, 5});
  ObjectModels models;
  models.emplace(model.name, model);
  BpaConfig config;
  config.search = ObjectSearch::kGlobal;
  BpaDetector detector(models, config);
  auto const detections = detector.detect(
      *frame, {{"it",
                model.name,
                {Se3(Eigen::Quaterniond::Identity(), {0, 0, 1}), 100.0 * Matrix6d::Identity()}}});
  if (detections.size() != 1) {
    return {};
  }
  Se3 const pose = detections[0].pose_camera.mean;
  Se3 const truth = T_world_camera.inverse() * T_world_model;
  Found best{(pose.translation() - truth.translation()).norm(), angle_deg(pose, truth)};
  for (Eigen::Quaterniond const& turn : object.symmetry.rotations) {
    best.angle_deg = std::min(best.angle_deg, angle_deg(pose, truth * Se3(turn, Vector3d::Zero())));
  }
  return best;
}

class LearnedModel : public ::testing::TestWithParam<char const*> {};

TEST_P(LearnedModel, IsFoundInAnotherScene) {
  ObjectModel const object = household(GetParam());
  ObjectModel const model = learned(object, 8);
  EXPECT_GT(share_within(model, object, 0.003), 0.95);
  Found const it = found(model, object);
  EXPECT_LT(it.distance_m, 0.01);
  EXPECT_LT(it.angle_deg, 7.0) << "of a mug the handle alone tells the turn";
}
INSTANTIATE_TEST_SUITE_P(Household, LearnedModel,
                         ::testing::Values("mug", "teapot", "cereal_box", "toy_truck", "iron"));

TEST(LearnedModels, TheUnseenSideIsNoSurface) {
  ObjectModel const object = household("mug");
  std::vector<Placed> things = desk_and_floor();
  things.push_back({object, placed_at({0, 0, half_height_m(object)})});
  SeenPoints const seen = seen_in(*frame_of(things, look_from(0.0, 0.3)), around(object));
  ObjectModel model{"half", surface_of({seen}, object), {}};
  model.one_sided = true;
  SearchModel const prepared = prepare_model(model);
  EXPECT_GT(prepared.view_from({0, -1, 0.3F}).area_m2, 0.005F);
  EXPECT_LT(prepared.view_from({0, 1, -0.3F}).area_m2, 0.0005F);
  for (Eigen::Vector3f const& normal : prepared.normals_model) {
    EXPECT_LT(normal.dot(Eigen::Vector3f(0, 1, -0.3F)), 0.3F);
  }
}

TEST(LearnedModels, TheMilkCartonIsFoundWhereItStands) {
  CREDO_REQUIRE_RECORDING("objects/milk.pcd");
  CREDO_REQUIRE_RECORDING("frames/milk");
  ViewedPoints const milk = read_pcd_points(recordings() / "objects/milk.pcd", CloudAxes::kAuto);
  ObjectModels models;
  models["milk"] = {
      "milk", learned_surface({SeenPoints{milk.points, milk.viewpoint}}).mesh, {}, true};
  Frame frame;
  frame.cloud_camera = read_pcd(recordings() / "frames/milk/milk_cartoon_all_small_clorox.pcd",
                                CloudAxes::kAuto, 10.0)
                           .cloud_camera;
  frame.intrinsics = {525.0, 525.0, 320.0, 240.0};
  BpaConfig config;
  config.search = ObjectSearch::kGlobal;
  BpaDetector detector(models, config);
  auto const detections = detector.detect(
      frame, {{"it",
               "milk",
               {Se3(Eigen::Quaterniond::Identity(), {0, 0, 1}), 100.0 * Matrix6d::Identity()}}});
  ASSERT_EQ(detections.size(), 1U);
  Se3 const pose = detections[0].pose_camera.mean;
  Vector3d const centre = detector.models().at("milk")->model.centre_model.cast<double>();
  Se3 const truth = true_milk_pose();
  EXPECT_LT((pose * centre - truth * centre).norm(), 0.01);
  EXPECT_LT(angle_deg(pose, truth), 5.0);
}

}  // namespace
}  // namespace credo::test
