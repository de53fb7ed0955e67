#include "io/pictures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "io/beliefs.hpp"
#include "io/canvas.hpp"
#include "io/palette.hpp"
#include "io/plain_pictures.hpp"

namespace credo::test {
namespace {

constexpr Rgb kPurple = {165, 80, 235};

StuffBelief stuff_of(std::uint32_t id, double log_odds, PointList points) {
  auto cluster = std::make_shared<StuffCluster>();
  cluster->points_world = std::move(points);
  StuffBelief stuff;
  stuff.id = id;
  stuff.log_odds = log_odds;
  stuff.recent_clusters = {cluster};
  return stuff;
}

bool shows(Grid<Rgb> const& picture, Panel const& panel, Rgb color) {
  for (int y = 0; y < panel.height; ++y) {
    for (int x = 0; x < panel.width; ++x) {
      if (picture[Pixel{panel.left + x, panel.top + y}] == color) {
        return true;
      }
    }
  }
  return false;
}

int saturation(Rgb color) {
  auto const [least, most] = std::minmax_element(color.begin(), color.end());
  return *most - *least;
}

Rgb pixel_in(Grid<Rgb> const& picture, Panel const& panel, View::Projection const& at) {
  return picture[Pixel{panel.left + at.x, panel.top + at.y}];
}

TEST(Pictures, LabelsHaveTheColorsOfTheThesis) {
  EXPECT_EQ(label_color(kNoDepth), (Rgb{0, 0, 0}));
  EXPECT_EQ(label_color(kUnassigned), (Rgb{0, 190, 200}));
  EXPECT_EQ(label_color(kFloor), kRed);
  EXPECT_EQ(label_color(kFirstWall), (Rgb{255, 130, 190}));
  EXPECT_EQ(label_color(kFirstStuff), kPurple);
  EXPECT_NE(label_color(kFirstStuff), label_color(kFirstStuff + 1));
}

TEST(Pictures, ColorAndSegmentationStandAboveTheBelief) {
  Frame frame = plain_frame(320, 240);
  frame.color = Grid<Rgb>(320, 240, {10, 20, 30});
  frame.color[Pixel{100, 40}] = {200, 100, 50};
  Segmentation segmentation = plain_segmentation(frame);
  segmentation.labels[Pixel{100, 40}] = kFloor;
  segmentation.labels[Pixel{0, 0}] = kNoDepth;
  Grid<Rgb> const picture = draw_picture(frame, segmentation, plain_belief(), {});
  EXPECT_EQ(picture.width(), 324);
  EXPECT_EQ(picture.height(), 244);
  EXPECT_EQ((picture[Pixel{50, 20}]), (Rgb{200, 100, 50}));
  EXPECT_EQ((picture[Pixel{0, 0}]), (Rgb{10, 20, 30}));
  Rgb const floor = picture[Pixel{164 + 50, 20}];
  EXPECT_GT(floor[0], 2 * floor[1]) << "red, though shaded by its depth";
  EXPECT_GT(floor[0], 2 * floor[2]);
  EXPECT_EQ((picture[Pixel{164, 0}]), (Rgb{0, 0, 0}));
}

TEST(Pictures, WithoutColorTheDepthStandsForIt) {
  Frame frame = plain_frame(4, 4);
  frame.cloud_camera.set(0, {kNaN, kNaN, kNaN});
  Grid<Rgb> const picture = draw_picture(frame, plain_segmentation(frame), plain_belief(), {});
  EXPECT_EQ((picture[Pixel{0, 0}]), (Rgb{0, 0, 0}));
  EXPECT_EQ((picture[Pixel{1, 1}]), (Rgb{171, 171, 171}));
}

TEST(Pictures, StuffKeepsItsBeliefsColorInTheSegmentation) {
  Frame const frame = plain_frame(320, 240);
  Segmentation segmentation = plain_segmentation(frame);
  segmentation.labels = LabelMap(320, 240, kFirstStuff);
  BeliefState belief = plain_belief();
  Grid<Rgb> const unknown = draw_picture(frame, segmentation, belief, {});
  belief.stuff = {stuff_of(25, 2.0, {{2, 0, 0.5}})};
  belief.stuff[0].label = kFirstStuff;
  Grid<Rgb> const known = draw_picture(frame, segmentation, belief, {});
  EXPECT_EQ((unknown[Pixel{200, 50}]), (Rgb{167, 103, 219})) << "purple, the label's";
  EXPECT_EQ((known[Pixel{200, 50}]), (Rgb{227, 208, 73})) << "yellow, that of id 25";
}

// There are more things than colours.
TEST(Pictures, TwoPiecesOfStuffOfOneColorHaveABorder) {
  Frame const frame = plain_frame(320, 240);
  Segmentation segmentation = plain_segmentation(frame);
  auto const at_border = [&](LabelCode left, LabelCode right) {
    segmentation.labels = LabelMap(320, 240, left);
    for (int v = 0; v < 240; ++v) {
      std::ranges::fill(segmentation.labels.row(v).subspan(160), right);
    }
    Grid<Rgb> const picture = draw_picture(frame, segmentation, plain_belief(), {});
    // The panel begins at 164 and has half the pixels.
    return std::pair(picture[Pixel{164 + 79, 50}], picture[Pixel{164 + 78, 50}]);
  };
  auto const [border, inside] = at_border(kFirstStuff, kFirstStuff + 24);
  EXPECT_LT(border[0], inside[0] / 2);
  EXPECT_EQ(at_border(kFirstStuff, kFirstStuff).first, inside) << "one piece";
  EXPECT_NE(at_border(kFloor, kFirstStuff).first, at_border(kFloor, kFirstStuff).second);
  EXPECT_EQ(at_border(kFloor, kFirstWall).first, at_border(kFloor, kFirstWall).second);
}

TEST(Pictures, ThePointsOfABeliefStandWhereTheViewsProjectThem) {
  Frame const frame = plain_frame(320, 240);
  Segmentation segmentation = plain_segmentation(frame);
  segmentation.labels = LabelMap(320, 240, kNoDepth);
  BeliefState belief = plain_belief();
  Eigen::Vector3f const on_floor(2.3F, 0.4F, 0.0F);
  Eigen::Vector3f const thing(2.6F, -0.6F, 0.3F);
  belief.floor.emplace();
  belief.floor->points = std::make_shared<PointList>(PointList{on_floor});
  belief.stuff = {stuff_of(24, 40.0, {thing})};
  Grid<Rgb> const picture = draw_picture(frame, segmentation, belief, {});
  View const views[] = {oblique_view(level_camera(), kOblique), map_view(level_camera(), kMap)};
  for (View const& view : views) {
    auto const floor_at = view.project(on_floor.cast<double>());
    auto const thing_at = view.project(thing.cast<double>());
    ASSERT_TRUE(floor_at && thing_at);
    EXPECT_EQ(pixel_in(picture, view.panel, *floor_at), kRed);
    EXPECT_EQ(pixel_in(picture, view.panel, *thing_at), kPurple);
  }
}

TEST(Pictures, WallsAreDrawnWithTheirSegments) {
  Frame const frame = plain_frame(320, 240);
  Segmentation segmentation = plain_segmentation(frame);
  segmentation.labels = LabelMap(320, 240, kNoDepth);
  BeliefState belief = plain_belief();
  WallBelief wall;
  wall.segment_start_m = {2.5, -0.7};
  wall.segment_end_m = {2.5, 0.9};
  wall.points = std::make_shared<PointList>(PointList{{2.5F, 0.3F, 0.4F}});
  belief.walls = {wall};
  Grid<Rgb> const picture = draw_picture(frame, segmentation, belief, {});
  View const oblique = oblique_view(level_camera(), kOblique);
  EXPECT_EQ(pixel_in(picture, kOblique, oblique.project({2.5, 0.3, 0.4}).value()),
            (Rgb{255, 130, 190}));
  View const map = map_view(level_camera(), kMap);
  for (double const y : {-0.7, -0.2, 0.4, 0.9}) {
    EXPECT_EQ(pixel_in(picture, kMap, map.project({2.5, y, 0}).value()), (Rgb{255, 200, 230}));
  }
}

TEST(Pictures, LatestCloudIsCyanAndKnownObjectsAreMarked) {
  Frame const frame = plain_frame(320, 240);
  BeliefState belief = plain_belief();
  Grid<Rgb> const before = draw_picture(frame, plain_segmentation(frame), belief, {});
  EXPECT_TRUE(shows(before, kOblique, {0, 190, 200}));
  EXPECT_TRUE(shows(before, kMap, {0, 190, 200}));
  EXPECT_FALSE(shows(before, kMap, {255, 0, 255}));
  belief.objects.resize(1);
  belief.objects[0].log_odds = 40;
  belief.objects[0].pose_world.mean = Se3(Eigen::Quaterniond::Identity(), {1.5, 0.5, 0.8});
  Grid<Rgb> const after = draw_picture(frame, plain_segmentation(frame), belief, {});
  EXPECT_TRUE(shows(after, kOblique, {255, 0, 255}));
  EXPECT_TRUE(shows(after, kMap, {255, 0, 255}));
}

TEST(Pictures, KnownObjectsAreCyanLikeTheCloudThatTheyAreFoundIn) {
  Frame const frame = plain_frame(320, 240);
  Segmentation segmentation = plain_segmentation(frame);
  segmentation.labels = LabelMap(320, 240, kFirstObject);
  Grid<Rgb> const of_object = draw_picture(frame, segmentation, plain_belief(), {});
  EXPECT_TRUE(shows(of_object, kOblique, kCyan));
  EXPECT_TRUE(shows(of_object, kMap, kCyan));
  segmentation.labels = LabelMap(320, 240, kFloor);
  Grid<Rgb> const of_floor = draw_picture(frame, segmentation, plain_belief(), {});
  EXPECT_FALSE(shows(of_floor, kOblique, kCyan)) << "floor is the belief's to show";
}

TEST(Pictures, AColorOfStuffHasItsName) {
  EXPECT_EQ(stuff_color(24, 1.0), kPurple);
  EXPECT_STREQ(stuff_color_name(24), "purple");
  EXPECT_STREQ(stuff_color_name(25), "yellow");
  EXPECT_STREQ(stuff_color_name(2), "green");
}

TEST(Pictures, TwoDozenThingsAreToldApart) {
  for (std::uint32_t a = 0; a < 24; ++a) {
    for (std::uint32_t b = 0; b < a; ++b) {
      EXPECT_STRNE(stuff_color_name(a), stuff_color_name(b));
      int difference = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        difference += std::abs(stuff_color(a, 1.0)[c] - stuff_color(b, 1.0)[c]);
      }
      EXPECT_GT(difference, 60) << stuff_color_name(a) << " and " << stuff_color_name(b);
    }
  }
}

TEST(Pictures, StuffPalesWithItsProbability) {
  int last = saturation(stuff_color(3, 1.0));
  for (double const probability : {0.8, 0.5, 0.3}) {
    int const now = saturation(stuff_color(3, probability));
    EXPECT_LT(now, last);
    last = now;
  }
  EXPECT_EQ(stuff_color(3, 0.0), stuff_color(3, 0.1)) << "never quite gone";
}

TEST(Pictures, TinyFramesAndNaNsDoNoHarm) {
  for (int const side : {0, 1}) {
    Frame const frame = plain_frame(side, side);
    EXPECT_TRUE(draw_picture(frame, plain_segmentation(frame), plain_belief(), {}).empty());
  }
  Frame frame = plain_frame(320, 240);
  frame.cloud_camera = OrganizedCloud(320, 240);
  BeliefState belief = belief_of_a_kitchen();
  belief.floor->points = std::make_shared<PointList>(PointList{{kNaN, kNaN, kNaN}});
  belief.walls[0].segment_end_m = {1e9, std::nan("")};
  EXPECT_FALSE(draw_picture(frame, plain_segmentation(frame), belief, {}).empty());
}

TEST(Views, LookWhereTheCameraLooks) {
  View const oblique = oblique_view(level_camera(), kOblique);
  auto const camera = oblique.project(level_camera().translation()).value();
  auto const ahead = oblique.project({3, 0, 0}).value();
  auto const left = oblique.project({3, 1, 0}).value();
  EXPECT_NEAR(camera.x, 80, 1);
  EXPECT_NEAR(ahead.x, 80, 1);
  EXPECT_LT(left.x, ahead.x);
  EXPECT_GT(ahead.depth_m, camera.depth_m);
  EXPECT_FALSE(oblique.project({-5, 0, 0})) << "behind";

  View const map = map_view(level_camera(), kMap);
  auto const centre = map.project({1.5, 0, 0}).value();
  EXPECT_NEAR(centre.x, 80, 1);
  EXPECT_NEAR(centre.y, 60, 1);
  EXPECT_GT(map.project({2.5, 0, 0}).value().x, centre.x) << "x to the right";
  EXPECT_LT(map.project({1.5, 1, 0}).value().y, centre.y) << "y up";
  EXPECT_LT(map.project({1.5, 0, 1}).value().depth_m, centre.depth_m) << "the higher is nearer";
}

TEST(Views, OfACameraThatLooksStraightDownAreFinite) {
  Se3 const down(Eigen::Quaterniond(0, 1, 0, 0), {0, 0, 2});
  EXPECT_TRUE(oblique_view(down, kOblique).project({1, 0, 0}));
  EXPECT_TRUE(map_view(down, kMap).project({1, 0, 0}));
}

TEST(Splats, TheNearerPointWinsInAnyOrder) {
  Rgb const near = {1, 1, 1};
  Rgb const far = {2, 2, 2};
  Panel const panel{0, 0, 9, 9};
  View const view{panel, Se3(), 10.0, true};
  for (bool const near_first : {true, false}) {
    Canvas canvas(9, 9, {0, 0, 0});
    Splats splats(view, canvas);
    splats.point({0, 0, near_first ? 1.0 : 2.0}, near_first ? near : far, 1);
    splats.point({0, 0, near_first ? 2.0 : 1.0}, near_first ? far : near, 1);
    EXPECT_EQ((canvas.take()[Pixel{4, 4}]), near);
  }
}

TEST(Splats, AreSquaresThatEndAtTheirPanel) {
  Panel const panel{1, 1, 3, 3};
  Canvas canvas(6, 6, {0, 0, 0});
  Splats splats({panel, Se3(), 1.0, true}, canvas);
  splats.point({1.0, 1.0, 1.0}, {9, 9, 9}, 2);
  Grid<Rgb> const image = canvas.take();
  EXPECT_EQ(std::count(image.begin(), image.end(), Rgb{9, 9, 9}), 4);
  EXPECT_EQ((image[Pixel{3, 3}]), (Rgb{9, 9, 9}));
  EXPECT_EQ((image[Pixel{4, 4}]), (Rgb{0, 0, 0}));
}

}  // namespace
}  // namespace credo::test
