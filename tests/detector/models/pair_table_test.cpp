// The table of pairs against counting all pairs.
#include "detector/models/pair_table.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <set>
#include <vector>

#include "detector/views.hpp"

namespace credo::test {
namespace {

using Eigen::Vector3f;
using Eigen::Vector4f;

constexpr float kPi = std::numbers::pi_v<float>;

class Random {
public:
  explicit Random(unsigned seed) : engine_(seed) {}
  Vector3f vector() { return {number_(engine_), number_(engine_), number_(engine_)}; }
  Vector3f unit() { return vector().normalized(); }
  Eigen::Isometry3f motion() {
    Eigen::Isometry3f motion = Eigen::Isometry3f::Identity();
    motion.linear() = Eigen::AngleAxisf(2.0F * number_(engine_), unit()).toRotationMatrix();
    motion.translation() = vector();
    return motion;
  }

private:
  std::mt19937 engine_;
  std::normal_distribution<float> number_;
};

TEST(PairFeature, IsDistanceAndAnglesInSteps) {
  // 60 degrees from the line, 90, and between the normals what is left.
  Vector3f const tilted(0.5F, std::sqrt(0.75F), 0.0F);
  Vector4f const feature =
      PairFeature::of({0, 0, 0}, tilted, {0.3F, 0, 0}, Vector3f::UnitY(), 0.02F);
  constexpr float kPerDegree = PairFeature::kAngleSteps / 180.0F;
  EXPECT_NEAR(feature[0], 15.0F, 1e-4F);
  EXPECT_NEAR(feature[1], 60.0F * kPerDegree, 2e-3F);
  EXPECT_NEAR(feature[2], 90.0F * kPerDegree, 2e-3F);
  EXPECT_NEAR(feature[3], 30.0F * kPerDegree, 2e-3F);
}

TEST(PairFeature, AnglesAreRightFrom0To180Degrees) {
  for (int degrees = 0; degrees <= 180; ++degrees) {
    float const angle = static_cast<float>(degrees) * kPi / 180.0F;
    Vector3f const normal(std::cos(angle), std::sin(angle), 0.0F);
    Vector4f const feature = PairFeature::of({0, 0, 0}, Vector3f::UnitX(), {0, 0, 1}, normal, 1.0F);
    EXPECT_NEAR(feature[3] / PairFeature::kAngleSteps * kPi, angle, 1e-3F) << degrees;
  }
}

TEST(PairFeature, StaysWhenBothMove) {
  Random random(1);
  for (int i = 0; i < 300; ++i) {
    Vector3f const p = random.vector();
    Vector3f const q = random.vector();
    Vector3f const n = random.unit();
    Vector3f const m = random.unit();
    Eigen::Isometry3f const T = random.motion();
    Vector4f const before = PairFeature::of(p, n, q, m, 0.1F);
    Vector4f const after = PairFeature::of(T * p, T.linear() * n, T * q, T.linear() * m, 0.1F);
    EXPECT_LT((before - after).cwiseAbs().maxCoeff(), 5e-3F);
  }
}

TEST(PairFeature, ThePairIsOrdered) {
  Vector4f const one =
      PairFeature::of({0, 0, 0}, Vector3f::UnitX(), {1, 0, 0}, Vector3f::UnitY(), 1.0F);
  Vector4f const other =
      PairFeature::of({1, 0, 0}, Vector3f::UnitY(), {0, 0, 0}, Vector3f::UnitX(), 1.0F);
  EXPECT_NEAR(one[1], 0.0F, 1e-3F);
  EXPECT_NEAR(other[2], PairFeature::kAngleSteps, 1e-2F);
}

TEST(NormalFrame, TakesThePointToTheOriginAndTheNormalToX) {
  Random random(2);
  std::vector<Vector3f> normals = {Vector3f::UnitX(), -Vector3f::UnitX(), Vector3f::UnitZ()};
  for (int i = 0; i < 50; ++i) {
    normals.push_back(random.unit());
  }
  for (Vector3f const& normal : normals) {
    Vector3f const point = random.vector();
    NormalFrame const frame(point, normal);
    EXPECT_LT((frame.rotation * point + frame.translation_m).norm(), 1e-4F);
    EXPECT_LT((frame.rotation * normal - Vector3f::UnitX()).norm(), 1e-4F);
    EXPECT_NEAR(frame.rotation.determinant(), 1.0F, 1e-4F);
    Vector3f const other = random.vector();
    Vector3f const there = frame.rotation * other + frame.translation_m;
    EXPECT_NEAR(frame.turn_of(other), std::atan2(there.z(), there.y()), 1e-3F);
  }
}

TEST(NormalFrame, OfWhatLiesOnTheNormalTheTurnIsSomeNumber) {
  NormalFrame const frame({0, 0, 0}, Vector3f::UnitX());
  EXPECT_TRUE(std::isfinite(frame.turn_of({1, 0, 0})));
  EXPECT_TRUE(std::isfinite(frame.turn_of({0, 0, 0})));
}

// Drost's equation 2: the pose is S^-1 Rx(turn) M.
TEST(NormalFrame, TheTurnsOfAPairGiveItsMotionBack) {
  Random random(3);
  for (int i = 0; i < 300; ++i) {
    Vector3f const p = random.vector();
    Vector3f const n = random.unit();
    Vector3f const q = random.vector();
    Eigen::Isometry3f const T = random.motion();
    NormalFrame const model(p, n);
    NormalFrame const scene(T * p, T.linear() * n);
    float const turn = scene.turn_of(T * q) - model.turn_of(q);
    Eigen::Matrix3f const rotation = scene.rotation.transpose() *
                                     Eigen::AngleAxisf(turn, Vector3f::UnitX()).toRotationMatrix() *
                                     model.rotation;
    EXPECT_LT((rotation - T.linear()).cwiseAbs().maxCoeff(), 3e-3F);
  }
}

/// A model small enough to count all of its pairs.
SearchModel const& small_model() {
  static SearchModel const model = prepare_model(crate({0.10, 0.06, 0.05}));
  return model;
}
PairTable const& small_table() {
  static PairTable const table(small_model());
  return table;
}

struct Pair {
  std::size_t reference;
  std::uint16_t from;
  std::uint16_t to;
};

Vector4f feature_of(Pair const& pair) {
  SearchModel const& model = small_model();
  return PairFeature::of(model.points_model[pair.from], model.normals_model[pair.from],
                         model.points_model[pair.to], model.normals_model[pair.to],
                         small_table().step_m());
}

/// All pairs that a view shows together.
std::vector<Pair> literal_pairs() {
  SearchModel const& model = small_model();
  std::vector<std::set<std::size_t>> views(model.points_model.size());
  for (std::size_t v = 0; v < model.views.size(); ++v) {
    for (std::uint16_t const i : model.views[v].visible) {
      views[i].insert(v);
    }
  }
  std::vector<std::uint16_t> const& references = small_table().references();
  std::vector<Pair> pairs;
  for (std::size_t r = 0; r < references.size(); ++r) {
    for (std::uint16_t const to : references) {
      bool const together = std::ranges::any_of(
          views[to], [&](std::size_t v) { return views[references[r]].contains(v); });
      if (to != references[r] && together) {
        pairs.push_back({r, references[r], to});
      }
    }
  }
  return pairs;
}

float turn_between(float a, float b) {
  return std::abs(std::remainder(a - b, 2.0F * kPi));
}

TEST(PairTable, ReferencesLieAStepApart) {
  SearchModel const& model = small_model();
  PairTable const& table = small_table();
  EXPECT_GT(table.references().size(), 100U);
  for (std::uint16_t const a : table.references()) {
    for (std::uint16_t const b : table.references()) {
      EXPECT_TRUE(a == b || (model.points_model[a] - model.points_model[b]).norm() >=
                                0.9999F * table.step_m());
    }
  }
}

TEST(PairTable, HasEachPairWhereItsFeatureIs) {
  int missing = 0;
  std::vector<Pair> const pairs = literal_pairs();
  ASSERT_GT(pairs.size(), 5000U);
  for (Pair const& pair : pairs) {
    SearchModel const& model = small_model();
    NormalFrame const frame(model.points_model[pair.from], model.normals_model[pair.from]);
    float const turn = frame.turn_of(model.points_model[pair.to]);
    bool const found =
        std::ranges::any_of(small_table().like(feature_of(pair)), [&](PairTable::Entry const& e) {
          float const told = static_cast<float>(e.turn) * 2.0F * kPi / 65536.0F;
          return e.reference == pair.reference && turn_between(told, turn) < 1e-3F;
        });
    missing += found ? 0 : 1;
  }
  EXPECT_EQ(missing, 0);
}

/// Entries of one reference that lie within a feature's cell, or so near to it.
std::size_t literal_count(std::vector<Pair> const& pairs, std::vector<Vector4f> const& features,
                          std::size_t reference, Vector4f const& feature, float slack) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    bool near = pairs[i].reference == reference;
    for (int axis = 0; axis < 4; ++axis) {
      // The last cell of an angle holds 180 degrees too.
      float const cell = axis == 0
                             ? std::floor(feature[axis])
                             : std::min(std::floor(feature[axis]), PairFeature::kAngleSteps - 1.0F);
      near = near && features[i][axis] > cell - slack && features[i][axis] < cell + 1.0F + slack;
    }
    count += near ? 1 : 0;
  }
  return count;
}

TEST(PairTable, LikeAPairAreThoseWithinAStep) {
  std::vector<Pair> const pairs = literal_pairs();
  std::vector<Vector4f> features;
  for (Pair const& pair : pairs) {
    features.push_back(feature_of(pair));
  }
  for (std::size_t i = 0; i < pairs.size(); i += pairs.size() / 40) {
    std::size_t const reference = pairs[i].reference;
    auto const told = static_cast<std::size_t>(
        std::ranges::count_if(small_table().like(features[i]),
                              [&](PairTable::Entry const& e) { return e.reference == reference; }));
    EXPECT_GE(told, literal_count(pairs, features, reference, features[i], 0.0F));
    EXPECT_LE(told, literal_count(pairs, features, reference, features[i], 0.5F));
    EXPECT_GT(told, 0U);
  }
}

TEST(PairTable, NoPairIsLongerThanTheModel) {
  Vector4f const feature(1.3F * small_model().diameter_m / small_table().step_m(), 7, 7, 7);
  EXPECT_TRUE(small_table().like(feature).empty());
  EXPECT_TRUE(small_table().like({1e6F, 0, 0, 0}).empty());
}

TEST(PairTable, HoldsEachPairAtLeastOnce) {
  EXPECT_GE(small_table().size(), literal_pairs().size());
  EXPECT_EQ(PairTable().size(), 0U);
}

// Opposite faces of a box are never seen together.
TEST(PairTable, LeavesOutWhatNoViewShowsTogether) {
  constexpr float kBack = PairFeature::kAngleSteps;
  for (float distance = 0.0F; distance < 21.0F; distance += 1.0F) {
    EXPECT_TRUE(small_table().like({distance, kBack / 2, kBack / 2, kBack}).empty());
    EXPECT_TRUE(small_table().like({distance, kBack, 0.0F, kBack}).empty());
  }
}

TEST(PairTable, OfSlenderThingsPointsAreCloser) {
  ObjectModel const rod{"rod", std::vector<Solid>{CylinderSolid{0.008, 0.3}}, {}};
  SearchModel const slender = prepare_model(rod);
  PairTable const of_rod(slender);
  EXPECT_GE(of_rod.step_m(), 0.0219F * slender.diameter_m);
  EXPECT_LT(of_rod.step_m(), 0.025F * slender.diameter_m);
  SearchModel const crate_model = prepare_model(crate({0.3, 0.2, 0.25}));
  EXPECT_NEAR(PairTable(crate_model).step_m(), 0.05F * crate_model.diameter_m, 1e-5F);
}

}  // namespace
}  // namespace credo::test
