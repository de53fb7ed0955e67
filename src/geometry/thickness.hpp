#pragma once

#include <map>

#include "core/label.hpp"

namespace credo {

/// How thick each thing of a label image is: the edge of the square that has as much area for its
/// outline, in pixels. Twice the width of a long strip. Slivers, which noise and edges leave over,
/// are thin; things seldom are. Sides of pixels at the image's border are no outline: nobody knows
/// what is beyond. By label, of stuff alone (from kFirstStuff on).
[[nodiscard]] std::map<LabelCode, double> thickness_px(LabelMap const& labels);

}  // namespace credo
