#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <vector>

#include "core/belief.hpp"
#include "core/label.hpp"
#include "stages/fusion/stuff/cluster_owners.hpp"
#include "stages/fusion/stuff/known_places.hpp"
#include "stages/fusion/stuff/looks.hpp"
#include "stages/fusion/stuff/shown_planes.hpp"

// What a frame shows a thing in. Each look is at the thing beside it.
namespace credo {

/// Whether most of what shows of a thing shows as floor, wall or known object.
[[nodiscard]] bool shows_known(StuffBelief const& item, StuffLook const& look,
                               ShownPlanes const& planes);

/// Whether most of it shows so or in clusters that are a believed wall's, some of it in those.
[[nodiscard]] bool shows_on_walls(StuffBelief const& item, StuffLook const& look,
                                  ClusterOwners const& owners);

/// Whether what shows is, for the most part, a known object that the frame before did not show.
/// That is found since, and no other name for what was in sight already. `shown` has each block's
/// label.
[[nodiscard]] bool shows_found_object(StuffLook const& look, LabelMap const& shown,
                                      KnownPlaces const& places);

/// The thing whose clusters show most of this one, both by their places in the belief; none for
/// most. `released`: clusters that say nothing of it. Looks are at `stuff`, in its order.
[[nodiscard]] std::optional<std::size_t> host_of(std::size_t item,
                                                 std::vector<StuffBelief> const& stuff,
                                                 std::vector<StuffLook> const& looks,
                                                 ClusterOwners const& owners,
                                                 std::set<LabelCode> const& released);

}  // namespace credo
