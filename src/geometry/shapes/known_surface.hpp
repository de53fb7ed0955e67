#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/object_model.hpp"
#include "geometry/shapes/object_shape.hpp"

namespace credo {

/// A known object's surface as the belief looks for it. Model frame.
struct KnownSurface {
  /// About `spacing_m` apart; some hundred, whatever the size of the model. Never empty.
  std::vector<Eigen::Vector3f> points_model;
  float spacing_m = 0.0F;
  /// Of a sphere about the model's origin that holds it.
  double radius_m = 0.0;
  /// The same surface, to be asked for distances; never null.
  std::shared_ptr<ObjectShape const> shape;
  /// Which other poses would look the same.
  Symmetry symmetry;
};

/// By the name of their model.
using KnownSurfaces = std::map<std::string, KnownSurface>;

/// The same for the same models. Throws std::logic_error for a model without a surface.
[[nodiscard]] KnownSurfaces known_surfaces(ObjectModels const& models);

}  // namespace credo
