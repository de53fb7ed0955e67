#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/belief.hpp"
#include "core/label.hpp"
#include "stages/fusion/stuff/looks.hpp"
#include "stages/fusion/stuff/moves.hpp"

namespace credo {

/// A thing that a frame shows.
struct FoundThing {
  /// Its place in the belief.
  std::size_t item = 0;
  /// Clusters that are taken for it, ascending; the thing's own label is that of the one that shows
  /// most of what was seen of it.
  std::vector<LabelCode> labels;
  /// How much of the frame is news about it.
  double news = 0.0;
  /// Whether it has moved on since: what was known of its surface is not where it is now.
  bool is_elsewhere = false;
  /// Filled by learn_of: those of the clusters that showed to be things of their own.
  std::vector<LabelCode> parts = {};
};

/// A frame from which models are learnt.
struct Lesson {
  StuffLooks const& looks;
  LabelMap const& shown;
  std::vector<SeenCluster> const& clusters;
  std::vector<StuffBelief> const& stuff;
  /// Of each thing, before the frame.
  std::span<double const> log_odds_before;
};

/// The models of what was found, after the frame. Each thing's depends on the frame and itself.
void learn_of(std::vector<FoundThing>& found, std::vector<StuffBelief>& stuff,
              Lesson const& lesson);

/// The item with that model, and what readers of a belief see of it.
void set_model(StuffBelief& item, StuffModel model, std::size_t pixel_count);

/// The item with the model of what is seen, as if for the first time.
void begin_model(StuffBelief& item, SeenCluster const& seen);

}  // namespace credo
