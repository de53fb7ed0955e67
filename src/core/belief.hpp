#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/evidence.hpp"
#include "core/frame.hpp"
#include "core/label.hpp"
#include "core/plane.hpp"
#include "core/segmentation.hpp"
#include "core/sight.hpp"

namespace credo {

[[nodiscard]] inline double probability_of(double log_odds) {
  return 1.0 / (1.0 + std::exp(-log_odds));
}
[[nodiscard]] inline double log_odds_of(double probability) {
  return std::log(probability / (1.0 - probability));
}

/// When and from where something was seen.
struct Look {
  std::int64_t stamp_ns = 0;
  Eigen::Vector3d camera_world = Eigen::Vector3d::Zero();
};

/// What looks say of a thing: that it is there, that it has gone, or, where one sees through nearly
/// all of it, that it has surely gone.
enum class Verdict : std::uint8_t { kSeen, kGone, kSurelyGone };

/// What is believed of a large surface, a floor or a wall, by its points. World frame.
struct SurfaceBelief {
  double log_odds = 0.0;
  Evidence evidence = Evidence::kNotSeen;
  Account why;
  /// What the last look that told of it said, and when and from where that was.
  Verdict verdict = Verdict::kSeen;
  Look last_look;
  /// The most of the points looked at that ever agreed with one frame.
  double most_agreeing = 0.0;
  /// Union of all observations, one point per cell of a grid; shared between successive beliefs.
  std::shared_ptr<PointList const> points = std::make_shared<PointList>();
};

/// Everything accumulated about the floor (thesis 4.2). World frame.
struct FloorBelief : SurfaceBelief {
  /// Unit, up.
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  /// z of the plane below the points' centroid.
  double height_m = 0.0;
};

/// Sums over points of a plane, each by how well it is measured. World frame.
struct PlaneSums {
  double weight = 0.0;
  Eigen::Vector3d points = Eigen::Vector3d::Zero();
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
};

/// A wall as a line segment on the floor, swept along z (thesis 4.2). World frame.
struct WallBelief : SurfaceBelief {
  std::uint32_t id = 0;
  Plane plane_world;
  Eigen::Vector2d segment_start_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d segment_end_m = Eigen::Vector2d::Zero();
  /// Pixels of all observations so far: the weight of the normal and offset in the next merge.
  double weight_pixels = 0.0;
  /// Over the points of all observations, where the plane is fitted to them; else empty.
  PlaneSums sums;
  /// Its code in the last frame's label image; none where that frame did not show it.
  std::optional<LabelCode> label;
};

/// Another place where a known object is found, while it is not where it is believed to be.
struct OtherPlace {
  PoseDistribution pose_world;
  /// That it is there.
  double log_odds = 0.0;
  Look last_seen;
};

/// A known object: pose distribution and the probability that it is there (thesis 4.1).
struct ObjectBelief {
  std::string id;
  std::string type;
  double log_odds = 0.0;
  PoseDistribution pose_world;
  /// Of the pose before the first frame: how far from where it was told it may be at all. None:
  /// what was learnt of the pose is never forgotten.
  std::optional<Matrix6d> prior_covariance;
  Evidence evidence = Evidence::kNotSeen;
  Account why;
  std::optional<LabelCode> label;
  /// When and from where it was seen last; none while it is where it was told.
  std::optional<Look> last_seen;
  /// What the last look that told of it said, and when and from where that was; none while there
  /// was none.
  Verdict verdict = Verdict::kSeen;
  std::optional<Look> last_look;
  std::optional<OtherPlace> other_place;
};

/// A point of what is believed of a thing's surface. World frame.
struct SurfacePoint {
  Eigen::Vector3f p_world = Eigen::Vector3f::Zero();
  /// Looks that it is the mean of, as far as they count.
  float weight = 1.0F;
  /// Looks through it, less those that agreed with it.
  float missed = 0.0F;
  /// Looks that showed it in another cluster than most of its thing, less those that did not.
  float apart = 0.0F;
};

/// What is believed of a thing's surface: at most one point to a cell of a grid.
struct StuffModel {
  float spacing_m = 0.0F;
  /// Ascending; of the point that came first.
  std::vector<std::uint64_t> cells;
  std::vector<SurfacePoint> points;
};

/// How much says that a thing is one with another.
struct OneWith {
  std::uint32_t id = 0;
  double evidence = 0.0;
};

/// A thing that became one with another, as it was then: should it come apart again, it has a name.
struct JoinedThing {
  std::uint32_t id = 0;
  std::size_t history_count = 0;
  /// Of its surface, about one to a cell of a grid; never empty. Shared between successive beliefs.
  std::shared_ptr<PointList const> points_world;
  float spacing_m = 0.0F;
};

/// Something seen but not known: its clusters over time and the probability that it is there (4.3).
struct StuffBelief {
  std::uint32_t id = 0;
  double log_odds = 0.0;
  /// Number of clusters ever appended; only the last few are kept.
  std::size_t history_count = 0;
  /// Oldest first; never empty. Shared between successive beliefs.
  std::vector<std::shared_ptr<StuffCluster const>> recent_clusters;
  Evidence evidence = Evidence::kSeen;
  Account why;
  std::optional<LabelCode> label;

  // The rest is of the rule that knows what it could not see; with the thesis' rule it stays empty.
  std::shared_ptr<StuffModel const> model;
  /// The most points of the model that ever agreed with one frame.
  double most_agreeing = 0.0;
  Verdict verdict = Verdict::kSeen;
  /// When and from where it was last seen, or seen through.
  Look last_look;
  std::vector<OneWith> one_with;
  /// The part of its last looks at which it had moved.
  double moved_share = 0.0;
  /// Things that became one with it in this frame: they have no belief of their own any more.
  std::vector<std::uint32_t> joined_ids;
  /// Things that became one with it, in this frame or before, as long as they stand there.
  std::vector<JoinedThing> names_kept;

  [[nodiscard]] StuffCluster const& latest() const { return *recent_clusters.back(); }
};

/// What the robot believes is around it after a frame. Immutable once built; point sets are shared
/// with the belief before, so that a copy costs little.
struct BeliefState {
  /// The last frame fused; kPriorFrame before the first.
  FrameIndex frame = kPriorFrame;
  std::int64_t stamp_ns = 0;
  FrameIndex segmented_with = kPriorFrame;
  /// Of the camera in the last frame, corrected.
  Se3 T_world_camera;
  /// What the frames' poses are corrected by: from the world that they tell to the one that is
  /// believed. The identity where nothing is corrected.
  Se3 T_world_told;
  /// What the last frame showed; null before the first, and with the thesis' rule.
  std::shared_ptr<PlacedSight const> last_sight;
  std::optional<FloorBelief> floor;
  std::vector<WallBelief> walls;
  std::vector<ObjectBelief> objects;
  std::vector<StuffBelief> stuff;
  // Ids are never given to two things in a run; what became one with another and comes apart again
  // gets its own back.
  std::uint32_t next_wall_id = 1;
  std::uint32_t next_stuff_id = 1;
};
using BeliefPtr = std::shared_ptr<BeliefState const>;

}  // namespace credo
