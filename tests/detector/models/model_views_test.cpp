// What views show, against a ray from the camera to each point.
#include "detector/models/model_views.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include "detector/views.hpp"
#include "geometry/shapes/model_mesh.hpp"
#include "geometry/shapes/solid.hpp"
#include "geometry/shapes/triangle.hpp"
#include "support/meshes.hpp"

namespace credo::test {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

/// The views are taken from so many radii away.
constexpr double kDistance_radii = 6.0;

Vector3d camera_of(SearchModel const& model, ModelView const& view) {
  return model.centre_model.cast<double>() + kDistance_radii * static_cast<double>(model.radius_m) *
                                                 view.to_camera_model.cast<double>();
}

/// Of a pixel of a view's picture, at the model's centre, at most.
double pixel_m(SearchModel const& model) {
  return 2.1 * static_cast<double>(model.radius_m) / 190.0;
}

/// How far along `ray` the mesh is first met, in lengths of it.
double first_hit(TriangleMesh const& mesh, Vector3d const& origin, Vector3d const& ray) {
  double nearest = std::numeric_limits<double>::infinity();
  for (auto const& [a, b, c] : mesh.triangles) {
    std::array<Vector3d, 3> const corners = {mesh.vertices[a].cast<double>(),
                                             mesh.vertices[b].cast<double>(),
                                             mesh.vertices[c].cast<double>()};
    nearest = std::min(nearest, distance_to_triangle(corners, origin, ray).value_or(nearest));
  }
  return nearest;
}

/// What rays to a point and around it, a pixel aside, tell.
struct Sight {
  bool surely_seen = true;
  bool surely_hidden = true;
};
Sight sight_of(TriangleMesh const& mesh, SearchModel const& model, ModelView const& view,
               std::size_t i) {
  Vector3d const camera = camera_of(model, view);
  Vector3d const point = model.points_model[i].cast<double>();
  Vector3d const normal = model.normals_model[i].cast<double>();
  Vector3d const aside = view.to_camera_model.cast<double>().unitOrthogonal();
  Vector3d const across = view.to_camera_model.cast<double>().cross(aside);
  double const incidence = normal.dot((camera - point).normalized());
  double const tolerance_m = 4.0 * pixel_m(model) / std::max(incidence, 0.05);
  Sight sight;
  sight.surely_seen = incidence > 0.15;
  for (double const du : {-1.0, 0.0, 1.0}) {
    for (double const dv : {-1.0, 0.0, 1.0}) {
      Vector3d const ray = point + pixel_m(model) * (du * aside + dv * across) - camera;
      double const before_m = (1.0 - first_hit(mesh, camera, ray)) * ray.norm();
      sight.surely_seen = sight.surely_seen && before_m < 1.2 * pixel_m(model) / incidence;
      sight.surely_hidden = sight.surely_hidden && before_m > tolerance_m;
    }
  }
  sight.surely_hidden = sight.surely_hidden || incidence < 0.0;
  return sight;
}

void expect_sights(ObjectModel const& object, SearchModel const& model, std::size_t view_step,
                   std::size_t point_step) {
  TriangleMesh const mesh = mesh_of(object);
  int seen = 0;
  int hidden = 0;
  for (std::size_t v = 0; v < model.views.size(); v += view_step) {
    ModelView const& view = model.views[v];
    for (std::size_t i = v % point_step; i < model.points_model.size(); i += point_step) {
      Sight const sight = sight_of(mesh, model, view, i);
      bool const told = std::ranges::binary_search(view.visible, static_cast<std::uint16_t>(i));
      EXPECT_FALSE(sight.surely_seen && !told) << v << ' ' << model.points_model[i].transpose();
      EXPECT_FALSE(sight.surely_hidden && told) << v << ' ' << model.points_model[i].transpose();
      seen += sight.surely_seen ? 1 : 0;
      hidden += sight.surely_hidden ? 1 : 0;
    }
  }
  EXPECT_GT(seen, 200);
  EXPECT_GT(hidden, 200);
}

TEST(ModelViews, ShowOfABracketWhatRaysReach) {
  expect_sights(bracket(), prepared_bracket(), 9, 13);
}

TEST(ModelViews, ShowOfARingWhatRaysReach) {
  ObjectModel const ring{"ring", wavy_ring(24, 12), {}};
  expect_sights(ring, prepare_model(ring), 27, 11);
}

TEST(ModelViews, TheAreaIsThatOfTheSilhouette) {
  SearchModel const ball = prepare_model({"ball", std::vector<Solid>{SphereSolid{0.1}}, {}});
  double const distance_m = kDistance_radii * static_cast<double>(ball.radius_m);
  // The cone that touches a sphere is a little wider at its centre.
  double const area_m2 =
      std::numbers::pi * 0.01 * distance_m * distance_m / (distance_m * distance_m - 0.01);
  for (ModelView const& view : ball.views) {
    EXPECT_NEAR(view.area_m2, area_m2, 0.03 * area_m2);
  }
}

TEST(ModelViews, TheAreaOfABoxIsThatItsRaysCover) {
  Eigen::Vector3d const size_m(0.2, 0.12, 0.05);
  SearchModel const model = prepare_model(crate(size_m));
  Solid const box = box_on_base(size_m);
  for (std::size_t v = 0; v < model.views.size(); v += 20) {
    ModelView const& view = model.views[v];
    Vector3d const camera = camera_of(model, view);
    Vector3d const aside = view.to_camera_model.cast<double>().unitOrthogonal();
    Vector3d const across = view.to_camera_model.cast<double>().cross(aside);
    constexpr int kHalf = 100;
    double const step_m = 1.1 * static_cast<double>(model.radius_m) / kHalf;
    int hits = 0;
    for (int i = -kHalf; i < kHalf; ++i) {
      for (int j = -kHalf; j < kHalf; ++j) {
        Vector3d const at = model.centre_model.cast<double>() + step_m * (i * aside + j * across);
        hits += enter(box, camera, at - camera) ? 1 : 0;
      }
    }
    double const area_m2 = hits * step_m * step_m;
    EXPECT_NEAR(view.area_m2, area_m2, 0.03 * area_m2) << v;
  }
}

TEST(ModelViews, OutlinePairsLieOnEitherSide) {
  TriangleMesh const mesh = mesh_of(bracket());
  SearchModel const& model = prepared_bracket();
  int pairs = 0;
  int wrong = 0;
  for (std::size_t v = 0; v < model.views.size(); v += 4) {
    ModelView const& view = model.views[v];
    EXPECT_LE(view.outline.size(), 64U);
    EXPECT_GE(view.outline.size(), 20U);
    Vector3d const camera = camera_of(model, view);
    for (OutlinePair const& pair : view.outline) {
      Vector3d const inside = pair.inside_model.cast<double>();
      Vector3d const outside = pair.outside_model.cast<double>();
      double const hit = first_hit(mesh, camera, inside - camera);
      bool const in = std::abs(hit - 1.0) * (inside - camera).norm() < 0.01;
      bool const out = std::isinf(first_hit(mesh, camera, outside - camera));
      ++pairs;
      wrong += in && out ? 0 : 1;
      EXPECT_NEAR((inside - outside).dot(view.to_camera_model.cast<double>()), 0.0, 1e-5)
          << "at one depth";
      EXPECT_LT((inside - outside).norm(), 0.025);
    }
  }
  EXPECT_GT(pairs, 1000);
  EXPECT_LT(wrong, pairs / 50);
}

TEST(ModelViews, AreOnesFromAllSides) {
  SearchModel const& model = prepared_bracket();
  std::vector<ModelView> const views = views_of(model);
  ASSERT_EQ(views.size(), model.views.size());
  for (std::size_t v = 0; v < views.size(); ++v) {
    EXPECT_EQ(views[v].to_camera_model, model.views[v].to_camera_model);
    EXPECT_FALSE(views[v].visible.empty());
  }
}

}  // namespace
}  // namespace credo::test
