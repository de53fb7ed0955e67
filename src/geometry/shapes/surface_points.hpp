#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/object_model.hpp"

namespace credo {

/// Points on the surface of a model, in its frame, about `spacing_m` apart. Of solids edges
/// and corners are among them, points inside of another solid are not. Never empty; the same for
/// the same model. Throws std::logic_error for a spacing that is not positive.
[[nodiscard]] std::vector<Eigen::Vector3d> surface_points(ObjectModel const& model,
                                                          double spacing_m);

}  // namespace credo
