#include "detector/scenes/facets.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "detector/scenes/scene_of_frame.hpp"
#include "detector/search/facet_proposals.hpp"
#include "detector/views.hpp"

namespace credo::test {
namespace {

using Eigen::Matrix3f;
using Eigen::Vector3f;

/// Points of a rectangle in the plane of two unit axes.
void add_rectangle(std::vector<OrientedPoint>& points, Vector3f const& centre,
                   Vector3f const& along, Vector3f const& across, float half_length,
                   float half_width, std::size_t count, std::mt19937& random) {
  std::uniform_real_distribution<float> share(-1.0F, 1.0F);
  for (std::size_t i = 0; i < count; ++i) {
    points.push_back(
        {centre + half_length * share(random) * along + half_width * share(random) * across,
         along.cross(across)});
  }
}

TEST(Facets, ARectangleIsFoundAsItLies) {
  std::mt19937 random(1);
  Matrix3f const R = Eigen::AngleAxisf(0.7F, Vector3f(1, 2, -1).normalized()).toRotationMatrix();
  Vector3f const centre(0.3F, -0.2F, 1.1F);
  std::vector<OrientedPoint> points;
  add_rectangle(points, centre, R.col(0), R.col(1), 0.15F, 0.06F, 2000, random);
  std::vector<Facet> const facets = facets_of(points, 0.003F, 0.1F, 20);
  ASSERT_EQ(facets.size(), 1U);
  Facet const& facet = facets[0];
  EXPECT_EQ(facet.points, 2000U);
  EXPECT_NEAR(facet.normal.dot(R.col(2)), 1.0F, 1e-4F);
  EXPECT_GT(std::abs(facet.along.dot(R.col(0))), std::cos(0.06F));
  EXPECT_GT(std::abs(facet.across().dot(R.col(1))), std::cos(0.06F));
  EXPECT_NEAR(facet.half_length_m, 0.15F, 0.008F);
  EXPECT_NEAR(facet.half_width_m, 0.06F, 0.008F);
  EXPECT_LT((facet.centre_m - centre).norm(), 0.008F);
}

TEST(Facets, TheOneWithTheMostPointsComesFirst) {
  std::mt19937 random(2);
  std::vector<OrientedPoint> points;
  Vector3f const x = Vector3f::UnitX();
  Vector3f const y = Vector3f::UnitY();
  Vector3f const z = Vector3f::UnitZ();
  add_rectangle(points, {0, 0, 0}, y, z, 0.1F, 0.1F, 300, random);
  add_rectangle(points, {0, 0, 0.1F}, x, y, 0.1F, 0.1F, 900, random);
  add_rectangle(points, {0, 0.1F, 0}, z, x, 0.1F, 0.1F, 600, random);
  std::vector<Facet> const facets = facets_of(points, 0.003F, 0.1F, 20);
  ASSERT_EQ(facets.size(), 3U);
  EXPECT_TRUE(std::ranges::is_sorted(facets, std::greater{}, &Facet::points));
  EXPECT_NEAR(facets[0].normal.dot(z), 1.0F, 1e-4F);
  EXPECT_NEAR(facets[1].normal.dot(y), 1.0F, 1e-4F);
  EXPECT_NEAR(facets[2].normal.dot(x), 1.0F, 1e-4F);
}

TEST(Facets, PlanesOfOneNormalAreToldApart) {
  std::mt19937 random(3);
  std::vector<OrientedPoint> points;
  for (float const height : {0.0F, 0.05F}) {
    add_rectangle(points, {0, 0, height}, Vector3f::UnitX(), Vector3f::UnitY(), 0.1F, 0.05F, 500,
                  random);
  }
  std::vector<Facet> const facets = facets_of(points, 0.004F, 0.1F, 20);
  ASSERT_EQ(facets.size(), 2U);
  EXPECT_NEAR(std::abs(facets[0].centre_m.z() - facets[1].centre_m.z()), 0.05F, 1e-3F);
}

TEST(Facets, TooFewPointsAreNone) {
  std::mt19937 random(4);
  std::vector<OrientedPoint> points;
  add_rectangle(points, {0, 0, 0}, Vector3f::UnitX(), Vector3f::UnitY(), 0.1F, 0.05F, 30, random);
  EXPECT_EQ(facets_of(points, 0.004F, 0.1F, 30).size(), 1U);
  EXPECT_TRUE(facets_of(points, 0.004F, 0.1F, 31).empty());
  EXPECT_TRUE(facets_of({}, 0.004F, 0.1F, 0).empty());
  add_rectangle(points, {0, 0, 1}, Vector3f::UnitY(), Vector3f::UnitZ(), 0.1F, 0.05F, 400, random);
  EXPECT_EQ(facets_of(points, 0.004F, 0.1F, 10).size(), 1U) << "less than the least share";
}

TEST(Facets, ABallHasAtMostSix) {
  std::mt19937 random(5);
  std::normal_distribution<float> number;
  std::vector<OrientedPoint> points;
  for (int i = 0; i < 4000; ++i) {
    Vector3f const n = Vector3f(number(random), number(random), number(random)).normalized();
    points.push_back({0.1F * n, n});
  }
  EXPECT_LE(facets_of(points, 0.05F, 0.0F, 5).size(), 6U);
}

Facet rectangle(float half_length, float half_width) {
  Facet facet;
  facet.half_length_m = half_length;
  facet.half_width_m = half_width;
  facet.points = 100;
  facet.segment = 7;
  return facet;
}

/// One piece of the scene, turned toward the camera.
SearchScene scene_with(float half_length, float half_width) {
  SearchScene scene;
  Facet facet = rectangle(half_length, half_width);
  facet.normal = -Vector3f::UnitZ();
  facet.along = Vector3f(0.6F, 0.8F, 0.0F);
  facet.centre_m = {0.1F, 0.2F, 1.0F};
  scene.facets = {facet};
  return scene;
}
SearchModel model_with(float half_length, float half_width) {
  SearchModel model;
  Facet facet = rectangle(half_length, half_width);
  facet.centre_m = {0.01F, 0.02F, 0.30F};
  model.facets = {facet};
  return model;
}

TEST(FacetProposals, LayAWholeFaceOnItself) {
  SearchModel const model = model_with(0.20F, 0.10F);
  SearchScene const scene = scene_with(0.20F, 0.10F);
  std::vector<Proposal> const proposals = propose_by_facets(model, scene);
  ASSERT_EQ(proposals.size(), 2U) << "and turned by half a turn";
  Facet const& face = model.facets[0];
  Facet const& seen = scene.facets[0];
  for (Proposal const& proposal : proposals) {
    EXPECT_EQ(proposal.segment, 7);
    Matrix3f const& R = proposal.pose.rotation;
    EXPECT_NEAR(R.determinant(), 1.0F, 1e-5F);
    EXPECT_LT((R * face.normal - seen.normal).norm(), 1e-5F);
    EXPECT_NEAR(std::abs((R * face.along).dot(seen.along)), 1.0F, 1e-5F);
    EXPECT_LT((proposal.pose * face.centre_m - seen.centre_m).norm(), 1e-5F);
  }
  EXPECT_NEAR(angle_between(proposals[0].pose, proposals[1].pose), std::numbers::pi, 1e-2);
}

TEST(FacetProposals, ASquareLiesFourWays) {
  std::vector<Proposal> const ways =
      propose_by_facets(model_with(0.1F, 0.1F), scene_with(0.1F, 0.1F));
  ASSERT_EQ(ways.size(), 4U);
  for (std::size_t i = 0; i < ways.size(); ++i) {
    EXPECT_NEAR(ways[i].pose.rotation.determinant(), 1.0F, 1e-5F) << "a turn, no mirror image";
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GT(angle_between(ways[i].pose, ways[j].pose), 1.5);
    }
  }
}

TEST(FacetProposals, APartLiesInTheCorners) {
  SearchModel const model = model_with(0.20F, 0.10F);
  SearchScene const scene = scene_with(0.08F, 0.05F);
  Facet const& face = model.facets[0];
  Facet const& seen = scene.facets[0];
  std::vector<Proposal> const proposals = propose_by_facets(model, scene);
  EXPECT_GE(proposals.size(), 8U);
  for (Proposal const& proposal : proposals) {
    // The seen piece lies within the model's face, and reaches a corner of it.
    Vector3f const shift =
        proposal.pose.rotation.transpose() * (seen.centre_m - proposal.pose * face.centre_m);
    bool const lengthwise = std::abs((proposal.pose.rotation * face.along).dot(seen.along)) > 0.9F;
    float const spare_along = face.half_length_m - (lengthwise ? 0.08F : 0.05F);
    float const spare_across = face.half_width_m - (lengthwise ? 0.05F : 0.08F);
    EXPECT_NEAR(shift.dot(face.normal), 0.0F, 1e-5F);
    EXPECT_NEAR(std::abs(shift.dot(face.along)), spare_along, 1e-4F);
    EXPECT_NEAR(std::abs(shift.dot(face.across())), spare_across, 1e-4F);
  }
}

TEST(FacetProposals, NothingIsLaidOnWhatIsLarger) {
  EXPECT_TRUE(propose_by_facets(model_with(0.20F, 0.10F), scene_with(0.30F, 0.10F)).empty());
  EXPECT_TRUE(propose_by_facets(model_with(0.20F, 0.10F), scene_with(0.20F, 0.18F)).empty());
  EXPECT_TRUE(propose_by_facets(model_with(0.20F, 0.10F), SearchScene{}).empty());
  EXPECT_TRUE(propose_by_facets(SearchModel{}, scene_with(0.20F, 0.10F)).empty());
}

TEST(FacetProposals, NothingIsLaidOnWhatIsExplained) {
  SearchModel const model = model_with(0.20F, 0.10F);
  SearchScene scene = scene_with(0.20F, 0.10F);
  scene.pixels = Grid<ScenePixel>(10, 10, ScenePixel{});
  scene.segments.resize(7);
  scene.segments[6].pixels = 20;
  ClaimedPixels explained(10, 10, 0);
  for (std::size_t i = 0; i < 20; ++i) {
    scene.pixels[i].segment = 7;
    explained[i] = i < 10 ? 1 : 0;
  }
  EXPECT_EQ(propose_by_facets(model, scene, explained).size(), 2U) << "half of it is open";
  explained[10] = 1;
  EXPECT_TRUE(propose_by_facets(model, scene, explained).empty());
}

/// A crate on the desk, one corner towards the camera.
class CrateFromACorner : public ::testing::Test {
protected:
  static constexpr double kYaw_rad = 0.7;
  CrateFromACorner() : model_(prepare_model(crate({0.24, 0.16, 0.12}))) {
    std::vector<Placed> things = desk_and_floor();
    Se3 const T_world_crate = placed_at({0, 0, 0}, kYaw_rad);
    things.push_back({crate({0.24, 0.16, 0.12}), T_world_crate});
    scene_ = scene_of(*frame_of(things, before_desk()));
    truth_ = camera_pose(before_desk().inverse() * T_world_crate);
  }

  SearchModel model_;
  SearchScene scene_;
  CameraPose truth_;
};

TEST_F(CrateFromACorner, ItsFacesAreAmongThoseOfTheScene) {
  int found = 0;
  for (Facet const& face : model_.facets) {
    for (Facet const& seen : scene_.facets) {
      Vector3f const centre = truth_ * face.centre_m;
      found += (seen.centre_m - centre).norm() < 0.015F &&
                       seen.normal.dot(truth_.rotation * face.normal) > 0.98F &&
                       std::abs(seen.half_length_m - face.half_length_m) < 0.012F &&
                       std::abs(seen.half_width_m - face.half_width_m) < 0.012F
                   ? 1
                   : 0;
    }
  }
  // The third is seen at so much of a slant that its borders may stray.
  EXPECT_GE(found, 2);
}

TEST_F(CrateFromACorner, ItsPoseIsProposed) {
  CameraPose turned = truth_;
  turned.rotation =
      truth_.rotation * Eigen::AngleAxisf(std::numbers::pi_v<float>, Vector3f::UnitZ()).matrix();
  for (CameraPose const& pose : {truth_, turned}) {
    EXPECT_TRUE(
        std::ranges::any_of(propose_by_facets(model_, scene_), [&](Proposal const& proposal) {
          return (proposal.pose.translation_m - pose.translation_m).norm() <
                     0.1F * model_.diameter_m &&
                 angle_between(proposal.pose, pose) < 15.0 * std::numbers::pi / 180.0;
        }));
  }
}

}  // namespace
}  // namespace credo::test
