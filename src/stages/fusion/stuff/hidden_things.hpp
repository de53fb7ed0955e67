#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <vector>

#include "core/belief.hpp"
#include "core/label.hpp"
#include "stages/fusion/sight_view.hpp"
#include "stages/fusion/stuff/looks.hpp"
#include "stages/fusion/stuff/moves.hpp"

namespace credo {

/// The clusters that are another part of a thing, which comes out from behind what hides it: they
/// touch what is known of the thing and is hidden, and are not much larger; the thing shows in no
/// cluster, is hidden for the most part, by something else, and is not on its way. By the thing's
/// place in the belief; one each, that of which most touches it.
///
/// `free`: clusters that are nothing known, by their place among `clusters`. `shows`: of each thing
/// whether a cluster is taken for it. Looks are at `stuff`, in its order.
[[nodiscard]] std::map<std::size_t, LabelCode> what_comes_out(
    std::vector<StuffBelief> const& stuff, std::vector<StuffLook> const& looks,
    std::vector<SeenCluster> const& clusters, std::span<std::size_t const> free,
    std::vector<bool> const& shows, SightView const& view);

}  // namespace credo
