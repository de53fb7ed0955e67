#pragma once

#include <cstdint>
#include <vector>

#include "core/belief.hpp"
#include "core/label.hpp"
#include "stages/fusion/stuff/looks.hpp"

namespace credo {

/// Stands for floor, walls and known objects in StuffBelief::one_with; no thing's id.
inline constexpr std::uint32_t kKnownThings = 0;

/// How much a look says about two being one, of which one shows in so many blocks: the less the
/// smaller it is, for blocks at its edge may be taken for either. What shows in a hundred counts in
/// full, in 25 by little more than half, in 4 and fewer not at all; what is larger by up to 1.6.
[[nodiscard]] double counts_as_one(int blocks);

/// Adds a look in which `item` showed in another thing's clusters to what says that the two are
/// one; whether that is enough. `news` is how much of the look counts (novelty), `blocks` in how
/// many the larger of the two shows. What showed alone in many looks before takes longer to become
/// one with another: it begins below nothing, farther where both show in less than a hundred.
[[nodiscard]] bool shows_as_one(StuffBelief& item, std::uint32_t id, double news, int blocks);

/// The same in which it showed as floor, wall or known object.
[[nodiscard]] bool shows_as_known(StuffBelief& item, double news);

/// A look in which it showed by itself, and so did those of `stuff` that it might be one with. It
/// takes five such looks to undo one of the others: what shows as one every second time is one
/// thing, what does so only now and then is two.
void shows_alone(StuffBelief& item, std::vector<StuffBelief> const& stuff, double news);

/// How much of what was seen of a thing a look shows, how often that was seen: square metres of
/// surface times looks. `model` is the one that was looked at; 0 where it is out of view.
[[nodiscard]] double amount_shown(StuffModel const& model, StuffLook const& look);

/// The same of what shows in one of the frame's clusters; `shown` has each block's label.
[[nodiscard]] double amount_shown(StuffModel const& model, StuffLook const& look,
                                  LabelMap const& shown, LabelCode label);

}  // namespace credo
