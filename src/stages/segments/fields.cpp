#include "stages/segments/segments.hpp"

#include <algorithm>
#include <iterator>

namespace credo {
namespace {

FieldList surface_fields(SegmentsConfig& config) {
  return {
      {"enabled",
       &config.enabled,
       {},
       "",
       "hold touching things apart where surfaces are concave; false: stuff as the thesis has it"},
      {"quantum_per_m",
       &config.quantum_per_m,
       {1e-5, 0.1},
       "1/m",
       "what the sensor's inverse depth is uncertain by; a Kinect's: 0.00287"},
      {"link_quanta",
       &config.link_quanta,
       {1, 100},
       "quanta",
       "neighbours that differ by less are one surface"},
      {"smooth_quanta",
       &config.smooth_quanta,
       {1, 7},
       "quanta",
       "a smoothed pixel is the mean of those around it that differ by less"},
      {"smooth_radius_px",
       &config.smooth_radius_px,
       {0, 8},
       "px",
       "... in a square of this radius"},
  };
}

FieldList crease_fields(SegmentsConfig& config) {
  return {
      {"reach_px",
       &config.reach_px,
       {2, 16},
       "px",
       "concavity is measured from a pixel to both sides so far"},
      {"reach_quanta",
       &config.reach_quanta,
       {1, 100},
       "quanta",
       "... on surfaces that rise by less on either side"},
      {"far_weight",
       &config.far_weight,
       {0, 1},
       "",
       "... and over twice that distance, where it counts so much; 0 leaves it out"},
      {"crease_quanta",
       &config.crease_quanta,
       {0.1, 100},
       "quanta",
       "a crease is at least so concave"},
      {"crease_noise",
       &config.crease_noise,
       {0, 10},
       "",
       "... and this many times as concave as three quarters of the frame"},
      {"crease_slope",
       &config.crease_slope,
       {0, 5},
       "",
       "... and more by this part of the surface's steepness"},
      {"disc_radius_px",
       &config.disc_radius_px,
       {4, 50},
       "px",
       "planes on both sides of a border are fitted in discs of this radius"},
      {"min_pixels", &config.min_pixels, {1, 1e6}, "px", "smaller parts go to what they touch"},
  };
}

FieldList thing_fields(SegmentsConfig& config) {
  return {
      {"join_parts",
       &config.join_parts,
       {},
       "",
       "the inside and the outside of a vessel are one thing, and so is a thing with its handle, "
       "cap or neck, and a box with its lid"},
      {"color_apart",
       &config.color_apart,
       {0, 1},
       "",
       "things without a crease between them come apart by colours that differ by more, in shares "
       "of red and green, where colour is registered; 0 leaves colour out"},
      {"raised_quanta",
       &config.raised_quanta,
       {0, 100},
       "quanta",
       "what stands out of a flat surface by more is a thing that lies on it; 0 looks for none"},
      {"raised_min_pixels",
       &config.raised_min_pixels,
       {1, 1e6},
       "px",
       "... if it is as large as this"},
  };
}

}  // namespace

FieldList fields(SegmentsConfig& config) {
  FieldList all = surface_fields(config);
  std::ranges::move(crease_fields(config), std::back_inserter(all));
  std::ranges::move(thing_fields(config), std::back_inserter(all));
  return all;
}

}  // namespace credo
