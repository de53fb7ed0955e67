#include "stages/fusion/fusion.hpp"

#include <gmock/gmock.h>
#include <oneapi/tbb/global_control.h>

#include <numeric>
#include <random>
#include <utility>

#include "stages/fusion/scenes.hpp"

namespace credo {
namespace {

using test::box_cluster;
using test::empty_segmentation;
using test::floor_patch;
using test::thesis_config;
using test::wall;
using testing::Eq;
using testing::IsEmpty;
using testing::Le;
using testing::SizeIs;

BeliefState prior_with(std::vector<std::string> const& ids) {
  BeliefState prior;
  for (std::string const& id : ids) {
    ObjectBelief& object = prior.objects.emplace_back();
    object.id = id;
    object.type = "box";
    object.log_odds = log_odds_of(FusionConfig{}.prior_probability);
    object.pose_world = {Se3(Eigen::Quaterniond::Identity(), {1, 0, 0}),
                         1e-3 * Matrix6d::Identity()};
  }
  return prior;
}

ObjectObservation object_seen(LabelCode label, std::string id) {
  ObjectObservation seen;
  seen.label = label;
  seen.object_id = std::move(id);
  seen.pixel_count = 1000;
  seen.pose_world = {Se3(Eigen::Quaterniond::Identity(), {1, 0, 0}), 1e-4 * Matrix6d::Identity()};
  return seen;
}

/// A room that a camera drifts through, a little different in each frame.
Segmentation room(int number) {
  std::mt19937 random(static_cast<unsigned>(number));
  std::normal_distribution<float> noise(0.0F, 0.004F);
  auto const shake = [&] { return Eigen::Vector3f(noise(random), noise(random), noise(random)); };
  Segmentation frame = empty_segmentation(number);
  frame.T_world_camera =
      Se3(Eigen::Quaterniond::Identity(), {-1.0 + 0.01 * (number % 100), -1.0, 1.0});
  float const x = 0.05F * static_cast<float>(number % 100);
  frame.floor = floor_patch({x, 0}, {x + 2, 2}, noise(random));
  auto const y = static_cast<double>(noise(random));
  frame.walls = {wall(2000, {0, 3 + y}, {4, 3 + y}), wall(2001, {6 + y, 4}, {6 + y, 0})};
  LabelCode label = kFirstStuff;
  for (int i = 0; i < 8; ++i) {
    // Each is missing in some frames, and one moves on.
    if ((number + i) % 7 == 0) {
      continue;
    }
    float const way = i == 0 ? 0.002F * static_cast<float>(number) : 0.0F;
    Eigen::Vector3f const corner(0.3F * static_cast<float>(i), way, 0.0F);
    frame.stuff.push_back(
        box_cluster(label++, corner + shake(), {0.2F, 0.1F + 0.02F * static_cast<float>(i), 0.1F}));
  }
  return frame;
}

/// Hand-made frames have clusters, and no depth behind them.
FusionConfig by_clusters() {
  FusionConfig config;
  config.visibility = false;
  return config;
}

BeliefState after(int frames, FusionConfig const& config, Se3 const& motion = {}) {
  BeliefState belief;
  for (int i = 0; i < frames; ++i) {
    belief = fuse(std::move(belief), test::moved(motion, room(i)), config);
  }
  return belief;
}

void expect_finite(BeliefState const& belief) {
  if (belief.floor) {
    EXPECT_TRUE(belief.floor->normal.allFinite());
    EXPECT_TRUE(std::isfinite(belief.floor->height_m));
  }
  for (WallBelief const& w : belief.walls) {
    EXPECT_TRUE(w.plane_world.normal.allFinite());
    EXPECT_TRUE(std::isfinite(w.plane_world.offset_m));
    EXPECT_TRUE(w.segment_start_m.allFinite() && w.segment_end_m.allFinite());
  }
  for (StuffBelief const& item : belief.stuff) {
    EXPECT_TRUE(std::isfinite(item.log_odds));
  }
  for (ObjectBelief const& object : belief.objects) {
    EXPECT_TRUE(std::isfinite(object.log_odds));
  }
}

TEST(Fuse, KeepsTheBooksOfTheFrame) {
  Segmentation segmentation = room(5);
  segmentation.segmented_with = FrameIndex{3};
  BeliefState const belief = fuse({}, segmentation, by_clusters());
  EXPECT_EQ(belief.frame, FrameIndex{5});
  EXPECT_EQ(belief.segmented_with, FrameIndex{3});
  EXPECT_EQ(belief.stamp_ns, segmentation.stamp_ns);
  EXPECT_EQ(belief.T_world_camera.matrix(), segmentation.T_world_camera.matrix());
  EXPECT_TRUE(belief.floor);
  EXPECT_THAT(belief.walls, SizeIs(2));
  EXPECT_THAT(belief.stuff, SizeIs(segmentation.stuff.size()));
}

TEST(Fuse, TakesEmptySegmentations) {
  BeliefState const first = fuse({}, empty_segmentation(0), by_clusters());
  EXPECT_EQ(first.frame, FrameIndex{0});
  EXPECT_FALSE(first.floor);
  EXPECT_THAT(first.walls, IsEmpty());
  EXPECT_THAT(first.stuff, IsEmpty());
  BeliefState const later =
      fuse(fuse({}, room(0), by_clusters()), empty_segmentation(1), by_clusters());
  EXPECT_TRUE(later.floor);
  EXPECT_THAT(later.walls, SizeIs(2));
  for (StuffBelief const& item : later.stuff) {
    EXPECT_EQ(item.evidence, Evidence::kNotSeen);
  }
}

TEST(Fuse, BelievesObjectsThatAreSeenAndDoubtsThoseThatAreNot) {
  Segmentation segmentation = empty_segmentation(0);
  segmentation.objects_looked_for = true;
  segmentation.objects = {object_seen(3001, "box_2"), object_seen(3002, "unheard_of")};
  BeliefState belief = prior_with({"box_1", "box_2"});
  for (int i = 0; i < 3; ++i) {
    segmentation.frame = FrameIndex{i};
    belief = fuse(std::move(belief), segmentation, thesis_config());
  }
  ASSERT_THAT(belief.objects, SizeIs(2));
  EXPECT_EQ(belief.objects[0].evidence, Evidence::kNotSeen);
  EXPECT_THAT(belief.objects[0].label, Eq(std::nullopt));
  // Objects fade like stuff, but a known object is not forgotten.
  EXPECT_NEAR(probability_of(belief.objects[0].log_odds), 0.014, 5e-4);
  EXPECT_EQ(belief.objects[1].evidence, Evidence::kSeen);
  EXPECT_EQ(belief.objects[1].label, LabelCode{3001});
  EXPECT_GE(probability_of(belief.objects[1].log_odds), 0.99);
  EXPECT_EQ(belief.objects[1].type, "box");
}

TEST(Fuse, ForgetsWhatWentInAboutASecondHoweverLongItWasSeen) {
  for (int const frames_seen : {1, 30, 900}) {
    BeliefState belief;
    for (int i = 0; i < frames_seen; ++i) {
      Segmentation segmentation = empty_segmentation(i);
      segmentation.stuff = {box_cluster(4000, {1, 0, 0}, {0.1F, 0.1F, 0.1F})};
      belief = fuse(std::move(belief), segmentation, by_clusters());
    }
    int misses = 0;
    while (!belief.stuff.empty() && misses < 1000) {
      belief = fuse(std::move(belief), empty_segmentation(frames_seen + misses), by_clusters());
      ++misses;
    }
    EXPECT_GT(misses, 15) << frames_seen;
    EXPECT_LT(misses, 45) << frames_seen;
  }
}

TEST(Fuse, KeepsOneIdForWhatStaysThroughMissesAndMotion) {
  BeliefState const belief = after(60, by_clusters());
  EXPECT_EQ(belief.next_stuff_id, 9U);
  EXPECT_THAT(belief.stuff, SizeIs(8));
  EXPECT_THAT(belief.walls, SizeIs(2));
}

TEST(Fuse, ChangesOnlyCoordinatesWhenTheWorldIsMoved) {
  // About the vertical: walls are walls and the floor is level in any such world.
  Se3 const motion(so3_exp({0, 0, 0.7}), {3, -2, 0});
  BeliefState const here = after(20, by_clusters());
  BeliefState const there = after(20, by_clusters(), motion);
  ASSERT_EQ(here.stuff.size(), there.stuff.size());
  for (std::size_t i = 0; i < here.stuff.size(); ++i) {
    EXPECT_EQ(here.stuff[i].id, there.stuff[i].id);
    EXPECT_EQ(here.stuff[i].history_count, there.stuff[i].history_count);
    EXPECT_EQ(here.stuff[i].label, there.stuff[i].label);
    EXPECT_NEAR(here.stuff[i].log_odds, there.stuff[i].log_odds, 1e-6);
  }
  ASSERT_EQ(here.walls.size(), there.walls.size());
  for (std::size_t i = 0; i < here.walls.size(); ++i) {
    // The grid that thins the points lies otherwise in the moved world: half a cell.
    double const tolerance_m = 0.025;
    Eigen::Vector2d const& start = here.walls[i].segment_start_m;
    Eigen::Vector3d const expected = motion * Eigen::Vector3d(start.x(), start.y(), 0);
    EXPECT_LT((there.walls[i].segment_start_m - expected.head<2>()).norm(), tolerance_m);
  }
  EXPECT_NEAR(here.floor->height_m, there.floor->height_m, 1e-3);
}

TEST(Fuse, StaysBoundedOverAThousandFrames) {
  FusionConfig config = by_clusters();
  config.floor.max_points = 4000;
  config.walls.max_points = 1000;
  BeliefState belief;
  for (int i = 0; i < 1000; ++i) {
    Segmentation frame = room(i);
    // A clutter that is elsewhere in each frame.
    std::mt19937 random(static_cast<unsigned>(i));
    std::uniform_real_distribution<float> anywhere(0.0F, 50.0F);
    frame.stuff.push_back(
        box_cluster(4500, {anywhere(random), anywhere(random), 3}, {0.1F, 0.1F, 0.1F}));
    belief = fuse(std::move(belief), frame, config);
    ASSERT_THAT(belief.stuff, SizeIs(Le(60U))) << i;
  }
  expect_finite(belief);
  EXPECT_THAT(*belief.floor->points, SizeIs(Le(4000U)));
  for (WallBelief const& w : belief.walls) {
    EXPECT_THAT(*w.points, SizeIs(Le(1000U)));
  }
  EXPECT_THAT(belief.walls, SizeIs(2));
  for (StuffBelief const& item : belief.stuff) {
    EXPECT_THAT(item.recent_clusters, SizeIs(Le(3U)));
  }
}

TEST(Fuse, GivesTheSameBytesAtAnyThreadCount) {
  auto const with_threads = [](std::size_t count) {
    tbb::global_control const limit(tbb::global_control::max_allowed_parallelism, count);
    return after(30, by_clusters());
  };
  BeliefState const one = with_threads(1);
  BeliefState const many = with_threads(4);
  ASSERT_EQ(one.stuff.size(), many.stuff.size());
  for (std::size_t i = 0; i < one.stuff.size(); ++i) {
    EXPECT_EQ(one.stuff[i].id, many.stuff[i].id);
    EXPECT_EQ(one.stuff[i].log_odds, many.stuff[i].log_odds);
    EXPECT_EQ(one.stuff[i].label, many.stuff[i].label);
  }
  ASSERT_EQ(one.walls.size(), many.walls.size());
  for (std::size_t i = 0; i < one.walls.size(); ++i) {
    EXPECT_EQ(one.walls[i].segment_start_m, many.walls[i].segment_start_m);
    EXPECT_EQ(*one.walls[i].points, *many.walls[i].points);
  }
  EXPECT_EQ(one.floor->height_m, many.floor->height_m);
}

TEST(Fuse, LeavesTheBeliefItStartedFromAlone) {
  BeliefState const before = after(10, by_clusters());
  std::size_t const floor_points = before.floor->points->size();
  std::size_t const history = before.stuff.at(0).recent_clusters.size();
  BeliefState const copy = fuse(before, room(60), by_clusters());
  EXPECT_GT(copy.floor->points->size(), floor_points);
  EXPECT_EQ(before.floor->points->size(), floor_points);
  EXPECT_EQ(before.stuff.at(0).recent_clusters.size(), history);
}

TEST(Fields, DescribeEverythingThatFusionIsToldOnce) {
  FusionConfig config;
  FieldList const list = fields(config);
  ASSERT_THAT(list, SizeIs(10));
  EXPECT_EQ(list[0].name, "visibility");
  EXPECT_EQ(list[1].name, "prior_probability");
  EXPECT_EQ(list[2].name, "new_probability");
  std::vector<std::size_t> counts;
  for (std::size_t i = 3; i < list.size(); ++i) {
    counts.push_back(std::get<FieldList>(list[i].target).size());
  }
  EXPECT_THAT(counts, testing::ElementsAre(6, 5, 6, 2, 7, 8, 3));
}

}  // namespace
}  // namespace credo
