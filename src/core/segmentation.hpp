#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/detection.hpp"
#include "core/frame.hpp"
#include "core/grid.hpp"
#include "core/label.hpp"
#include "core/object_model.hpp"
#include "core/plane.hpp"
#include "core/segments.hpp"
#include "core/sight.hpp"

namespace credo {

/// Points in the world frame, metres.
using PointList = std::vector<Eigen::Vector3f>;

/// The floor as one frame shows it.
struct FloorObservation {
  /// World frame, normal up.
  Plane plane_world;
  /// Thinned to the spacing of the planes' config.
  PointList points_world;
  /// Pixels that carry the label kFloor because they are the plane's inliers.
  std::size_t pixel_count = 0;
};

/// One wall as one frame shows it.
struct WallObservation {
  LabelCode label = kFirstWall;
  /// World frame; the normal faces the camera.
  Plane plane_world;
  PointList points_world;
  std::size_t pixel_count = 0;
};

/// A known object that the detector found and the gate let pass.
struct ObjectObservation {
  /// kFirstObject + object.
  LabelCode label = kFirstObject;
  /// Position of the object in BeliefState::objects of the belief that was used.
  std::size_t object = 0;
  std::string object_id;
  /// Of its type: the model that it looks like.
  std::string type;
  /// As detected.
  PoseDistribution pose_world;
  /// Of the detection.
  bool errors_repeat = true;
  /// Of its model: which other poses would look the same.
  Symmetry symmetry;
  /// Pixels that its region holds, 0 where the detected pose touches none.
  std::size_t pixel_count = 0;
};

/// A detection that says nothing about any object of the belief.
struct RefusedDetection {
  std::string type;
  /// The object of that type to which it is nearest; empty where there is none.
  std::string object_id;
  PoseDistribution pose_world;
  /// Squared Mahalanobis distance to that object's pose distribution, and the most that the gate
  /// lets pass. Within the gate it was refused because another detection fits better.
  double squared_distance = 0.0;
  double max_squared_distance = 0.0;
  /// As Detection has it.
  bool errors_repeat = true;
};

/// A cluster of points that is neither floor, wall nor known object (thesis 3.3).
struct StuffCluster {
  LabelCode label = kFirstStuff;
  std::size_t pixel_count = 0;
  /// Of all its pixels, not only of the thinned points.
  Eigen::Vector3f centroid_world = Eigen::Vector3f::Zero();
  Eigen::AlignedBox3f bounds_world;
  /// Thinned to the spacing of the clustering's config, never empty.
  PointList points_world;
  /// The cluster that it lies on so closely that depth alone could take it for a part of that, such
  /// as a magazine on a table; none for most.
  std::optional<LabelCode> lies_on;
};

/// What one frame shows: a label for every pixel, and what each label stands for. The stages pass
/// it on by moving: each adds its labels and its entries.
struct Segmentation {
  FrameIndex frame{0};
  std::int64_t stamp_ns = 0;
  /// Frame of the belief that the detector was asked with; kPriorFrame for the prior.
  FrameIndex segmented_with = kPriorFrame;
  Se3 T_world_camera;
  /// The correction that is in it already (BeliefState::T_world_told), of the belief that the frame
  /// was segmented with.
  Se3 T_world_told;
  /// False where no floor was found to level by: z = 0 then means nothing, and nothing is floor.
  bool floor_at_zero = true;
  LabelMap labels;
  /// The frame in pieces that are one thing each, told from depth alone. Empty where the config
  /// leaves them out: then clusters are grown from points and normals. And once all is clustered.
  Segments segments;
  std::optional<FloorObservation> floor;
  std::vector<WallObservation> walls;
  /// In the belief's order.
  std::vector<ObjectObservation> objects;
  std::vector<RefusedDetection> refused;
  /// Whether a detector looked: if not, that an object was not found says nothing.
  bool objects_looked_for = false;
  std::vector<StuffCluster> stuff;
  /// The same in blocks, for the belief; empty where its rule does not ask.
  Sight sight;
};
using SegmentationPtr = std::shared_ptr<Segmentation const>;

/// The segmentation before any stage: kNoDepth where the cloud is invalid, else kUnassigned.
Segmentation unassigned_segmentation(Frame const& frame, Se3 const& T_world_camera,
                                     FrameIndex segmented_with);

}  // namespace credo
