#include "stages/fusion/stuff/shown_in.hpp"

#include <algorithm>
#include <utility>

#include "stages/fusion/findings.hpp"

namespace credo {
namespace {

constexpr double kShareInAnother = 0.6;

bool mostly_in(StuffBelief const& item, StuffLook const& look, int blocks) {
  return look.blocks >= least_told(item.most_agreeing) && blocks > kShareInAnother * look.blocks;
}

}  // namespace

bool shows_known(StuffBelief const& item, StuffLook const& look, ShownPlanes const& planes) {
  auto const share = std::ranges::find(look.shares, kFloor, &ClusterShare::label);
  return share != look.shares.end() && mostly_in(item, look, share->blocks) &&
         planes.are_what_shows(look);
}

bool shows_on_walls(StuffBelief const& item, StuffLook const& look, ClusterOwners const& owners) {
  int known = 0;
  int on_walls = 0;
  for (ClusterShare const& share : look.shares) {
    bool const is_walls = is_stuff(share.label) && owners.is_walls(share.label);
    on_walls += is_walls ? share.blocks : 0;
    known += is_walls || share.label == kFloor ? share.blocks : 0;
  }
  return on_walls > 0 && mostly_in(item, look, known);
}

bool shows_found_object(StuffLook const& look, LabelMap const& shown, KnownPlaces const& places) {
  int found = 0;
  int agreeing = 0;
  for (PointLook const& point : look.points) {
    if (point.state == PointState::kAgrees) {
      LabelCode const label = shown[static_cast<std::size_t>(point.block)];
      ++agreeing;
      found += is_object(label) && !places.has_shown(label) ? 1 : 0;
    }
  }
  return 2 * found > agreeing;
}

std::optional<std::size_t> host_of(std::size_t item, std::vector<StuffBelief> const& stuff,
                                   std::vector<StuffLook> const& looks, ClusterOwners const& owners,
                                   std::set<LabelCode> const& released) {
  std::vector<std::pair<std::size_t, int>> blocks_in;
  for (ClusterShare const& share : looks[item].shares) {
    std::optional<std::size_t> const host = is_stuff(share.label) && !released.contains(share.label)
                                                ? owners.owner(share.label)
                                                : std::nullopt;
    if (!host) {
      continue;
    }
    auto const found = std::ranges::find(blocks_in, *host, &std::pair<std::size_t, int>::first);
    if (found == blocks_in.end()) {
      blocks_in.emplace_back(*host, share.blocks);
    } else {
      found->second += share.blocks;
    }
  }
  for (auto const& [host, blocks] : blocks_in) {
    if (host != item && mostly_in(stuff[item], looks[item], blocks) &&
        stuff[host].model != nullptr) {
      return host;
    }
  }
  return std::nullopt;
}

}  // namespace credo
