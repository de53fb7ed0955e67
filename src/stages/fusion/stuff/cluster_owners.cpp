#include "stages/fusion/stuff/cluster_owners.hpp"

#include <algorithm>

namespace credo {
namespace {

// A thing and its cluster share so much of either.
constexpr double kLeastShareOfCluster = 0.3;
constexpr double kLeastShareOfThing = 0.4;
// What is so much of what a thing shows does not lie on it.
constexpr double kGoodPart = 0.4;

std::size_t place_of(LabelCode label) {
  return label - std::size_t{kFirstStuff};
}

}  // namespace

ClusterOwners::ClusterOwners(std::vector<StuffLook> const& looks,
                             std::vector<SeenCluster> const& clusters, KnownPlaces const& places)
    : looks_(looks),
      clusters_(clusters),
      owners_(clusters.size(), -1),
      best_(clusters.size(), 0.0) {
  on_wall_.reserve(clusters.size());
  for (SeenCluster const& cluster : clusters) {
    on_wall_.push_back(places.are_on_walls(cluster.points_world, kExplained));
  }
  // First what lies on nothing: a thing that lies on another is not that one.
  associate(false);
  associate(true);
}

std::optional<std::size_t> ClusterOwners::owner(LabelCode label) const {
  std::int32_t const owner = owners_[place_of(label)];
  return owner < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(owner));
}

bool ClusterOwners::is_walls(LabelCode label) const {
  return on_wall_[place_of(label)] && !owner(label);
}

void ClusterOwners::give(LabelCode label, std::size_t item) {
  owners_[place_of(label)] = static_cast<std::int32_t>(item);
}

void ClusterOwners::release(LabelCode label) {
  owners_[place_of(label)] = -1;
}

bool ClusterOwners::is_base_of(std::size_t item, LabelCode label) const {
  std::int32_t const base = clusters_[place_of(label)].lies_on;
  return base >= 0 && owners_[static_cast<std::size_t>(base)] == static_cast<std::int32_t>(item) &&
         !is_good_part_of(item, label);
}

/// A lid, say, which the segmentation finds raised above its box in one frame and not in the next.
bool ClusterOwners::is_good_part_of(std::size_t item, LabelCode label) const {
  auto const& shares = looks_[item].shares;
  auto const share = std::ranges::find(shares, label, &ClusterShare::label);
  return share != shares.end() && share->blocks > kGoodPart * looks_[item].blocks;
}

/// What a thing and a cluster have in common, of what both have; none where that is too little.
std::optional<double> ClusterOwners::overlap_of(std::size_t item, ClusterShare const& share) const {
  std::size_t const area = clusters_[place_of(share.label)].blocks.size();
  double const all = static_cast<double>(area) + looks_[item].blocks;
  double const blocks = share.blocks;
  bool const enough = blocks > kLeastShareOfCluster * static_cast<double>(area) ||
                      blocks > kLeastShareOfThing * looks_[item].blocks;
  if (share.agreement() < kLeastAgreementOfCluster || area < kLeastBlocksOfThing || !enough) {
    return std::nullopt;
  }
  // The wall has most of it: what has less does not get it.
  if (on_wall_[place_of(share.label)] && blocks <= kExplained * static_cast<double>(area)) {
    return std::nullopt;
  }
  return blocks / (all - blocks);
}

/// Of the clusters that lie on others, or of those that do not.
void ClusterOwners::associate(bool lying) {
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    for (ClusterShare const& share : looks_[i].shares) {
      if (!is_stuff(share.label) || (clusters_[place_of(share.label)].lies_on >= 0) != lying ||
          is_base_of(i, share.label)) {
        continue;
      }
      std::optional<double> const overlap = overlap_of(i, share);
      double& most = best_[place_of(share.label)];
      if (overlap && *overlap > most) {
        most = *overlap;
        give(share.label, i);
      }
    }
  }
}

}  // namespace credo
