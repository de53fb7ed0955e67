#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "core/belief_summary.hpp"
#include "core/frame.hpp"
#include "core/label.hpp"
#include "core/solid.hpp"
#include "core/truth.hpp"
#include "eval/evaluation.hpp"

namespace credo::test {

// A room of two known objects, two things that nobody told of, floor and wall, and a run that
// believes exactly what is true, each with probability 0.9. Labels fill rectangles of 10 x 10
// pixels: upper row wall, middle row box, bottle, two things, lower row floor.

inline constexpr LabelCode kBoxLabel = 3000;
inline constexpr LabelCode kBottleLabel = 3001;
inline constexpr LabelCode kMugLabel = 4000;
inline constexpr LabelCode kBagLabel = 4001;
inline constexpr CameraIntrinsics kRoomCamera{20.0, 20.0, 19.5, 14.5};

struct RunFrame {
  FrameTruth truth;
  LabelMap true_labels;
  BeliefSummary belief;
  LabelMap labels;
};

inline void fill(LabelMap& image, Eigen::AlignedBox2i const& pixels, LabelCode label) {
  for (int v = pixels.min().y(); v <= pixels.max().y(); ++v) {
    for (int u = pixels.min().x(); u <= pixels.max().x(); ++u) {
      image[{u, v}] = label;
    }
  }
}

inline Eigen::AlignedBox2i square(int column, int row) {
  return {Eigen::Vector2i(10 * column, 10 * row), Eigen::Vector2i(10 * column + 9, 10 * row + 9)};
}

inline LabelMap room_labels() {
  LabelMap image(40, 30, kFloor);
  for (int column = 0; column < 4; ++column) {
    fill(image, square(column, 0), kFirstWall);
  }
  fill(image, square(0, 1), kBoxLabel);
  fill(image, square(1, 1), kBottleLabel);
  fill(image, square(2, 1), kMugLabel);
  fill(image, square(3, 1), kBagLabel);
  return image;
}

/// A camera 1 m up that looks along x.
inline Se3 room_pose() {
  Eigen::Matrix3d axes;
  axes.col(0) = -Eigen::Vector3d::UnitY();
  axes.col(1) = -Eigen::Vector3d::UnitZ();
  axes.col(2) = Eigen::Vector3d::UnitX();
  return {Eigen::Quaterniond(axes), {0, 0, 1}};
}

inline FrameTruth room_truth(std::int64_t frame) {
  FrameTruth truth;
  truth.frame = FrameIndex{frame};
  truth.stamp_ns = 33'000'000 * frame;
  truth.T_world_camera = room_pose();
  truth.floor = TrueFloor{};
  TrueWall wall;
  wall.id = "wall";
  wall.segment_start_m = {4, -5};
  wall.segment_end_m = {4, 5};
  wall.normal = -Eigen::Vector3d::UnitX();
  wall.visible_fraction = 1.0;
  truth.walls = {wall};
  auto const thing = [](char const* id, char const* type, double y, LabelCode label) {
    return TrueThing{id, type, Se3(Eigen::Quaterniond::Identity(), {2, y, 0.8}), true, 1.0, label};
  };
  truth.objects = {thing("the box", "box", 1.2, kBoxLabel),
                   thing("the bottle", "bottle", 0.4, kBottleLabel)};
  truth.stuff = {thing("mug", "", -0.4, kMugLabel), thing("bag", "", -1.2, kBagLabel)};
  return truth;
}

inline constexpr double kRoomSigma = 0.02;

inline BeliefSummary room_belief(FrameTruth const& truth) {
  BeliefSummary belief;
  belief.frame = truth.frame;
  belief.stamp_ns = truth.stamp_ns;
  belief.T_world_camera = truth.T_world_camera.matrix();
  belief.floor = FloorSummary{};
  WallSummary wall;
  wall.id = 1;
  // What the middles of the outermost pixels see of it: 4 m * 19.5 px / 20 px to either side.
  wall.segment_start_m = {4, -3.9};
  wall.segment_end_m = {4, 3.9};
  wall.normal = -Eigen::Vector3d::UnitX();
  wall.label = kFirstWall;
  belief.walls = {wall};
  for (TrueThing const& thing : truth.objects) {
    ObjectSummary object;
    object.id = thing.type + "_1";
    object.type = thing.type;
    object.probability = 0.9;
    object.position_m = thing.pose.translation();
    object.orientation = thing.pose.rotation();
    object.covariance = kRoomSigma * kRoomSigma * Matrix6d::Identity();
    object.label = thing.label;
    belief.objects.push_back(object);
  }
  std::uint32_t id = 7;
  for (TrueThing const& thing : truth.stuff) {
    StuffSummary piece;
    piece.id = id++;
    piece.probability = 0.9;
    piece.centroid_m = thing.pose.translation().cast<float>();
    piece.label = thing.label;
    belief.stuff.push_back(piece);
  }
  return belief;
}

inline std::vector<RunFrame> perfect_run(int frames) {
  std::vector<RunFrame> run;
  for (int i = 0; i < frames; ++i) {
    FrameTruth const truth = room_truth(i);
    run.push_back({truth, room_labels(), room_belief(truth), room_labels()});
  }
  return run;
}

/// A box that looks different from each side, and a bottle.
inline TrueModels room_models() {
  TrueModels models;
  ObjectModel box{"box", std::vector<Solid>{box_on_base({0.2, 0.3, 0.4})}, {}};
  ObjectModel bottle{"bottle", std::vector<Solid>{CylinderSolid{0.04, 0.25}}, {}};
  bottle.symmetry.axis = SymmetryAxis{};
  models.emplace("box", TrueModel(box));
  models.emplace("bottle", TrueModel(bottle));
  return models;
}

inline Evaluation evaluated(std::vector<RunFrame> const& run) {
  Evaluation evaluation(room_models(), kRoomCamera);
  for (RunFrame const& frame : run) {
    evaluation.add({frame.truth, &frame.belief, &frame.labels, &frame.true_labels});
  }
  return evaluation;
}

inline Scores scores_of(std::vector<RunFrame> const& run) {
  return evaluated(run).scores();
}

}  // namespace credo::test
