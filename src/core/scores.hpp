#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/frame.hpp"
#include "core/label.hpp"

namespace credo {

// How a run's beliefs stand to the truth. Fractions, not percent. None where the truth, or the run,
// has nothing to say.

/// Segments against true instances, means over frames (weighted overlap and over- and
/// under-segmentation as in the OSD benchmark; docs/eval.md has the formulas).
struct OverlapScores {
  double weighted_overlap = 0.0;
  double over_segmentation = 0.0;
  /// Foreign pixels of each instance's segment, per pixel of instances: may be above 1.
  double under_segmentation = 0.0;
  /// Of the instances, how many have a segment with an IoU above a half.
  double recall_50 = 0.0;
};

struct SegmentationScores {
  std::optional<OverlapScores> instances;
  /// Where the truth labels parts of things: the same with the parts of each thing as one.
  std::optional<OverlapScores> merged;
  /// Of the pixels of each class over all frames: "floor", "wall", "object", "stuff".
  std::map<std::string, double> iou;
};

/// Means over the frames that have a floor.
struct FloorScores {
  double tilt_deg = 0.0;
  double height_m = 0.0;
};

struct WallScores {
  std::optional<double> precision;
  std::optional<double> recall;
  /// Mean distance of a believed wall's ends from those of what was seen of the true one.
  std::optional<double> endpoint_m;
};

/// What a frame's belief says of a known object's pose, held against the true one.
struct PoseClaim {
  FrameIndex frame{0};
  std::string object_id;
  /// Mahalanobis distance of the true pose under the claimed distribution, squared.
  double squared_error = 0.0;
  /// Its mean if the claim is honest: 6, or 5 with an axis of symmetry.
  int degrees_of_freedom = 6;
};

/// Of the known objects. Errors are means over believed objects at their places, least over the
/// model's symmetry.
struct ObjectScores {
  std::optional<double> translation_m;
  std::optional<double> rotation_deg;
  /// Of those that were to be believed, how many are within a tenth of their diameter (ADD-S).
  std::optional<double> adds_recall;
  /// Squared Mahalanobis distance of the true pose under the claimed distribution, mean.
  std::optional<double> nees;
  /// What `nees` is if the claims are right: the mean of the degrees of freedom.
  std::optional<double> nees_expected;
  /// Between which `nees` lies 95 times in 100 if the claims are right and independent. Those of
  /// one object in frames that follow each other are not.
  std::optional<double> nees_low;
  std::optional<double> nees_high;
  /// The same if the claims about one object repeat each other as those of an optimal filter do
  /// (nees_bounds.hpp), and how many independent claims all of them are worth.
  std::optional<double> nees_repeated_low;
  std::optional<double> nees_repeated_high;
  std::optional<double> nees_claims;
  std::optional<double> precision;
  std::optional<double> recall;
  /// All that `nees` is the mean of, by frame.
  std::vector<PoseClaim> claims;

  [[nodiscard]] std::optional<bool> nees_inside() const {
    return nees && nees_low && nees_high ? std::optional(*nees_low <= *nees && *nees <= *nees_high)
                                         : std::nullopt;
  }
};

/// Of the claims that fall into a tenth of [0, 1].
struct ReliabilityBin {
  std::uint64_t count = 0;
  double mean_probability = 0.0;
  double observed = 0.0;
};

struct ExistenceScores {
  /// Expected calibration error over ten bins of equal width (Naeini et al. 2015).
  double ece = 0.0;
  double brier = 0.0;
  std::array<ReliabilityBin, 10> reliability;
};

struct ChangeScores {
  std::optional<double> precision;
  std::optional<double> recall;
  /// Median over the changes that were noticed.
  std::optional<double> delay_frames;
  /// How many changes could be noticed.
  std::uint64_t events = 0;
};

/// A body that is followed by another piece than before.
struct IdSwitch {
  FrameIndex frame{0};
  /// Of the truth's label images.
  LabelCode body = 0;
  std::uint32_t from_id = 0;
  std::uint32_t to_id = 0;
};

struct StuffScores {
  std::uint64_t fragmentations = 0;
  /// Things times frames in which they were followed: what the counts are of.
  std::uint64_t item_frames = 0;
  std::vector<IdSwitch> switches;
};

/// A piece of stuff in the frame in which it comes up.
struct Birth {
  FrameIndex frame{0};
  std::uint32_t stuff_id = 0;
  /// In blocks of the image, 160 to a row (geometry/thickness.hpp).
  double thickness_blocks = 0.0;
  bool is_there = false;
};

/// A known object in a frame that shows it.
struct Chance {
  FrameIndex frame{0};
  std::string object_id;
  /// Of its surface that faces the camera, as the belief sees it.
  double visible_share = 0.0;
  /// That truly show it.
  std::uint64_t shown_px = 0;
  bool is_found = false;
};

/// Of the camera's poses.
struct CameraScores {
  /// Mean errors.
  double translation_m = 0.0;
  double rotation_deg = 0.0;
  /// Of the way in itself: what is left of its positions' errors, root mean square, when the whole
  /// way is laid on the true one by one rigid motion (absolute trajectory error, Sturm et al.
  /// 2012).
  double ate_m = 0.0;
};

struct Scores {
  std::uint64_t frames = 0;
  /// As believed, and, where the truth's folder has them, as the source tells them.
  std::optional<CameraScores> camera;
  std::optional<CameraScores> camera_told;
  SegmentationScores segmentation;
  std::optional<FloorScores> floor;
  WallScores walls;
  ObjectScores objects;
  std::optional<ExistenceScores> existence;
  ChangeScores change;
  std::optional<StuffScores> stuff;
  std::vector<Birth> births;
  std::vector<Chance> chances;
};

}  // namespace credo
