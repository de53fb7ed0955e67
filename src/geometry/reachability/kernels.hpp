#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/reachability/reachability.hpp"

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

/// Axis-aligned bounds of points or of normals; of nothing: min +inf, max -inf.
struct Box {
  std::array<float, 3> min{};
  std::array<float, 3> max{};
};

/// Boxes side by side, each with the range of components that its pixels belong to. The number of
/// boxes is a multiple of kBoxesAtOnce; all begin empty, without components.
struct BoxList {
  static constexpr std::size_t kBoxesAtOnce = 16;

  explicit BoxList(std::size_t count);
  void set_box(std::size_t i, Box const& box);
  [[nodiscard]] Box box(std::size_t i) const;
  void include(std::size_t i, BoxList const& other, std::size_t j);

  std::array<std::vector<float>, 3> min;
  std::array<std::vector<float>, 3> max;
  std::vector<std::int32_t> first_root;
  std::vector<std::int32_t> last_root;
};

/// How the tiles of an image are numbered: block by block, so that a block's tiles are neighbours
/// in a BoxList. Blocks are squares of kBlock tiles.
struct TileLayout {
  static constexpr std::size_t kBlock = 4;
  static constexpr std::size_t kTilesPerBlock = kBlock * kBlock;

  TileLayout(int width, int height)
      : tiles_u((static_cast<std::size_t>(width) + kTile - 1) / kTile),
        tiles_v((static_cast<std::size_t>(height) + kTile - 1) / kTile),
        blocks_u((tiles_u + kBlock - 1) / kBlock),
        block_count(blocks_u * ((tiles_v + kBlock - 1) / kBlock)) {}
  /// Number of the tile in column tu and row tv of tiles.
  [[nodiscard]] std::size_t tile_at(std::size_t tu, std::size_t tv) const {
    return ((tv / kBlock) * blocks_u + tu / kBlock) * kTilesPerBlock + (tv % kBlock) * kBlock +
           tu % kBlock;
  }

  std::size_t tiles_u;
  std::size_t tiles_v;
  std::size_t blocks_u;
  std::size_t block_count;
};
static_assert(TileLayout::kTilesPerBlock == BoxList::kBoxesAtOnce);

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

/// Which pixels take part, and which of them are neighbours of those beside and above them. Links
/// tell nothing where one of the two takes no part. A diagonal link may be left out where the links
/// beside and above join its two pixels anyway.
struct LinkBits {
  LinkBits(int width, int height)
      : usable(width, height),
        right(width, height),
        up(width, height),
        rising(width, height),
        falling(width, height),
        layout(width, height),
        tiles(layout.block_count * TileLayout::kTilesPerBlock) {}

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
  TileLayout layout;
  /// Bounds of the usable points of each tile; no components yet.
  BoxList tiles;
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

/// Bounds of one of the two triples of arrays, `points.point` or `points.normal`, over pixels.
[[nodiscard]] Box box_of(std::array<float const*, 3> const& arrays, int width,
                         TilePixels const& pixels);

/// Is any pixel of a a neighbour of any pixel of b? The boxes are those of their points.
[[nodiscard]] bool any_within_reach(PointArrays const& points, TilePixels const& a,
                                    Box const& box_a, TilePixels const& b, Box const& box_b,
                                    ReachThresholds const& reach);

/// For each pixel of tile a, by its bit, which pixels of tile b are its neighbours.
using TileLinks = std::array<std::uint64_t, std::size_t{kTile} * kTile>;
[[nodiscard]] TileLinks tile_links(PointArrays const& points, TilePixels const& a,
                                   TilePixels const& b, ReachThresholds const& reach);

/// Which of the boxes begin ... begin + 15 of `boxes` may hold a neighbour, in another component,
/// of something in box i of `others`: one bit each.
[[nodiscard]] std::uint32_t boxes_in_reach(BoxList const& others, std::size_t i,
                                           BoxList const& boxes, std::size_t begin,
                                           ReachThresholds const& reach);

}  // namespace credo::reachability
