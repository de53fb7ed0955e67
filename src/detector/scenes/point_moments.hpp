#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

namespace credo {

/// Sums over points.
struct PointMoments {
  double count = 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  /// Of the surface that they stand for.
  double area_m2 = 0.0;

  void add(Eigen::Vector3f const& point_f, double area) {
    Eigen::Vector3d const point = point_f.cast<double>();
    count += 1.0;
    sum += point;
    squares += point * point.transpose();
    area_m2 += area;
  }
};

/// Mean, main axes and variances along them, rising. Of no points it is not a number.
struct PointSpread {
  Eigen::Vector3d mean;
  Eigen::Matrix3d axes;
  Eigen::Vector3d variances;
};

[[nodiscard]] inline PointSpread spread_of(PointMoments const& moments) {
  Eigen::Vector3d const mean = moments.sum / moments.count;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> const solver(moments.squares / moments.count -
                                                              mean * mean.transpose());
  return {mean, solver.eigenvectors(), solver.eigenvalues().cwiseMax(0.0)};
}

}  // namespace credo
