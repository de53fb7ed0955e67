// What a prepared model knows of itself, against rays to its points.
#include "detector/models/search_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <set>
#include <string>

#include "core/error.hpp"
#include "detector/views.hpp"
#include "geometry/shapes/mesh_distance.hpp"
#include "geometry/shapes/model_mesh.hpp"
#include "support/meshes.hpp"

namespace credo::test {
namespace {

using Eigen::Vector3f;

ObjectModel ring_model(int around, int across) {
  return {"ring", wavy_ring(around, across), {}};
}

/// A sheet in z = 0, 20 x 20 cm.
ObjectModel sheet() {
  TriangleMesh mesh;
  mesh.vertices = {{-0.1F, -0.1F, 0}, {0.1F, -0.1F, 0}, {0.1F, 0.1F, 0}, {-0.1F, 0.1F, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return {"sheet", mesh, {}};
}

TEST(SearchModel, IsAsLargeAsItsMesh) {
  SearchModel const& model = prepared_bracket();
  EXPECT_EQ(model.name, "bracket");
  EXPECT_TRUE(model.centre_model.isApprox(Vector3f(0, 0, 0.06F), 1e-5F));
  EXPECT_NEAR(model.radius_m, Vector3f(0.08F, 0.04F, 0.06F).norm(), 1e-5F);
  // From a lower corner of the foot to the corner of the post across.
  EXPECT_NEAR(model.diameter_m, std::sqrt(0.16F * 0.16F + 0.08F * 0.08F + 0.12F * 0.12F), 1e-5F);
  // Three boxes, with the faces that they share.
  EXPECT_NEAR(model.surface_m2, 0.04F + 0.0263F + 0.0104F, 1e-5F);
}

TEST(SearchModel, TheDiameterIsTheLargestDistance) {
  for (auto const& [around, across] : {std::pair(9, 7), std::pair(24, 12)}) {
    ObjectModel const ring = ring_model(around, across);
    float literal = 0.0F;
    auto const& vertices = std::get<TriangleMesh>(ring.shape).vertices;
    for (Vector3f const& a : vertices) {
      for (Vector3f const& b : vertices) {
        literal = std::max(literal, (a - b).norm());
      }
    }
    float const diameter_m = prepare_model(ring).diameter_m;
    EXPECT_LE(diameter_m, literal * 1.00001F);
    EXPECT_GE(diameter_m, literal * 0.98F);
  }
}

TEST(SearchModel, PointsLieApartOnTheSurface) {
  SearchModel const& model = prepared_bracket();
  ASSERT_GT(model.points_model.size(), 1000U);
  ASSERT_EQ(model.points_model.size(), model.normals_model.size());
  MeshDistance const distance(mesh_of(bracket()));
  for (std::size_t i = 0; i < model.points_model.size(); ++i) {
    EXPECT_NEAR(distance(model.points_model[i].cast<double>()).distance_m, 0.0, 1e-6);
    for (std::size_t j = 0; j < i; ++j) {
      ASSERT_GE((model.points_model[i] - model.points_model[j]).norm(), 0.9999F * model.spacing_m);
    }
  }
}

TEST(SearchModel, NormalsPointOutward) {
  // Where bodies touch, points near the seam are of the faces between them; here none do.
  for (ObjectModel const& object : {crate({0.2, 0.12, 0.1}), ring_model(24, 12)}) {
    SearchModel const model = prepare_model(object);
    MeshDistance const distance(mesh_of(object));
    int wrong = 0;
    for (std::size_t i = 0; i < model.points_model.size(); ++i) {
      Vector3f const beside = model.points_model[i] + 1e-3F * model.normals_model[i];
      wrong += distance(beside.cast<double>()).distance_m > 0.0 ? 0 : 1;
    }
    EXPECT_EQ(wrong, 0) << object.name;
  }
}

TEST(SearchModel, PointsThatNoViewShowsAreLeftOut) {
  ObjectModel const nested{"nested",
                           std::vector<Solid>{BoxSolid{{-0.1, -0.1, 0.0}, {0.1, 0.1, 0.2}},
                                              BoxSolid{{-0.06, -0.06, 0.04}, {0.06, 0.06, 0.16}}},
                           {}};
  SearchModel const model = prepare_model(nested);
  Solid const outer = BoxSolid{{-0.1, -0.1, 0.0}, {0.1, 0.1, 0.2}};
  for (Vector3f const& p : model.points_model) {
    EXPECT_NEAR(distance_to(outer, p.cast<double>()).distance_m, 0.0, 1e-6);
  }
  std::set<std::uint16_t> shown;
  for (ModelView const& view : model.views) {
    EXPECT_TRUE(std::ranges::is_sorted(view.visible));
    shown.insert(view.visible.begin(), view.visible.end());
  }
  EXPECT_EQ(shown.size(), model.points_model.size()) << "each is shown by some view";
  EXPECT_EQ(*shown.rbegin() + 1U, model.points_model.size());
}

TEST(SearchModel, ASheetHasEachPointTwice) {
  SearchModel const model = prepare_model(sheet());
  auto const up =
      std::ranges::count_if(model.normals_model, [](Vector3f const& n) { return n.z() > 0.99F; });
  auto const down =
      std::ranges::count_if(model.normals_model, [](Vector3f const& n) { return n.z() < -0.99F; });
  EXPECT_GT(up, 1000);
  EXPECT_EQ(up, down);
  EXPECT_EQ(static_cast<std::size_t>(up + down), model.normals_model.size());
  for (float const side : {1.0F, -1.0F}) {
    ModelView const& view = model.view_from({0.1F, 0.0F, side});
    EXPECT_EQ(view.visible.size(), static_cast<std::size_t>(up));
    for (std::uint16_t const i : view.visible) {
      EXPECT_GT(model.normals_model[i].z() * side, 0.0F);
    }
  }
}

TEST(SearchModel, AOneSidedSheetShowsItsOutsideAlone) {
  ObjectModel object = sheet();
  object.one_sided = true;
  SearchModel const model = prepare_model(object);
  ASSERT_GT(model.points_model.size(), 1000U);
  for (Vector3f const& normal : model.normals_model) {
    EXPECT_GT(normal.z(), 0.99F);
  }
  ModelView const& front = model.view_from({0.1F, 0.0F, 1.0F});
  EXPECT_EQ(front.visible.size(), model.points_model.size());
  EXPECT_NEAR(front.area_m2, 0.04F, 0.002F);
  EXPECT_GT(front.outline.size(), 50U);
  ModelView const& behind = model.view_from({0.1F, 0.0F, -1.0F});
  EXPECT_TRUE(behind.visible.empty());
  EXPECT_TRUE(behind.outline.empty());
  EXPECT_EQ(behind.area_m2, 0.0F);
}

TEST(SearchModel, OfAOneSidedShellTheInsideHidesNothing) {
  // A box without its lid: through it one looks at the back of its walls, which are not there.
  ObjectModel object{"shell", mesh_of(crate({0.2, 0.12, 0.1})), {}};
  auto& mesh = std::get<TriangleMesh>(object.shape);
  std::erase_if(mesh.triangles, [&](auto const& triangle) {
    return std::ranges::all_of(triangle,
                               [&](std::uint32_t i) { return mesh.vertices[i].z() > 0.05F; });
  });
  ASSERT_EQ(mesh.triangles.size(), 10U);
  object.one_sided = true;
  SearchModel const model = prepare_model(object);
  EXPECT_EQ(model.view_from({0, 0, 1}).area_m2, 0.0F);
  // The nearest view is up to ten degrees off, and then shows of a wall, too.
  float const below_m2 = model.view_from({0, 0, -1}).area_m2;
  EXPECT_GT(below_m2, 0.2F * 0.12F - 0.002F);
  EXPECT_LT(below_m2, 0.2F * 0.12F + 0.2F * 0.1F * std::sin(0.175F) + 0.002F);
  // From aside and above only the near walls are seen.
  for (std::uint16_t const i : model.view_from({1.0F, 0.0F, 0.6F}).visible) {
    EXPECT_GT(model.normals_model[i].x(), 0.5F);
  }
}

TEST(SearchModel, AFineMeshIsRenderedWithFewerTriangles) {
  ObjectModel const ring = ring_model(90, 40);
  auto const& mesh = std::get<TriangleMesh>(ring.shape);
  ASSERT_GT(mesh.triangles.size(), 5000U);
  SearchModel const model = prepare_model(ring);
  EXPECT_LT(model.triangles.size(), mesh.triangles.size());
  EXPECT_GT(model.triangles.size(), 500U);
  MeshDistance const distance(mesh);
  for (Vector3f const& vertex : model.vertices_model) {
    EXPECT_LT(std::abs(distance(vertex.cast<double>()).distance_m),
              static_cast<double>(model.diameter_m) / 70.0);
  }
}

TEST(SearchModel, ACoarseMeshIsRenderedAsItIs) {
  ObjectModel const ring = ring_model(24, 12);
  SearchModel const model = prepare_model(ring);
  EXPECT_EQ(model.vertices_model, std::get<TriangleMesh>(ring.shape).vertices);
  EXPECT_EQ(model.triangles, std::get<TriangleMesh>(ring.shape).triangles);
}

TEST(SearchModel, OfABoxTheFlatPiecesAreItsFaces) {
  SearchModel const model = prepare_model(crate({0.20, 0.12, 0.10}));
  ASSERT_EQ(model.facets.size(), 6U);
  for (Facet const& facet : model.facets) {
    EXPECT_NEAR(facet.normal.cwiseAbs().maxCoeff(), 1.0F, 1e-3F);
    Vector3f const to_face = facet.centre_m - Vector3f(0, 0, 0.05F);
    EXPECT_NEAR(to_face.normalized().dot(facet.normal), 1.0F, 0.01F) << "in the middle of a face";
  }
  EXPECT_TRUE(prepare_model({"ball", std::vector<Solid>{SphereSolid{0.1}}, {}}).facets.empty());
}

std::string error_of(TriangleMesh mesh) {
  try {
    (void)prepare_model({"ghost", std::move(mesh), {}});
  } catch (InputError const& error) {
    return error.what();
  }
  return {};
}

TEST(SearchModel, WithoutASurfaceIsAnError) {
  TriangleMesh line;
  line.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  TriangleMesh flat = line;
  flat.triangles = {{0, 1, 2}, {0, 1, 1}};
  for (TriangleMesh const& mesh : {TriangleMesh{}, line, flat}) {
    std::string const text = error_of(mesh);
    EXPECT_THAT(text, ::testing::HasSubstr("model ghost"));
    EXPECT_THAT(text, ::testing::HasSubstr("no surface"));
    EXPECT_THAT(text, ::testing::Not(::testing::HasSubstr("\n")));
  }
}

TEST(SearchModel, IsTheSameEachTime) {
  SearchModel const again = prepare_model(bracket());
  SearchModel const& model = prepared_bracket();
  EXPECT_EQ(model.points_model, again.points_model);
  EXPECT_EQ(model.normals_model, again.normals_model);
  ASSERT_EQ(model.views.size(), again.views.size());
  for (std::size_t v = 0; v < model.views.size(); ++v) {
    EXPECT_EQ(model.views[v].visible, again.views[v].visible);
    EXPECT_EQ(model.views[v].area_m2, again.views[v].area_m2);
    ASSERT_EQ(model.views[v].outline.size(), again.views[v].outline.size());
    for (std::size_t i = 0; i < model.views[v].outline.size(); ++i) {
      EXPECT_EQ(model.views[v].outline[i].inside_model, again.views[v].outline[i].inside_model);
      EXPECT_EQ(model.views[v].outline[i].outside_model, again.views[v].outline[i].outside_model);
    }
  }
}

TEST(SearchModel, TheViewIsTheNearest) {
  SearchModel const& model = prepared_bracket();
  std::mt19937 random(8);
  std::normal_distribution<float> number;
  for (int i = 0; i < 50; ++i) {
    Vector3f const to_camera = 3.0F * Vector3f(number(random), number(random), number(random));
    float const cosine = model.view_from(to_camera).to_camera_model.dot(to_camera.normalized());
    for (ModelView const& view : model.views) {
      EXPECT_LE(view.to_camera_model.dot(to_camera.normalized()), cosine + 1e-6F);
    }
  }
}

}  // namespace
}  // namespace credo::test
