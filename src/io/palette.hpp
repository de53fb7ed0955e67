#pragma once

#include <cstddef>
#include <cstdint>

#include "core/frame.hpp"
#include "core/label.hpp"

namespace credo {

/// The colours of the thesis' figures, on a dark ground.
inline constexpr Rgb kBackground = {24, 24, 28};
/// Of what the latest cloud has and no label explains.
inline constexpr Rgb kCyan = {0, 190, 200};
inline constexpr Rgb kRed = {225, 40, 40};
inline constexpr Rgb kPink = {255, 130, 190};

/// Between two colours, by the share of the second.
Rgb mixed(Rgb a, Rgb b, double share_of_b);

/// Depth as grey, the nearer the brighter; black for none.
Rgb depth_grey(float depth_m);

/// The colour of a label that the belief tells nothing about; black for no depth, cyan for
/// unassigned.
Rgb label_color(LabelCode label);

/// The colour of a known object, by its position in the belief: magenta, blue, ... (thesis 4.4.1).
Rgb object_color(std::size_t object, double probability);

/// The colour of a piece of stuff in the belief's panels, the same for its whole life.
Rgb stuff_color(std::uint32_t id, double probability);

/// That colour in a word.
char const* stuff_color_name(std::uint32_t id);

}  // namespace credo
