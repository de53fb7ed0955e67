#pragma once

#include <Eigen/Geometry>
#include <random>

#include "geometry/bingham/bingham.hpp"

namespace credo {

/// One exact draw, by rejection from an angular central Gaussian (Kent, Ganeiber and Mardia 2013).
/// At least 0.44 of the tries are taken. A generator in the same state gives the same rotation.
[[nodiscard]] Eigen::Quaterniond sample(Bingham const& distribution, std::mt19937_64& random);

}  // namespace credo
