#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/belief_summary.hpp"
#include "core/frame.hpp"
#include "core/label.hpp"
#include "core/scores.hpp"
#include "core/truth.hpp"
#include "eval/birth_scorer.hpp"
#include "eval/camera_scorer.hpp"
#include "eval/chance_scorer.hpp"
#include "eval/change_scorer.hpp"
#include "eval/existence_scorer.hpp"
#include "eval/identity_scorer.hpp"
#include "eval/label_overlap.hpp"
#include "eval/mean.hpp"
#include "eval/object_scorer.hpp"
#include "eval/segmentation_scorer.hpp"
#include "eval/stuff_bodies.hpp"
#include "eval/told_objects.hpp"
#include "eval/true_model.hpp"
#include "eval/wall_scorer.hpp"

namespace credo {

/// A frame of a run beside what is true. The images of one frame have one size.
struct EvalFrame {
  FrameTruth const& truth;
  /// Null where the run lost the frame.
  BeliefSummary const* belief = nullptr;
  /// Null where the run kept no label images.
  LabelMap const* labels = nullptr;
  LabelMap const* true_labels = nullptr;
  /// What the camera's pose was told to be; none where nobody kept it.
  std::optional<Se3> T_world_told = std::nullopt;
};

/// What the plots show of a frame.
struct FrameScores {
  FrameIndex frame{0};
  std::optional<double> weighted_overlap;
  std::optional<double> floor_tilt_deg;
  std::optional<double> translation_m;
  std::optional<double> rotation_deg;
  struct Existence {
    std::string id;
    double probability = 0.0;
    bool is_there = false;
  };
  /// Of the known objects.
  std::vector<Existence> objects;
};

/// Scores a run against the truth, one frame after the other. docs/eval.md tells what each score
/// is.
class Evaluation {
public:
  Evaluation(TrueModels models, std::optional<CameraIntrinsics> intrinsics)
      : models_(std::move(models)), intrinsics_(intrinsics) {}

  /// Every frame of the truth up to the run's last, in order.
  void add(EvalFrame const& frame);
  [[nodiscard]] Scores scores() const;
  /// One for each belief.
  [[nodiscard]] std::vector<FrameScores> const& trace() const { return trace_; }

private:
  void add_segments(EvalFrame const& frame, LabelOverlap const& overlap);
  void add_images(EvalFrame const& frame, std::vector<std::optional<std::size_t>> const& match);
  void forget_what_was_removed(FrameTruth const& truth);
  void add_existence(EvalFrame const& frame, std::vector<std::optional<std::size_t>> const& match);
  void add_camera(EvalFrame const& frame);
  void add_floor(EvalFrame const& frame);
  void add_poses(EvalFrame const& frame, std::vector<std::optional<std::size_t>> const& match);

  TrueModels models_;
  std::optional<CameraIntrinsics> intrinsics_;
  std::optional<ToldObjects> told_;
  StuffBodies bodies_;
  OverlapScorer instances_;
  ClassScorer classes_;
  CameraScorer camera_;
  CameraScorer camera_told_;
  Mean floor_tilt_deg_;
  Mean floor_height_m_;
  WallScorer walls_;
  ObjectScorer objects_;
  ExistenceScorer existence_;
  ChangeScorer change_;
  IdentityScorer identity_;
  BirthScorer births_;
  ChanceScorer chances_;
  bool has_labels_ = false;
  std::vector<FrameScores> trace_;
};

/// Scores of label images against true labels alone: OSD's, where parts of things count from
/// 20 on, those of one thing in one ten, and what is below is the table.
class LabelEvaluation {
public:
  void add(LabelMap const& labels, LabelMap const& true_labels);
  [[nodiscard]] Scores scores() const;

private:
  OverlapScorer parts_;
  OverlapScorer things_;
  std::uint64_t frames_ = 0;
};

}  // namespace credo
