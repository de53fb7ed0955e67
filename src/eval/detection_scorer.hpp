#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/detection.hpp"
#include "core/se3.hpp"
#include "eval/true_model.hpp"

namespace credo {

/// How near to the truth a pose must be to be right: of the model's origin, and the whole angle
/// of the turn between them, both least over the model's symmetry.
struct PoseTier {
  double translation_m;
  double rotation_deg;
};

/// Those that the reference code of Glover and Popovic prints (there as half angles), widest first.
inline constexpr std::array<PoseTier, 3> kPoseTiers = {
    {{0.05, 45.0}, {0.025, 22.5}, {0.015, 15.0}}};

/// A true object is to be found from this share on that is seen of what would be seen of it alone.
inline constexpr double kLeastVisible = 0.1;

/// Shares of true objects seen: from `low` (excluded) to `high`.
struct VisibilityBand {
  double low;
  double high;
};
inline constexpr std::array<VisibilityBand, 3> kVisibilityBands = {
    {{0.7, 1.0}, {0.4, 0.7}, {0.15, 0.4}}};

/// An object that is truly there, in the camera frame.
struct TrueInstance {
  std::string model;
  Se3 pose_camera;
  double visible_fraction = 1.0;
};

/// A share or F1 and its 95 % interval from resampled scenes; NaN where nothing was counted.
struct ScoredShare {
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;
};

struct TierScores {
  std::size_t right = 0;
  /// Without those that are right about an object that is seen too little to count.
  std::size_t detections = 0;
  std::size_t truths = 0;
  ScoredShare precision;
  ScoredShare recall;
  ScoredShare f1;
  /// Recall and number of true objects by kVisibilityBands.
  std::array<ScoredShare, kVisibilityBands.size()> band_recall;
  std::array<std::size_t, kVisibilityBands.size()> band_truths{};
};

/// Normalised squared errors of detections that are right to the widest tier, by their degrees of
/// freedom. Honest covariances have a mean within the bounds in 95 of 100 such experiments.
struct NeesScores {
  std::size_t count = 0;
  double mean = 0.0;
  double median = 0.0;
  double low_bound = 0.0;
  double high_bound = 0.0;
  /// Share of detections within the 95 % quantile of the chi-square distribution.
  double coverage = 0.0;
};

/// Detectors are compared at this precision, too: what one finds depends on what it dares to tell.
inline constexpr double kComparedAtPrecision = 0.95;

/// Without detections whose score is under `from_score`.
struct ScoresFrom {
  double from_score = 0.0;
  TierScores scores;
};

struct DetectionScores {
  std::array<TierScores, kPoseTiers.size()> tiers;
  /// From the lowest score on from which on the precision is at least kComparedAtPrecision; none
  /// where no score has it. Intervals are those with this score, drawn scenes or not. A detector
  /// whose precision is higher with all it tells might have found more, had it told more.
  std::array<std::optional<ScoresFrom>, kPoseTiers.size()> at_precision;
  /// Share of the true objects of which some detection's ADD (ADD-S for a model with symmetry) is
  /// under a tenth of the diameter; the same with ADD-S for all.
  double add_recall = 0.0;
  double add_s_recall = 0.0;
  NeesScores nees_6;
  /// Of models with a symmetry axis.
  NeesScores nees_5;
};

/// Scores detections against the truth, scene after scene.
class DetectionScorer {
public:
  /// The models must outlive the scorer.
  explicit DetectionScorer(TrueModels const& models) : models_(models) {}

  /// One scene. Detections are matched to true objects of their model one to one, each tier by
  /// itself, highest score first (ties as they come), to the nearest that it is right about. Throws
  /// std::logic_error for a model that is not known.
  void add(std::vector<Detection> const& detections, std::vector<TrueInstance> const& truths);
  [[nodiscard]] DetectionScores scores() const;

  /// Which true object a detection of the last scene is right about, by tier.
  using Matches = std::vector<std::array<std::optional<std::size_t>, kPoseTiers.size()>>;
  [[nodiscard]] Matches const& last_matches() const { return matches_; }

private:
  /// How much is seen, by tier, of what a detection is right about.
  struct Judged {
    double score = 0.0;
    std::array<std::optional<double>, kPoseTiers.size()> visible_fraction;
  };
  struct Scene {
    std::vector<Judged> detections;
    std::vector<double> truths_visible_fraction;
  };
  struct Counts {
    std::size_t right = 0;
    std::size_t detections = 0;
    std::size_t truths = 0;
    std::array<std::size_t, kVisibilityBands.size()> band_right{};
    std::array<std::size_t, kVisibilityBands.size()> band_truths{};
  };

  [[nodiscard]] TrueModel const& model(std::string const& name) const;
  void match(std::vector<Detection> const& detections, std::vector<TrueInstance> const& truths);
  void add_distances(std::vector<Detection> const& detections,
                     std::vector<TrueInstance> const& truths);
  [[nodiscard]] static Counts counts_of(Scene const& scene, std::size_t tier, double from_score);
  [[nodiscard]] TierScores tier_scores(std::size_t tier, double from_score) const;
  [[nodiscard]] std::optional<ScoresFrom> scores_at_precision(std::size_t tier) const;

  TrueModels const& models_;
  std::vector<Scene> scenes_;
  Matches matches_;
  std::size_t add_right_ = 0;
  std::size_t add_s_right_ = 0;
  std::vector<double> nees_6_;
  std::vector<double> nees_5_;
};

}  // namespace credo
