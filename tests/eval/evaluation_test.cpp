// A run that believes what is true has perfect scores; each known fault moves the scores that it
// should, by what arithmetic says, and no other.
#include "eval/evaluation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "eval/perfect_run.hpp"
#include "io/scores_json.hpp"

namespace credo::test {
namespace {

constexpr int kFrames = 5;

std::vector<RunFrame> spoilt(std::function<void(RunFrame&)> const& spoil) {
  std::vector<RunFrame> run = perfect_run(kFrames);
  for (RunFrame& frame : run) {
    spoil(frame);
  }
  return run;
}

/// The scores' groups that are not as in the perfect run.
std::string changed_groups(Scores const& scores) {
  Scores const perfect = scores_of(perfect_run(kFrames));
  std::string changed;
  auto const compare = [&](std::string const& name, auto const& copy) {
    Scores only = perfect;
    copy(only);
    changed += scores_json(only) != scores_json(perfect) ? name + " " : "";
  };
  compare("camera", [&](Scores& s) { s.camera = scores.camera; });
  compare("segmentation", [&](Scores& s) { s.segmentation = scores.segmentation; });
  compare("floor", [&](Scores& s) { s.floor = scores.floor; });
  compare("walls", [&](Scores& s) { s.walls = scores.walls; });
  compare("objects", [&](Scores& s) { s.objects = scores.objects; });
  compare("existence", [&](Scores& s) { s.existence = scores.existence; });
  compare("change", [&](Scores& s) { s.change = scores.change; });
  compare("stuff", [&](Scores& s) { s.stuff = scores.stuff; });
  return changed;
}

TEST(Evaluation, ARunThatBelievesWhatIsTrueIsPerfect) {
  Scores const scores = scores_of(perfect_run(kFrames));
  EXPECT_EQ(scores.frames, 5U);
  ASSERT_TRUE(scores.segmentation.instances);
  EXPECT_EQ(scores.segmentation.instances->weighted_overlap, 1.0);
  EXPECT_EQ(scores.segmentation.instances->over_segmentation, 0.0);
  EXPECT_EQ(scores.segmentation.instances->under_segmentation, 0.0);
  EXPECT_EQ(scores.segmentation.instances->recall_50, 1.0);
  EXPECT_EQ(scores.segmentation.iou,
            (std::map<std::string, double>{
                {"floor", 1.0}, {"wall", 1.0}, {"object", 1.0}, {"stuff", 1.0}}));
  ASSERT_TRUE(scores.floor);
  EXPECT_EQ(scores.floor->tilt_deg, 0.0);
  EXPECT_EQ(scores.floor->height_m, 0.0);
  EXPECT_EQ(scores.walls.precision, 1.0);
  EXPECT_EQ(scores.walls.recall, 1.0);
  EXPECT_NEAR(*scores.walls.endpoint_m, 0.0, 1e-12);
  EXPECT_EQ(scores.objects.translation_m, 0.0);
  EXPECT_EQ(scores.objects.rotation_deg, 0.0);
  EXPECT_EQ(scores.objects.adds_recall, 1.0);
  EXPECT_NEAR(*scores.objects.nees, 0.0, 1e-12);
  EXPECT_EQ(scores.objects.nees_expected, 5.5) << "six of the box, five of the bottle";
  EXPECT_EQ(scores.objects.precision, 1.0);
  EXPECT_EQ(scores.objects.recall, 1.0);
  ASSERT_TRUE(scores.existence);
  EXPECT_NEAR(scores.existence->ece, 0.1, 1e-12) << "0.9 was right ten times in ten";
  EXPECT_NEAR(scores.existence->brier, 0.01, 1e-12);
  EXPECT_EQ(scores.change.events, 0U);
  EXPECT_FALSE(scores.change.precision);
  EXPECT_FALSE(scores.change.recall);
  ASSERT_TRUE(scores.stuff);
  EXPECT_THAT(scores.stuff->switches, testing::IsEmpty());
  EXPECT_EQ(scores.stuff->item_frames, 10U) << "two things in five frames";
}

TEST(Evaluation, ErodedLabelsMoveTheSegmentationOnly) {
  Scores const scores = scores_of(spoilt([](RunFrame& frame) {
    for (int column = 0; column < 4; ++column) {
      LabelCode const label = frame.labels[{10 * column, 10}];
      fill(frame.labels, square(column, 1), kUnassigned);
      Eigen::AlignedBox2i inner = square(column, 1);
      inner.min().array() += 1;
      inner.max().array() -= 1;
      fill(frame.labels, inner, label);
    }
  }));
  EXPECT_EQ(changed_groups(scores), "segmentation ");
  EXPECT_NEAR(scores.segmentation.instances->weighted_overlap, 0.64, 1e-12) << "8 x 8 of 10 x 10";
  EXPECT_NEAR(scores.segmentation.instances->over_segmentation, 0.36, 1e-12);
  EXPECT_EQ(scores.segmentation.instances->under_segmentation, 0.0);
  EXPECT_EQ(scores.segmentation.instances->recall_50, 1.0);
  EXPECT_NEAR(scores.segmentation.iou.at("object"), 0.64, 1e-12);
  EXPECT_NEAR(scores.segmentation.iou.at("stuff"), 0.64, 1e-12);
  EXPECT_EQ(scores.segmentation.iou.at("floor"), 1.0);
}

TEST(Evaluation, PosesACentimetreOffMoveTheObjectsOnly) {
  Scores const scores = scores_of(spoilt([](RunFrame& frame) {
    for (ObjectSummary& object : frame.belief.objects) {
      object.position_m.y() += 0.01;
    }
  }));
  EXPECT_EQ(changed_groups(scores), "objects ");
  EXPECT_NEAR(*scores.objects.translation_m, 0.01, 1e-12);
  EXPECT_NEAR(*scores.objects.rotation_deg, 0.0, 1e-9);
  EXPECT_NEAR(*scores.objects.nees, 0.25, 1e-9) << "half a standard deviation, squared";
  EXPECT_EQ(scores.objects.adds_recall, 1.0);
  EXPECT_EQ(scores.objects.precision, 1.0);
}

/// What is told of poses that are all so many standard deviations off.
ObjectScores objects_off(double sigmas) {
  return scores_of(spoilt([&](RunFrame& frame) {
           for (ObjectSummary& object : frame.belief.objects) {
             object.position_m.y() += sigmas * kRoomSigma;
           }
         }))
      .objects;
}

// Five frames of a box (6) and a bottle (5): 55 degrees of freedom of ten claims. The quantiles are
// those of tables of the chi-square distribution.
TEST(Evaluation, TheMeanOfHonestErrorsIsWithinItsBounds) {
  ObjectScores const honest = objects_off(std::sqrt(5.5));
  EXPECT_NEAR(*honest.nees, 5.5, 1e-9);
  EXPECT_NEAR(*honest.nees_low, 36.398 / 10.0, 1e-4);
  EXPECT_NEAR(*honest.nees_high, 77.380 / 10.0, 1e-4);
  EXPECT_EQ(honest.nees_inside(), true);
  EXPECT_EQ(objects_off(std::sqrt(3.7)).nees_inside(), true);
  EXPECT_EQ(objects_off(std::sqrt(3.6)).nees_inside(), false) << "too modest";
  EXPECT_EQ(objects_off(std::sqrt(7.7)).nees_inside(), true);
  EXPECT_EQ(objects_off(std::sqrt(7.8)).nees_inside(), false) << "too sure";
}

TEST(Evaluation, WithoutAnObjectThereAreNoBounds) {
  ObjectScores const none =
      scores_of(spoilt([](RunFrame& frame) { frame.belief.objects.clear(); })).objects;
  EXPECT_FALSE(none.nees_low);
  EXPECT_FALSE(none.nees_high);
  EXPECT_FALSE(none.nees_inside());
}

TEST(Evaluation, ACameraTwoCentimetresOffMovesTheCameraOnly) {
  Scores const scores =
      scores_of(spoilt([](RunFrame& frame) { frame.belief.T_world_camera(1, 3) += 0.02; }));
  EXPECT_EQ(changed_groups(scores), "camera ");
  EXPECT_NEAR(scores.camera->translation_m, 0.02, 1e-12);
  EXPECT_NEAR(scores.camera->ate_m, 0.0, 1e-12) << "always by the same";
  EXPECT_FALSE(scores.camera_told);
}

TEST(Evaluation, WhatIsToldOfTheCameraIsScoredBesideWhatIsBelieved) {
  Evaluation evaluation(room_models(), kRoomCamera);
  for (RunFrame const& frame : perfect_run(kFrames)) {
    EvalFrame pair{frame.truth, &frame.belief};
    Vector6d error = Vector6d::Zero();
    error[1] = 0.03;
    pair.T_world_told = boxplus(frame.truth.T_world_camera, error);
    evaluation.add(pair);
  }
  EXPECT_NEAR(evaluation.scores().camera_told->translation_m, 0.03, 1e-12);
  EXPECT_NEAR(evaluation.scores().camera->translation_m, 0.0, 1e-12);
}

TEST(Evaluation, TurnsAboutASymmetryAxisAreNoErrors) {
  double const angle = 3.0 * std::numbers::pi / 180.0;
  Scores const scores = scores_of(spoilt([&](RunFrame& frame) {
    for (ObjectSummary& object : frame.belief.objects) {
      object.orientation = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ());
    }
  }));
  EXPECT_EQ(changed_groups(scores), "objects ");
  EXPECT_NEAR(*scores.objects.rotation_deg, 1.5, 1e-9) << "3 of the box, none of the bottle";
  EXPECT_NEAR(*scores.objects.nees, 0.5 * std::pow(angle / kRoomSigma, 2), 1e-6);
  EXPECT_NEAR(*scores.objects.translation_m, 0.0, 1e-12);
}

TEST(Evaluation, AnObjectFarFromItsPlaceIsWrongThere) {
  Scores const scores = scores_of(spoilt([](RunFrame& frame) {
    frame.belief.objects[0].position_m.x() += 0.5;  // the box' diameter is 0.54 m
  }));
  EXPECT_EQ(changed_groups(scores), "objects existence ");
  EXPECT_EQ(scores.objects.precision, 0.5);
  EXPECT_EQ(scores.objects.recall, 0.5);
  EXPECT_EQ(scores.objects.adds_recall, 0.5);
  EXPECT_NEAR(*scores.objects.translation_m, 0.0, 1e-12) << "of those that are at their place";
  EXPECT_NEAR(scores.existence->ece, 0.9 - 0.75, 1e-12) << "three of four are there";
}

TEST(Evaluation, InvertedProbabilitiesMoveWhatProbabilitiesDecide) {
  Scores const scores = scores_of(spoilt([](RunFrame& frame) {
    for (ObjectSummary& object : frame.belief.objects) {
      object.probability = 1.0 - object.probability;
    }
    for (StuffSummary& piece : frame.belief.stuff) {
      piece.probability = 1.0 - piece.probability;
    }
  }));
  EXPECT_EQ(changed_groups(scores), "objects existence ");
  EXPECT_NEAR(scores.existence->ece, 0.9, 1e-12);
  EXPECT_NEAR(scores.existence->brier, 0.81, 1e-12);
  EXPECT_FALSE(scores.objects.precision) << "nothing is believed";
  EXPECT_EQ(scores.objects.recall, 0.0);
  EXPECT_FALSE(scores.objects.translation_m);
}

TEST(Evaluation, AFloorTooHighAndTiltedMovesTheFloorOnly) {
  Scores const scores = scores_of(spoilt([](RunFrame& frame) {
    frame.belief.floor->height_m = -0.02;
    frame.belief.floor->normal =
        Eigen::AngleAxisd(0.5 * std::numbers::pi / 180.0, Eigen::Vector3d::UnitX()) *
        Eigen::Vector3d::UnitZ();
  }));
  EXPECT_EQ(changed_groups(scores), "floor ");
  EXPECT_NEAR(scores.floor->height_m, 0.02, 1e-12);
  EXPECT_NEAR(scores.floor->tilt_deg, 0.5, 1e-9);
}

TEST(Evaluation, WhatNobodyToldOfIsStuff) {
  std::vector<RunFrame> const run = spoilt([](RunFrame& frame) {
    frame.belief.objects.pop_back();
    StuffSummary piece = frame.belief.stuff.front();
    piece.id = 20;
    piece.label = LabelCode{4010};
    frame.belief.stuff.push_back(piece);
    fill(frame.labels, square(1, 1), 4010);
  });
  Scores const scores = scores_of(run);
  EXPECT_EQ(scores.segmentation.iou.at("stuff"), 1.0);
  EXPECT_EQ(scores.segmentation.iou.at("object"), 1.0);
  EXPECT_EQ(scores.objects.recall, 1.0) << "of what it was told";
  EXPECT_EQ(scores.stuff->item_frames, 15U);
  EXPECT_NEAR(scores.existence->ece, 0.1, 1e-12);
}

TEST(Evaluation, APieceThatIsTrulyFloorOrAKnownObjectIsNotThere) {
  Scores const scores = scores_of(spoilt([](RunFrame& frame) {
    StuffSummary piece = frame.belief.stuff.front();
    piece.id = 20;
    piece.label = LabelCode{4010};
    frame.belief.stuff.push_back(piece);
    fill(frame.labels, square(0, 2), 4010);
    piece.id = 21;
    piece.label = LabelCode{4011};
    frame.belief.stuff.push_back(piece);
    fill(frame.labels, {Eigen::Vector2i(0, 10), Eigen::Vector2i(2, 12)}, 4011);
  }));
  EXPECT_EQ(changed_groups(scores), "segmentation existence ");
  EXPECT_NEAR(scores.existence->ece, 0.9 - 4.0 / 6.0, 1e-12);
}

TEST(Evaluation, AnotherIdIsASwitchAndAMissedFrameAnInterruption) {
  std::vector<RunFrame> run = perfect_run(kFrames);
  run[2].belief.stuff[0].label.reset();
  fill(run[2].labels, square(2, 1), kUnassigned);
  run[4].belief.stuff[1].id = 99;
  Scores const all = scores_of(run);
  EXPECT_THAT(scores_json(all), testing::HasSubstr("\"id_switches\": 1,"));
  StuffScores const& scores = *all.stuff;
  EXPECT_EQ(scores.fragmentations, 1U);
  EXPECT_EQ(scores.item_frames, 9U);
  ASSERT_EQ(scores.switches.size(), 1U);
  EXPECT_EQ(scores.switches[0].frame, FrameIndex{4});
  EXPECT_EQ(scores.switches[0].body, run[4].truth.stuff[1].label);
  EXPECT_EQ(scores.switches[0].from_id, run[3].belief.stuff[1].id);
  EXPECT_EQ(scores.switches[0].to_id, 99U);
}

TEST(Evaluation, OutOfSightIsNoInterruption) {
  std::vector<RunFrame> run = perfect_run(kFrames);
  fill(run[2].labels, square(2, 1), kFloor);
  fill(run[2].true_labels, square(2, 1), kFloor);
  run[2].belief.stuff[0].label.reset();
  EXPECT_EQ(scores_of(run).stuff->fragmentations, 0U);
}

TEST(Evaluation, LostFramesAndMissingImagesLeaveTheRest) {
  std::vector<RunFrame> const run = perfect_run(kFrames);
  Evaluation evaluation(room_models(), kRoomCamera);
  for (RunFrame const& frame : run) {
    bool const lost = frame.truth.frame == FrameIndex{1};
    evaluation.add({frame.truth, lost ? nullptr : &frame.belief});
  }
  Scores const scores = evaluation.scores();
  EXPECT_EQ(scores.frames, 4U);
  EXPECT_FALSE(scores.segmentation.instances);
  EXPECT_FALSE(scores.stuff);
  EXPECT_EQ(scores.objects.precision, 1.0);
  EXPECT_NEAR(scores.existence->ece, 0.1, 1e-12) << "of the known objects";
  EXPECT_FALSE(scores.walls.recall) << "which walls were to be seen is told by the images";
}

TEST(Evaluation, NothingAtAllHasNoScores) {
  std::string const json = scores_json(Evaluation({}, std::nullopt).scores());
  EXPECT_NE(json.find("\"wov\": null"), std::string::npos);
  EXPECT_NE(json.find("\"tilt_deg\": null"), std::string::npos);
  EXPECT_NE(json.find("\"ate_m\": null"), std::string::npos);
  EXPECT_NE(json.find("\"ece\": null"), std::string::npos);
  EXPECT_NE(json.find("\"delay_frames\": null"), std::string::npos);
  EXPECT_NE(json.find("\"id_switches\": null"), std::string::npos);
}

TEST(Evaluation, PartsOfThingsCountByThemselvesAndAsOne) {
  // A table (label 1), a thing of two parts (20, 21), one of one part (30); both parts in one
  // segment, the other thing in two halves.
  LabelMap truth(40, 10, 1);
  LabelMap labels(40, 10, kUnassigned);
  fill(truth, square(0, 0), 20);
  fill(truth, square(1, 0), 21);
  fill(truth, square(2, 0), 30);
  fill(labels, square(0, 0), 4000);
  fill(labels, square(1, 0), 4000);
  fill(labels, {Eigen::Vector2i(20, 0), Eigen::Vector2i(24, 9)}, 4001);
  fill(labels, {Eigen::Vector2i(25, 0), Eigen::Vector2i(29, 9)}, 4002);
  LabelEvaluation evaluation;
  evaluation.add(labels, truth);
  Scores const scores = evaluation.scores();
  OverlapScores const& parts = *scores.segmentation.instances;
  EXPECT_NEAR(parts.weighted_overlap, 0.5, 1e-12) << "each part half its segment, and half a thing";
  EXPECT_NEAR(parts.over_segmentation, 1.0 - 250.0 / 300.0, 1e-12);
  EXPECT_NEAR(parts.under_segmentation, 200.0 / 300.0, 1e-12);
  EXPECT_EQ(parts.recall_50, 0.0) << "a half is not above a half";
  OverlapScores const& things = *scores.segmentation.merged;
  EXPECT_NEAR(things.weighted_overlap, (200.0 + 50.0) / 300.0, 1e-12);
  EXPECT_EQ(things.under_segmentation, 0.0);
  EXPECT_EQ(things.recall_50, 0.5);
}

}  // namespace
}  // namespace credo::test
