#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/label.hpp"
#include "stages/fusion/stuff/known_places.hpp"
#include "stages/fusion/stuff/looks.hpp"
#include "stages/fusion/stuff/moves.hpp"

namespace credo {

/// What a cluster must have, in blocks, to be a thing.
inline constexpr std::size_t kLeastBlocksOfThing = 12;
/// A cluster that is explained by so much is none of its own.
inline constexpr double kExplained = 0.7;
/// A cluster can be a thing's where so much of what the thing should show there agrees.
inline constexpr double kLeastAgreementOfCluster = 0.25;

/// Which thing each cluster of a frame is taken for: the one with which it has the most in common
/// of what both have. A thing may own many clusters.
class ClusterOwners {
public:
  /// Looks in the order of the belief, clusters by label from kFirstStuff on; both are kept by
  /// reference.
  ClusterOwners(std::vector<StuffLook> const& looks, std::vector<SeenCluster> const& clusters,
                KnownPlaces const& places);

  /// By its place in the belief; none for a cluster that is no thing's yet.
  [[nodiscard]] std::optional<std::size_t> owner(LabelCode label) const;
  /// Whether a cluster is no thing's and lies, for the most part, on a believed wall.
  [[nodiscard]] bool is_walls(LabelCode label) const;
  void give(LabelCode label, std::size_t item);
  /// It is no thing's any more.
  void release(LabelCode label);
  /// Whether a cluster lies on this thing and is not a part of it.
  [[nodiscard]] bool is_base_of(std::size_t item, LabelCode label) const;

private:
  [[nodiscard]] bool is_good_part_of(std::size_t item, LabelCode label) const;
  [[nodiscard]] std::optional<double> overlap_of(std::size_t item, ClusterShare const& share) const;
  void associate(bool lying);

  std::vector<StuffLook> const& looks_;
  std::vector<SeenCluster> const& clusters_;
  /// By cluster, whether the most of it lies on a believed wall.
  std::vector<bool> on_wall_;
  /// By cluster; -1 for none.
  std::vector<std::int32_t> owners_;
  /// By cluster, what it and its owner have in common.
  std::vector<double> best_;
};

}  // namespace credo
