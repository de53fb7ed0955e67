#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/belief_summary.hpp"
#include "core/frame.hpp"
#include "core/scores.hpp"
#include "core/truth.hpp"
#include "eval/label_overlap.hpp"
#include "eval/stuff_bodies.hpp"
#include "eval/told_objects.hpp"
#include "eval/true_model.hpp"

namespace credo {

/// A frame with a belief, and what the other scorers made of it.
struct ChangeFrame {
  BeliefSummary const& belief;
  FrameTruth const& truth;
  ToldObjects const& told;
  std::vector<std::optional<std::size_t>> const& match;
  TrueModels const& models;
  /// Already taken in this frame.
  StuffBodies const& bodies;
  LabelOverlap const& overlap;
  CameraIntrinsics const& intrinsics;
  int width_px = 0;
  int height_px = 0;
};

/// Whether things that appear, move and go are noticed, and whether what the belief drops has gone.
///
/// A change is noticed in the first frame in which the belief has it right: the thing is believed
/// where it is now, and nothing that was believed of its old place still is. It counts only if it
/// could be noticed: the new place was shown (kShownShare of an image); of what is gone, the old
/// one was believed and in view again. The thing's next change closes the account of the one
/// before.
///
/// The belief claims a change where something was believed and is not any more, and where a known
/// object is believed again. A new piece of stuff is no claim: it may only have come into view.
/// Dropping a piece of floor, wall or known object is none either: that is only better known. Nor
/// is the end of a name whose piece became one with another that is believed: something is believed
/// to stand there as before.
class ChangeScorer {
public:
  /// What happened in a frame, before its belief, if it has one. Frames in order.
  void happen(FrameTruth const& truth, ToldObjects const& told);
  void add(ChangeFrame const& frame);
  [[nodiscard]] ChangeScores scores() const;

  /// Of an image: smaller than that no cluster is made of it.
  static constexpr double kShownShare = 1.0 / 2000.0;

private:
  struct Change {
    std::string what;
    LabelCode label = 0;
    std::string id;
    bool told = false;
    FrameIndex since{0};
    /// Before it.
    std::optional<Se3> old_pose;
    /// Pieces of stuff that were believed to be it.
    std::map<std::uint32_t, Eigen::Vector3d> old_pieces;
    bool was_believed = false;
    bool shown = false;
    bool old_place_in_view = false;
  };
  [[nodiscard]] bool is_noticed(Change const& change, ChangeFrame const& frame) const;
  static void look(Change& change, ChangeFrame const& frame);
  void close(Change const& change, std::optional<std::int64_t> delay_frames);
  void judge_pieces(ChangeFrame const& frame);
  void judge_objects(ChangeFrame const& frame);
  void remember(ChangeFrame const& frame);

  std::map<LabelCode, Change> open_;
  // Of the last belief.
  std::map<std::uint32_t, StuffBodies::Body> believed_pieces_;
  std::map<std::string, ObjectSummary> known_;
  std::map<std::string, bool> believed_by_true_id_;
  // Of the last frame.
  std::map<std::string, Se3> true_poses_;

  std::vector<std::int64_t> delays_;
  std::uint64_t missed_ = 0;
  std::uint64_t claims_ = 0;
  std::uint64_t right_claims_ = 0;
};

}  // namespace credo
