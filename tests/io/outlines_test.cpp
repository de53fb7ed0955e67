// Known objects in pictures: the lines of their models where their poses put them, and none
// elsewhere.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "io/palette.hpp"
#include "io/pictures.hpp"
#include "io/plain_pictures.hpp"

namespace credo::test {
namespace {

using Eigen::Vector3d;

constexpr Rgb kMagenta = {255, 0, 255};
constexpr Rgb kBlue = {70, 110, 255};
constexpr Rgb kOrange = {255, 140, 0};

OutlineEdge sharp_edge(Vector3d const& begin, Vector3d const& end) {
  OutlineEdge edge{begin.cast<float>(), end.cast<float>()};
  edge.sharp = true;
  return edge;
}

/// The twelve edges of a box on the centre of its base; no two sides are equal.
std::vector<OutlineEdge> box_edges() {
  Vector3d const size(0.3, 0.5, 0.7);
  auto const corner = [&](int i) {
    return Vector3d(((i & 1) != 0 ? 0.5 : -0.5) * size.x(), ((i & 2) != 0 ? 0.5 : -0.5) * size.y(),
                    (i & 4) != 0 ? size.z() : 0.0);
  };
  std::vector<OutlineEdge> edges;
  for (int from = 0; from < 8; ++from) {
    for (int const bit : {1, 2, 4}) {
      if ((from & bit) == 0) {
        edges.push_back(sharp_edge(corner(from), corner(from | bit)));
      }
    }
  }
  return edges;
}

Outlines box_outline() {
  return {{"box", box_edges()}};
}

/// Before the camera, a little to the left and below, turned about all axes.
Se3 box_pose() {
  return {so3_exp({0.2, -0.3, 0.6}), {2.2, 0.25, 0.9}};
}

ObjectBelief sure_of(std::string type, Se3 const& pose) {
  ObjectBelief object;
  object.id = type + "_1";
  object.type = std::move(type);
  object.log_odds = 40;
  object.evidence = Evidence::kSeen;
  object.pose_world.mean = pose;
  return object;
}

/// Where a picture shows a point of the world, in its own pixels; by formulas of this test's own.
using Where = std::function<Pixel(Vector3d const&)>;

Pixel in_camera(CameraIntrinsics const& camera, Vector3d const& p_world) {
  Vector3d const p = level_camera().inverse() * p_world;
  double const u = camera.fx_px * p.x() / p.z() + camera.cx_px;
  double const v = camera.fy_px * p.y() / p.z() + camera.cy_px;
  return {static_cast<int>(std::floor(0.5 * (u + 0.5))),
          static_cast<int>(std::floor(0.5 * (v + 0.5)))};
}

Pixel in_map(Vector3d const& p_world) {
  constexpr double kPixelsPerMetre = 120 / 7.0;
  return {kMap.left + static_cast<int>(std::floor(80 + kPixelsPerMetre * (p_world.x() - 1.5))),
          kMap.top + static_cast<int>(std::floor(60 - kPixelsPerMetre * p_world.y()))};
}

/// The test of the views says where this one looks.
Pixel in_oblique(Vector3d const& p_world) {
  auto const at = oblique_view(level_camera(), kOblique).project(p_world).value();
  return {kOblique.left + at.x, kOblique.top + at.y};
}

/// The pixels of a picture that are on the lines where they should be, and those of this colour in
/// the panel that are more than a pixel away from them.
struct Drawn {
  int expected = 0;
  int on_lines = 0;
  int astray = 0;
};

Drawn drawn(Grid<Rgb> const& picture, Panel const& panel, Rgb color,
            std::vector<OutlineEdge> const& edges, Se3 const& pose, Where const& where) {
  Grid<std::uint8_t> expected(picture.width(), picture.height(), 0);
  for (OutlineEdge const& edge : edges) {
    for (int k = 0; k <= 2000; ++k) {
      Vector3d const p =
          edge.begin.cast<double>() + k / 2000.0 * (edge.end - edge.begin).cast<double>();
      expected[where(pose * p)] = 1;
    }
  }
  auto const near_line = [&](Pixel const& at) {
    for (int v = at.v - 1; v <= at.v + 1; ++v) {
      for (int u = at.u - 1; u <= at.u + 1; ++u) {
        if (expected.contains({u, v}) && expected[Pixel{u, v}] != 0) {
          return true;
        }
      }
    }
    return false;
  };
  Drawn result;
  for (int y = panel.top; y < panel.top + panel.height; ++y) {
    for (int x = panel.left; x < panel.left + panel.width; ++x) {
      Pixel const at{x, y};
      bool const colored = picture[at] == color;
      result.expected += expected[at];
      result.on_lines += expected[at] != 0 && colored ? 1 : 0;
      result.astray += colored && !near_line(at) ? 1 : 0;
    }
  }
  return result;
}

/// Rounding may put a few pixels beside their line.
void expect_lines(Drawn const& lines) {
  EXPECT_GT(lines.expected, 50);
  EXPECT_GT(lines.on_lines, 0.9 * lines.expected);
  EXPECT_EQ(lines.astray, 0);
}

class OutlinePictures : public testing::Test {
protected:
  OutlinePictures() {
    frame_.intrinsics = {290, 290, 155, 122};
    segmentation_.labels = LabelMap(320, 240, kNoDepth);
  }
  [[nodiscard]] Grid<Rgb> picture() const {
    return draw_picture(frame_, segmentation_, belief_, outlines_);
  }
  [[nodiscard]] Where in_camera_panel() const {
    return [camera = frame_.intrinsics](Vector3d const& p) { return in_camera(camera, p); };
  }
  [[nodiscard]] Drawn box_in_camera(Rgb color) const {
    return drawn(picture(), kCameraPanel, color, box_edges(), box_pose(), in_camera_panel());
  }
  [[nodiscard]] int count(Panel const& panel, Rgb color) const {
    return drawn(picture(), panel, color, {}, {}, in_map).astray;
  }

  Frame frame_ = plain_frame(320, 240);
  Segmentation segmentation_ = plain_segmentation(frame_);
  BeliefState belief_ = plain_belief();
  Outlines outlines_ = box_outline();
};

TEST_F(OutlinePictures, KnownObjectsAreOutlinedInTheCamerasPicture) {
  EXPECT_EQ(count(kCameraPanel, kMagenta), 0);
  belief_.objects = {sure_of("box", box_pose())};
  expect_lines(box_in_camera(kMagenta));
}

TEST_F(OutlinePictures, AlsoWherePixelsAreNotSquare) {
  frame_.intrinsics = {290, 220, 155, 122};
  belief_.objects = {sure_of("box", box_pose())};
  expect_lines(box_in_camera(kMagenta));
}

TEST_F(OutlinePictures, KnownObjectsAreOutlinedInTheBelief) {
  EXPECT_EQ(count(kOblique, kMagenta) + count(kMap, kMagenta), 0);
  belief_.objects = {sure_of("box", box_pose())};
  Grid<Rgb> const drawing = picture();
  expect_lines(drawn(drawing, kOblique, kMagenta, box_edges(), box_pose(), in_oblique));
  Drawn const map = drawn(drawing, kMap, kMagenta, box_edges(), box_pose(), in_map);
  EXPECT_GT(map.on_lines, 0.9 * map.expected);
  EXPECT_EQ(map.astray, 0);
}

TEST_F(OutlinePictures, TheSecondObjectHasItsOwnColorAndPlace) {
  Se3 const beside(Eigen::Quaterniond::Identity(), {2.5, -0.6, 1.2});
  belief_.objects = {sure_of("box", box_pose()), sure_of("box", beside)};
  expect_lines(box_in_camera(kMagenta));
  expect_lines(drawn(picture(), kCameraPanel, kBlue, box_edges(), beside, in_camera_panel()));
}

TEST_F(OutlinePictures, UnlikelyObjectsArePaleInTheBeliefOnly) {
  belief_.objects = {sure_of("box", box_pose())};
  belief_.objects[0].log_odds = 0;
  Grid<Rgb> const drawing = picture();
  expect_lines(box_in_camera(kMagenta));
  expect_lines(drawn(drawing, kOblique, object_color(0, 0.5), box_edges(), box_pose(), in_oblique));
  EXPECT_EQ(count(kOblique, kMagenta), 0);
}

TEST_F(OutlinePictures, WhatTheFrameDidNotShowIsDotted) {
  belief_.objects = {sure_of("box", box_pose())};
  for (Evidence const evidence :
       {Evidence::kSeenThrough, Evidence::kOccluded, Evidence::kOutOfView, Evidence::kNotSeen}) {
    belief_.objects[0].evidence = evidence;
    Drawn const dots = box_in_camera(kMagenta);
    EXPECT_GT(dots.on_lines, 0.3 * dots.expected) << to_string(evidence);
    EXPECT_LT(dots.on_lines, 0.7 * dots.expected) << to_string(evidence);
    EXPECT_EQ(dots.astray, 0);
    expect_lines(drawn(picture(), kOblique, kMagenta, box_edges(), box_pose(), in_oblique));
  }
}

TEST_F(OutlinePictures, RefusedDetectionsAreOrangeInTheCamerasPictureOnly) {
  EXPECT_EQ(count(kCameraPanel, kOrange), 0);
  RefusedDetection refused;
  refused.type = "box";
  refused.pose_world.mean = box_pose();
  segmentation_.refused = {refused};
  expect_lines(box_in_camera(kOrange));
  EXPECT_EQ(count(kOblique, kOrange) + count(kMap, kOrange), 0);
}

TEST_F(OutlinePictures, WithoutAModelTheAxesStandForIt) {
  std::vector<OutlineEdge> const axes = {sharp_edge({0, 0, 0}, {0.15, 0, 0}),
                                         sharp_edge({0, 0, 0}, {0, 0.15, 0}),
                                         sharp_edge({0, 0, 0}, {0, 0, 0.15})};
  belief_.objects = {sure_of("cat", box_pose())};
  Drawn const lines = drawn(picture(), kCameraPanel, kMagenta, axes, box_pose(), in_camera_panel());
  EXPECT_GT(lines.expected, 15);
  EXPECT_GT(lines.on_lines, 0.9 * lines.expected);
  EXPECT_EQ(lines.astray, 0);
}

/// An edge before the camera, between two faces; `yaw` turns the model about z.
class RoundedEdge : public OutlinePictures {
protected:
  bool shown(Vector3d const& normal_left, Vector3d const& normal_right, double yaw, Panel panel) {
    OutlineEdge edge{{0, 0, 0}, {0, 0, 0.4F}};
    edge.normal_left = normal_left.cast<float>();
    edge.normal_right = normal_right.cast<float>();
    outlines_ = {{"box", {edge}}};
    belief_.objects = {sure_of("box", {so3_exp({0, 0, yaw}), {2, to_the_left_m, 1.3}})};
    return count(panel, kMagenta) > 0;
  }

  double to_the_left_m = 0.0;
};

TEST_F(RoundedEdge, IsDrawnWhereOneFaceIsTurnedAway) {
  Vector3d const towards(-1, 0.1, 0);
  Vector3d const away(1, 0.1, 0);
  Vector3d const aside(-0.2, 1, 0);
  EXPECT_TRUE(shown(towards, away, 0, kCameraPanel));
  EXPECT_TRUE(shown(away, towards, 0, kCameraPanel));
  EXPECT_FALSE(shown(towards, aside, 0, kCameraPanel)) << "both face the camera";
  EXPECT_FALSE(shown(away, away, 0, kCameraPanel));
}

TEST_F(RoundedEdge, TurnsWithTheObject) {
  Vector3d const towards(-1, 0.1, 0);
  Vector3d const aside(-0.2, 1, 0);
  EXPECT_FALSE(shown(towards, aside, 0, kCameraPanel));
  EXPECT_TRUE(shown(towards, aside, -0.5, kCameraPanel));
}

// Straight ahead, the camera would see the back of the first and the front of the second.
TEST_F(RoundedEdge, IsSeenFromWhereTheCameraStands) {
  to_the_left_m = 0.8;
  EXPECT_FALSE(shown({-1, 0, 0}, {0.2, -1, 0}, 0, kCameraPanel)) << "both face the camera";
  EXPECT_TRUE(shown({-1, 0, 0}, {-0.2, 1, 0}, 0, kCameraPanel));
}

TEST_F(RoundedEdge, EachViewSeesItFromItsOwnSide) {
  EXPECT_TRUE(shown({-1, 0, 0.1}, {1, 0, 0.1}, 0, kCameraPanel));
  EXPECT_FALSE(shown({-1, 0, 0.1}, {1, 0, 0.1}, 0, kMap)) << "both faces are turned up";
  EXPECT_FALSE(shown({-1, 0, 0.1}, {-1, 0, -0.1}, 0, kCameraPanel)) << "both face the camera";
  EXPECT_TRUE(shown({-1, 0, 0.1}, {-1, 0, -0.1}, 0, kMap));
}

}  // namespace
}  // namespace credo::test
