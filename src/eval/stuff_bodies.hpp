#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "core/belief_summary.hpp"
#include "core/truth.hpp"
#include "eval/label_overlap.hpp"
#include "eval/told_objects.hpp"

namespace credo {

/// Which body each piece of stuff is: the one that most of its pixels belonged to when it was last
/// seen.
class StuffBodies {
public:
  struct Body {
    /// Its true label; none where its pixels had none.
    std::optional<LabelCode> label;
    /// Where the body stood when the piece was last seen; none for floor and walls.
    std::optional<Se3> pose;
    FrameIndex last_seen{0};
    /// Of the piece, then.
    Eigen::Vector3d centroid_m = Eigen::Vector3d::Zero();
  };

  /// Takes in a frame. Pieces that it shows are looked up anew; pieces that left the belief stay.
  void update(BeliefSummary const& belief, FrameTruth const& truth, LabelOverlap const& overlap);

  /// None for an id that was never seen in a frame with label images.
  [[nodiscard]] Body const* body(std::uint32_t stuff_id) const;

  /// Whether it is right to believe in the piece: its body is something that the robot was not told
  /// of, and is still where it was when the piece was last seen (within kSamePlace_m). What is
  /// truly floor, wall or a known object is no stuff.
  [[nodiscard]] bool is_there(std::uint32_t stuff_id, FrameTruth const& truth,
                              ToldObjects const& told) const;

  static constexpr double kSamePlace_m = 0.1;

private:
  std::map<std::uint32_t, Body> bodies_;
};

/// The object or stuff with that label, or null.
[[nodiscard]] TrueThing const* thing_with(LabelCode label, FrameTruth const& truth);
/// The object or stuff with that id, or null.
[[nodiscard]] TrueThing const* thing_called(std::string const& id, FrameTruth const& truth);

}  // namespace credo
