#pragma once

#include "core/fields.hpp"
#include "core/grid.hpp"
#include "core/segments.hpp"

namespace credo {

/// Of the camera that lengths in pixels are told for.
inline constexpr double kReferenceFocal_px = 525.0;

/// Segments by convexity in inverse depth. Lengths in pixels are those of a camera of that focal
/// length; for others they are scaled. Heights are in quanta of inverse depth.
struct SegmentsConfig {
  /// Without, clusters are grown from points and normals (thesis 3.3).
  bool enabled = true;
  /// One quantum: what the sensor's inverse depth is uncertain by [1/m]. Kinect: 0.00287.
  double quantum_per_m = 0.00287;
  /// Neighbours whose inverse depths differ by less are one surface.
  double link_quanta = 9.0;
  /// A smoothed pixel is the mean of those around it that differ by less.
  double smooth_quanta = 6.0;
  int smooth_radius_px = 2;
  /// Concavity is measured between pixels so far apart, on surfaces that rise by less.
  int reach_px = 6;
  double reach_quanta = 15.0;
  /// Over twice that distance concavity counts so much: where floor and wall meet, it grows with
  /// the distance, and over the shorter is no more than noise. 0 leaves it out.
  double far_weight = 0.65;
  /// A crease is as concave as this, or as this many times the frame's own noise, if that is more,
  double crease_quanta = 2.25;
  double crease_noise = 1.4;
  /// and more where the surface is steep.
  double crease_slope = 1.75;
  /// Of the discs in which planes are fitted on both sides of a border.
  int disc_radius_px = 12;
  /// Smaller parts go to what they touch.
  int min_pixels = 80;
  /// Joins the parts of one thing: see join_parts and join_sides.
  bool join_parts = true;
  /// Where colour is registered, what has no crease comes apart by colours that differ by more, as
  /// distances of the shares of red and green in all light: see split_by_color. 0 leaves colour
  /// out.
  double color_apart = 0.1;
  /// What stands out of a flat surface by more is a thing that lies on it; 0 looks for none.
  double raised_quanta = 2.0;
  /// Smaller things are not looked for.
  int raised_min_pixels = 100;
};
FieldList fields(SegmentsConfig& config);

/// Holds touching things apart: cuts where the surface is concave, joins what is convex, so that a
/// box is one segment and the table under it another. From depth alone, metres; not positive or not
/// finite = invalid. The same bytes on every machine.
///
/// Any image gives an answer, an empty one too. Without valid pixels there is no segment. Nor is
/// there where pixels are too few together: islands of less than `min_pixels` that have no core of
/// 8x8, noise, a checkerboard of single pixels. Whole islands have labels, or none of their pixels.
/// What is so near that its inverse depth exceeds 2000 quanta is as far as these: with a Kinect's,
/// all below 0.174 m is one flat surface. What is so far that it is below a 32nd of a quantum, 11
/// km, is invalid. Flat frames are one segment.
///
/// In inverse depth planes are affine in the image, a concave crease is a positive second
/// difference, and the sensor's noise is the same at every range.
[[nodiscard]] Segments convex_segments(Grid<float> const& depth_m, double focal_px,
                                       SegmentsConfig const& config);

}  // namespace credo
