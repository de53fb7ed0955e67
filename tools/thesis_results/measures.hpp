#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scene_run.hpp"

namespace credo {

/// Which of our labels are meant.
using WantedLabel = std::function<bool(LabelCode)>;

/// Who a true label is, by the scene's name of it: "floor", "box", "left pillar"; "nothing" for no
/// depth.
std::string true_name(FrameTruth const& truth, LabelCode label);

/// Intersection over union, in one look's labels, of the thing with this name in the scene with the
/// one label of ours, among those wanted, that gives most; 0 where the look does not show it.
double best_iou(SceneLook const& look, std::string const& name, WantedLabel const& wanted);

/// Pixels of the thing with this name that are stuff here, and all of its pixels.
struct StuffShare {
  std::size_t stuff_pixels = 0;
  std::size_t pixels = 0;
};
StuffShare share_that_is_stuff(SceneLook const& look, std::string const& name);

/// The life of one piece of stuff.
struct StuffTrack {
  std::uint32_t id = 0;
  /// What most of its pixels truly are, in the first look.
  std::string what;
  std::size_t most_pixels = 0;
  /// Position of the look that showed it first.
  std::size_t first = 0;
  /// After each look; none where it is not believed.
  std::vector<std::optional<double>> probability;
  /// Whether each look showed it.
  std::vector<bool> seen;

  [[nodiscard]] bool believed_last() const { return probability.back().has_value(); }
};

/// By id.
std::vector<StuffTrack> stuff_tracks(SceneRun const& run);

/// What most pixels of a wall of a look truly are; the wall is given by its label.
std::string true_name_of_label(SceneLook const& look, LabelCode label);

}  // namespace credo
