#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/segmentation.hpp"

// Hand-made frames with depth: boards that face the camera, before a far wall.
namespace credo::test {

/// A board that faces the camera, its edges along the image's. World metres; the camera looks along
/// +z from where it stands.
struct Board {
  /// Of its cluster, or of the wall or known object that it is; none for what nothing explains.
  std::optional<LabelCode> label;
  double left_m = 0.0;
  double top_m = 0.0;
  double width_m = 0.2;
  double height_m = 0.2;
  double z_m = 1.5;
  /// The cluster that it lies on.
  std::optional<LabelCode> lies_on = std::nullopt;
};

/// Where no board is, a wall 3 m away. 160 x 120 at 150 px: 1.5 m away a pixel is a centimetre.
struct View {
  std::vector<Board> boards = {};
  std::int64_t stamp_ns = 0;
  /// The camera's place; it looks along +z.
  double x_m = 0.0;
  double y_m = 0.0;
  /// A square of pixels at the left edge without depth.
  int blind_px = 0;
};

Segmentation segmentation_of(View const& view);

}  // namespace credo::test
