#pragma once

#include "detector/poses/verification.hpp"

namespace credo {

/// A pose that was refined and held against the scene.
struct PoseCandidate {
  CameraPose pose;
  Verification verification;
  /// That it is right; set once its rivals are known.
  float probability = 0.0F;
};

/// A candidate refined by all that its view shows, where that is likelier, and as it was where not.
[[nodiscard]] PoseCandidate polished(SearchModel const& model, SearchScene const& scene,
                                     PoseCandidate rough);

}  // namespace credo
