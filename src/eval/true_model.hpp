#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "core/object_model.hpp"
#include "core/se3.hpp"
#include "geometry/shapes/object_shape.hpp"

namespace credo {

/// A model made ready to measure poses with.
class TrueModel {
public:
  /// Throws std::logic_error for an empty shape.
  explicit TrueModel(ObjectModel const& model);

  /// The largest distance between two points of its surface, to the spacing of the points that are
  /// looked at (a fortieth).
  [[nodiscard]] double diameter_m() const { return diameter_m_; }
  /// Between the middles of its bounds at two poses.
  [[nodiscard]] double centre_distance_m(Se3 const& a, Se3 const& b) const;

  struct PoseError {
    double translation_m = 0.0;
    double rotation_rad = 0.0;
  };
  /// Least over the model's symmetry: of the origin, or of the symmetry axis' point; turns about
  /// the axis do not count.
  [[nodiscard]] PoseError error(Se3 const& believed, Se3 const& truth) const;
  /// Mean distance from points of the believed surface to the true surface (ADD-S of Hinterstoisser
  /// et al. 2012, in the limit of dense points).
  [[nodiscard]] double add_s_m(Se3 const& believed, Se3 const& truth) const;
  /// Mean distance between the same points of both surfaces (ADD of the same paper). Turns that
  /// the symmetry allows count as errors here.
  [[nodiscard]] double add_m(Se3 const& believed, Se3 const& truth) const;
  [[nodiscard]] Symmetry const& symmetry() const { return symmetry_; }

private:
  Symmetry symmetry_;
  ObjectShape shape_;
  std::vector<Eigen::Vector3d> surface_points_;
  double diameter_m_ = 0.0;
};

/// By the name of the type.
using TrueModels = std::map<std::string, TrueModel>;

}  // namespace credo
