#include "geometry/bingham/symmetric_eigen.hpp"

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <random>
#include <vector>

namespace credo::test {
namespace {

using Eigen::Matrix4d;
using Eigen::Vector4d;

void expect_right(Matrix4d const& A) {
  SymmetricEigen const parts = symmetric_eigen(A);
  double const tolerance = 1e-14 * A.norm();
  Matrix4d const& V = parts.vectors;
  EXPECT_LE((V.transpose() * V - Matrix4d::Identity()).norm(), 1e-14) << A;
  EXPECT_LE((V * parts.values.asDiagonal() * V.transpose() - A).norm(), tolerance) << A;
  Eigen::MatrixXd const dynamic = A;
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> const other(dynamic);
  EXPECT_LE((parts.values - other.eigenvalues()).norm(), tolerance) << A;
  EXPECT_TRUE(parts.values[0] <= parts.values[1] && parts.values[1] <= parts.values[2] &&
              parts.values[2] <= parts.values[3]);
}

Matrix4d random_matrix(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return Matrix4d::NullaryExpr([&]() { return normal(random); });
}

TEST(SymmetricEigen, PutsTheMatrixTogetherAgainAtAnyScale) {
  std::mt19937_64 random(1);
  for (int run = 0; run < 500; ++run) {
    Matrix4d const A = random_matrix(random);
    for (double const scale : {1e-9, 1.0, 1e9}) {
      expect_right(scale * (A + A.transpose()));
    }
  }
}

TEST(SymmetricEigen, EqualValuesAreNoTrouble) {
  std::mt19937_64 random(2);
  std::vector<Vector4d> const all = {{0, 0, 0, 0},   {1, 1, 1, 1},          {-2, -2, -2, 0},
                                     {-5, -5, 0, 0}, {-5, -5 + 1e-9, 0, 0}, {-1e8, -1, -1, 0},
                                     {3, 0, 0, 0},   {-1, -1e-12, 1e-12, 1}};
  for (Vector4d const& values : all) {
    expect_right(values.asDiagonal());
    for (int run = 0; run < 50; ++run) {
      Matrix4d const V = random_matrix(random).householderQr().householderQ();
      Matrix4d const A = V * values.asDiagonal() * V.transpose();
      expect_right(0.5 * (A + A.transpose()));
    }
  }
}

// Two axes with nothing to turn, while two others have.
TEST(SymmetricEigen, APairMayBeDoneAlready) {
  Matrix4d A;
  A << 1, 2, 0, 0, 2, 1, 0, 0, 0, 0, 3, 0, 0, 0, 0, 3;
  expect_right(A);
  expect_right(A.reverse());
}

TEST(SymmetricEigen, ReadsTheUpperTriangleOnly) {
  Matrix4d A;
  A << 4, 1, 2, 3, 99, 3, 0, 1, 99, 99, 2, 5, 99, 99, 99, 1;
  Matrix4d const whole = A.selfadjointView<Eigen::Upper>();
  EXPECT_EQ(symmetric_eigen(A).values, symmetric_eigen(whole).values);
}

}  // namespace
}  // namespace credo::test
