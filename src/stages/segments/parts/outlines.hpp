#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "core/grid.hpp"
#include "core/segments.hpp"
#include "stages/segments/labelled_rows.hpp"

namespace credo::segments {

/// Pixels from the first to the last of both axes; empty where first is beyond last.
struct PixelBox {
  Pixel first{1, 1};
  Pixel last{0, 0};

  [[nodiscard]] bool empty() const { return first.u > last.u || first.v > last.v; }
  void add(PixelBox const& other);
  /// What is in both.
  [[nodiscard]] PixelBox shared_with(PixelBox const& other) const;
  /// With so much more on each side, as far as an image of that size reaches.
  [[nodiscard]] PixelBox grown(int by_px, int width, int height) const;
};

/// Where one segment is beside another: pairs of neighbouring pixels, seen from the one.
struct Meeting {
  /// No jump of depth is between them.
  std::uint32_t touching = 0;
  /// It is nearer than the other, and the other way round.
  std::uint32_t before = 0;
  std::uint32_t behind = 0;
  /// Of the pairs that touch.
  PixelBox touch;

  [[nodiscard]] std::uint32_t pairs() const { return touching + before + behind; }
  void add(Meeting const& other);
};

/// A segment from outside.
struct Outline {
  std::uint32_t pixels = 0;
  PixelBox box;
  std::map<std::int32_t, Meeting> meetings;
};

/// By label; the first belongs to none. Neighbours touch where their inverse depths differ by less
/// than `link_per_m`. Pixels without a segment are beside nothing.
/// `rows` are those of the segments' labels.
[[nodiscard]] std::vector<Outline> outlines_of(Segments const& segments, LabelledRows const& rows,
                                               Grid<float> const& depth_m, float link_per_m);

/// Surfaces that face up within 37 degrees carry what touches them.
inline constexpr double kLevelCosine = 0.8;

/// So many pairs that touch are no accident.
[[nodiscard]] std::uint32_t least_touching_pairs(double focal_px);

/// Makes `from` a part of `into`, for all that they meet.
void join_outlines(std::vector<Outline>& outlines, std::int32_t into, std::int32_t from);

}  // namespace credo::segments
