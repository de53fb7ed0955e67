#pragma once

#include "core/segmentation.hpp"

namespace credo {

/// Gives known objects the segments that are theirs: where `segmentation.objects` hold three tenths
/// of a segment, what of it nobody has joins the one that holds most; where they hold little of it
/// (kHardlyShare), that little is given back, and so is what lies on a surface of theirs
/// (`Segments::lies_on`). A pose that is a centimetre off leaves the rim of a table over, and takes
/// a strip of what stands on it; a segment ends where the surface does.
///
/// `segmentation.segments` and labels have one size; without segments nothing happens. Pixel counts
/// of the objects become those that they have then.
[[nodiscard]] Segmentation settle_objects(Segmentation segmentation);

}  // namespace credo
