#pragma once

#include "core/segmentation.hpp"
#include "stages/fusion/fusion.hpp"
#include "stages/fusion/stuff/known_places.hpp"
#include "stages/fusion/stuff/stuff.hpp"

namespace credo {

/// The stuff after one more frame, by a rule of our own that knows what it could not see.
///
/// Each thing keeps a model of its surface, and every frame says of each point of that: something
/// is measured there, something nearer hides it, it is seen through, it has no depth, it is out of
/// view. Clusters go to the thing with which they share most, many to one thing where it is seen in
/// pieces. What agrees makes a thing more probable, what is seen through less; where too little of
/// it is seen either way, its log-odds stay what they were, to the bit. Frames that repeat each
/// other count once (novelty). Clusters at known places are no new things, unless they lie on
/// another.
///
/// What was on its way when it was last seen is less and less likely to be there still, `elapsed_s`
/// after the frame before.
///
/// Wants segmentation.sight; without one nothing is seen, and nothing changes.
[[nodiscard]] FusedStuff fused_items(FusedStuff known, Segmentation const& segmentation,
                                     KnownPlaces const& places, double elapsed_s,
                                     FusionConfig const& config);

}  // namespace credo
