#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/belief.hpp"
#include "core/label.hpp"
#include "stages/fusion/sight_view.hpp"
#include "stages/fusion/stuff/moves.hpp"

namespace credo {

/// So many names a thing keeps of what became one with it, those that came last, and of each so
/// many points.
inline constexpr std::size_t kMostNamesKept = 8;
inline constexpr std::size_t kMostPointsKept = 200;

/// What becomes one with a thing, and what became one with that before, is remembered with it. Both
/// must have a model, and it is as it was before they became one.
void remember_name(StuffBelief& host, StuffBelief const& joined);

/// The second as a part of the first, which remembers its name and tells of its end. Both must have
/// a model; the second is to be forgotten.
void become_one(StuffBelief& first, StuffBelief const& second);

/// Forgets where a frame sees through what was remembered: it does not stand there any more, and
/// what comes there is something else. Where too little of it is told, it is kept.
void forget_what_left(std::vector<StuffBelief>& stuff, SightView const& view);

/// The name of what became one with a thing of `stuff` and stood where the frame shows the cluster
/// `seen`, which is none of these things: of what the frame shows of it most is in that cluster. It
/// is no longer remembered there. None for most. Not what became one in this very frame, for its id
/// has just been told to have gone.
[[nodiscard]] std::optional<JoinedThing> name_of_old(std::vector<StuffBelief>& stuff,
                                                     LabelCode label, SeenCluster const& seen,
                                                     SightView const& view);

}  // namespace credo
