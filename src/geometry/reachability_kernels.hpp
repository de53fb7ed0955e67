#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/reachability.hpp"

// Inner loops of connected_components, in vector instructions chosen at run time. Every result is
// the same on every instruction set.
namespace credo::reachability {

/// Tiles are squares of this many pixels, so that a tile's pixels are the bits of one word.
inline constexpr int kTile = 8;
/// Narrower images are widened first: a kernel reads kTile pixels and their right neighbours.
inline constexpr int kMinWidth = kTile + 1;

/// The six coordinates of every pixel, row-major; width >= kMinWidth.
struct PointArrays {
  int width = 0;
  int height = 0;
  std::array<float const*, 3> point{};
  std::array<float const*, 3> normal{};
};

/// One bit per pixel, each row in words of its own and one to spare.
class BitRows {
public:
  BitRows(int width, int height)
      : words_(static_cast<std::size_t>(width) / 64 + 2),
        bits_(words_ * static_cast<std::size_t>(height)) {}
  [[nodiscard]] std::size_t words() const { return words_; }
  std::uint64_t* row(int v) { return bits_.data() + words_ * static_cast<std::size_t>(v); }
  [[nodiscard]] std::uint64_t const* row(int v) const {
    return bits_.data() + words_ * static_cast<std::size_t>(v);
  }

private:
  std::size_t words_;
  std::vector<std::uint64_t> bits_;
};

/// Which pixels take part, and which of them are neighbours of those beside and above them.
struct LinkBits {
  LinkBits(int width, int height)
      : usable(width, height),
        right(width, height),
        up(width, height),
        rising(width, height),
        falling(width, height) {}

  /// Active, with finite point and normal.
  BitRows usable;
  /// (u, v) and (u + 1, v) are neighbours.
  BitRows right;
  /// (u, v) and (u, v - 1).
  BitRows up;
  /// (u, v) and (u + 1, v - 1).
  BitRows rising;
  /// (u, v - 1) and (u + 1, v).
  BitRows falling;
  /// Range of the squared lengths of usable normals.
  float min_squared_normal = 1.0F;
  float max_squared_normal = 1.0F;
};

/// Links of all pixels to their eight neighbours in the image. `active` is row-major, one byte a
/// pixel.
[[nodiscard]] LinkBits link_neighbours(PointArrays const& points, std::uint8_t const* active,
                                       ReachThresholds const& reach);

/// Some of the pixels of a tile: bit 8 j + i of the mask is pixel (u + i, v + j). All eight columns
/// lie inside the image; rows that do not have empty bits.
struct TilePixels {
  int u = 0;
  int v = 0;
  std::uint64_t mask = 0;
};

/// Axis-aligned bounds of points (0 to 2) and normals (3 to 5); of nothing: min +inf, max -inf.
struct Bounds {
  std::array<float, 6> min{};
  std::array<float, 6> max{};
};

[[nodiscard]] Bounds bounds_of(PointArrays const& points, TilePixels const& pixels);

/// Is any pixel of a a neighbour of any pixel of b? `bounds_*` are theirs.
[[nodiscard]] bool any_within_reach(PointArrays const& points, TilePixels const& a,
                                    Bounds const& bounds_a, TilePixels const& b,
                                    Bounds const& bounds_b, ReachThresholds const& reach);

/// Boxes side by side, each with the range of components that its pixels belong to. The number of
/// boxes is a multiple of kBoxesAtOnce; the ones that fill up are empty (min +inf, max -inf).
struct BoxList {
  static constexpr std::size_t kBoxesAtOnce = 16;

  explicit BoxList(std::size_t count);
  void set_bounds(std::size_t i, Bounds const& bounds);
  void include(std::size_t i, BoxList const& other, std::size_t j);

  std::array<std::vector<float>, 3> min;
  std::array<std::vector<float>, 3> max;
  std::vector<std::int32_t> first_root;
  std::vector<std::int32_t> last_root;
};

/// Which of the boxes begin ... begin + 15 of `boxes` may hold a neighbour, in another component,
/// of something in box i of `others`: one bit each.
[[nodiscard]] std::uint32_t boxes_in_reach(BoxList const& others, std::size_t i,
                                           BoxList const& boxes, std::size_t begin,
                                           ReachThresholds const& reach);

}  // namespace credo::reachability
