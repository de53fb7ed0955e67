#pragma once

#include <cstddef>
#include <cstdint>

namespace credo {

/// Tuned on the tuning sets.
struct FpfhSettings {
  /// Between the scene's points that descriptors are taken of; those of models are as far apart as
  /// SearchModel has them, 4 mm or more.
  double surface_m = 0.005;
  /// Between the points that have a descriptor.
  double key_spacing_m = 0.010;
  /// Of descriptors, and of the principal curvatures.
  double radius_m = 0.03;
  /// Model views that descriptors are taken from.
  std::size_t views = 20;
  /// A plane at least so long is nothing that a model's descriptors know of.
  float background_m = 0.6F;
  /// The thesis' sigma_f; each third of a descriptor sums up to 100.
  float deviation = 80.0F;
  /// Points of the scene that are drawn, the model's features that are nearest to each, and draws
  /// among them.
  std::size_t points = 600;
  std::size_t nearest = 30;
  std::size_t matches = 4;
  /// Where the lesser principal curvature is a greater share of the larger one than this, there is
  /// no direction, and the turn about the normal is drawn.
  float round_share = 0.8F;
  std::uint64_t seed = 1;
};

}  // namespace credo
