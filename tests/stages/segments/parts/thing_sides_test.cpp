#include "stages/segments/parts/thing_sides.hpp"

#include <gmock/gmock.h>

#include <optional>

#include "stages/segments/table.hpp"

namespace credo {
namespace {

using Eigen::Vector3d;
using test::kinect_intrinsics;
using test::label_at;
using test::Table;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr std::int32_t kTable = 1;
constexpr std::int32_t kTop = 2;
constexpr std::int32_t kSide = 3;

/// What a table shows, each pixel labelled by where it is: right, up and ahead of its middle.
template <typename LabelOf>
Segments labelled(Table const& table, Grid<float> const& depth_m, LabelOf const& label_of) {
  CameraIntrinsics const camera = kinect_intrinsics();
  Segments segments;
  segments.labels = Grid<std::int32_t>(depth_m.width(), depth_m.height(), 0);
  Vector3d const origin = table.place(0, 0, 0);
  Eigen::Matrix3d axes;
  axes << table.place(1, 0, 0) - origin, table.place(0, 1, 0) - origin,
      table.place(0, 0, 1) - origin;
  for (int v = 0; v < depth_m.height(); ++v) {
    for (int u = 0; u < depth_m.width(); ++u) {
      Pixel const p{u, v};
      auto const z_m = static_cast<double>(depth_m[p]);
      Vector3d const point((u - camera.cx_px) / camera.fx_px * z_m,
                           (v - camera.cy_px) / camera.fy_px * z_m, z_m);
      if (z_m <= 0.0) {
        continue;
      }
      std::int32_t const label = label_of(axes.transpose() * (point - origin));
      segments.labels[p] = label;
      if (segments.pixel_counts.size() < static_cast<std::size_t>(label)) {
        segments.pixel_counts.resize(static_cast<std::size_t>(label), 0);
      }
      ++segments.pixel_counts[static_cast<std::size_t>(label - 1)];
    }
  }
  return segments;
}

/// A box 9 cm high under a lid that is 2 cm thick and reaches out by a centimetre.
Table lidded_box() {
  Table table(0.9);
  table.add_box(0, 0, 0, {0.11, 0.045, 0.09});
  table.add_box_at({0, 0.1, 0}, 0, {0.12, 0.01, 0.1});
  return table;
}
std::int32_t part_of_box(Vector3d const& at) {
  return at.y() < 0.02 ? kTable : at.y() < 0.104 ? kSide : kTop;
}

/// Whether top and side become one; the table never joins.
bool joins(Segments const& segments, Grid<float> const& depth_m, std::optional<Vector3d> const& up,
           SegmentsConfig const& config = {}) {
  Segments const joined = join_sides(segments, depth_m, kinect_intrinsics(), up, config);
  if (joined.pixel_counts.size() == 3) {
    EXPECT_EQ(joined.labels, segments.labels);
    return false;
  }
  for (std::size_t i = 0; i < joined.labels.size(); ++i) {
    EXPECT_EQ(joined.labels[i], std::min(segments.labels[i], kTop));
  }
  EXPECT_THAT(
      joined.pixel_counts,
      ElementsAre(segments.pixel_counts[0], segments.pixel_counts[1] + segments.pixel_counts[2]));
  return true;
}

TEST(JoinSides, ABoxIsOneWithTheLidThatReachesOutOverIt) {
  Table const table = lidded_box();
  for (bool const noisy : {false, true}) {
    Grid<float> const depth_m = table.depth_m(noisy);
    Segments const parts = labelled(table, depth_m, part_of_box);
    EXPECT_TRUE(joins(parts, depth_m, table.up())) << noisy;
    EXPECT_FALSE(joins(parts, depth_m, std::nullopt)) << noisy;
    EXPECT_FALSE(joins(parts, depth_m, table.place(1, 0, 0) - table.place(0, 0, 0)))
        << "the lid is no top where up is to the right";
  }
}

TEST(JoinSides, WhatReachesOutFromUnderATopIsNoSide) {
  // A board leans on the box's front, 3 cm thick.
  Table table(0.9);
  table.add_box(0, 0, 0, {0.12, 0.055, 0.1});
  table.add_box(0, -0.115, 0, {0.12, 0.053, 0.015});
  Segments const parts = labelled(table, table.depth_m(false), [](Vector3d const& at) {
    return at.y() < 0.004 ? kTable : at.z() < -0.1005 ? kSide : kTop;
  });
  EXPECT_FALSE(joins(parts, table.depth_m(false), table.up()));
  SegmentsConfig uncertain;
  uncertain.quantum_per_m = 0.03;
  EXPECT_TRUE(joins(parts, table.depth_m(false), table.up(), uncertain)) << "within 5 cm";
}

TEST(JoinSides, WhatIsSeenBeyondATopsFarEdgeIsNoSide) {
  Table table(0.9);
  table.add_box(0, 0, 0, {0.12, 0.055, 0.1});
  // Of what stands behind it only the front counts.
  table.add_box(0, 0.23, 0, {0.08, 0.054, 0.03});
  Segments const parts = labelled(table, table.depth_m(false), [](Vector3d const& at) {
    bool const front = at.z() > 0.1995 && at.z() < 0.2005 && at.y() > 0.004;
    return front ? kSide : at.y() < 0.109 ? kTable : kTop;
  });
  // So uncertain that all of it may be under the box's top.
  SegmentsConfig config;
  config.quantum_per_m = 0.1;
  EXPECT_FALSE(joins(parts, table.depth_m(false), table.up(), config));
}

TEST(JoinSides, WhatStandsUnderATopAndDoesNotTouchItIsNoSide) {
  for (auto const& [in_m, touches] : {std::pair(0.07, false), std::pair(0.005, true)}) {
    Table table(0.9, 0.4);
    table.add_box(0, 0, 0, {0.1 - in_m, 0.06, 0.1 - in_m});
    table.add_box_at({0, 0.122, 0}, 0, {0.1, 0.002, 0.1});
    Segments const parts = labelled(table, table.depth_m(false), [](Vector3d const& at) {
      return at.y() < 0.004 ? kTable : at.y() < 0.119 ? kSide : kTop;
    });
    EXPECT_EQ(joins(parts, table.depth_m(false), table.up()), touches) << in_m;
  }
}

TEST(JoinSides, WhatStandsOnATopIsNoSide) {
  // In its middle, and at its far edge, where rays come through its plane beyond it.
  for (double const ahead_m : {0.0, 0.06}) {
    Table table(0.9);
    table.add_box(0, 0, 0, {0.12, 0.055, 0.1});
    table.add_box_at({0, 0.15, ahead_m}, 0, {0.04, 0.04, 0.04});
    Segments const parts = labelled(table, table.depth_m(false), [](Vector3d const& at) {
      return at.y() < 0.109 ? kTable : at.y() > 0.112 ? kSide : kTop;
    });
    EXPECT_FALSE(joins(parts, table.depth_m(false), table.up())) << ahead_m;
  }
}

TEST(JoinSides, AStepIsNoSide) {
  Table table(0.9);
  table.add_box(0, 0, 0, {0.12, 0.055, 0.1});
  table.add_box(0, -0.14, 0, {0.12, 0.05, 0.04});
  Segments const parts = labelled(table, table.depth_m(false), [](Vector3d const& at) {
    bool const on_step = at.z() < -0.1005 && at.y() > 0.098;
    return on_step ? kSide : at.y() < 0.1 || at.z() < -0.1005 ? kTable : kTop;
  });
  // So uncertain that all of it may be under the box's top.
  SegmentsConfig config;
  config.quantum_per_m = 0.1;
  EXPECT_FALSE(joins(parts, table.depth_m(false), table.up(), config));
}

TEST(JoinSides, WhatLiesOnTheTopStaysOnIt) {
  Table const table = lidded_box();
  Grid<float> const depth_m = table.depth_m(false);
  auto const with_pen = [](Vector3d const& at) {
    return part_of_box(at) == kTop && std::abs(at.z()) < 0.02 ? 4 : part_of_box(at);
  };
  Segments parts = labelled(table, depth_m, with_pen);
  parts.lies_on = {0, 0, 0, kTop};
  Segments const joined = join_sides(parts, depth_m, kinect_intrinsics(), table.up(), {});
  EXPECT_THAT(joined.lies_on, ElementsAre(0, 0, kTop));
  EXPECT_EQ(joined.pixel_counts[2], parts.pixel_counts[3]);
  EXPECT_EQ(label_at(joined, table.place(0, 0.11, 0)), 3);
  EXPECT_EQ(label_at(joined, table.place(0, 0.05, -0.09)), kTop);

  parts.lies_on = {0, 0, kTop, kTop};
  EXPECT_EQ(join_sides(parts, depth_m, kinect_intrinsics(), table.up(), {}).labels, parts.labels)
      << "what lies on something is no side";
}

TEST(JoinSides, TheLowerLabelStays) {
  Table const table = lidded_box();
  Grid<float> const depth_m = table.depth_m(false);
  // The side is first, the table in between.
  Segments const parts =
      labelled(table, depth_m, [](Vector3d const& at) { return part_of_box(at) % 3 + 1; });
  ASSERT_EQ(label_at(parts, table.place(0, 0.05, -0.09)), 1);
  Segments const joined = join_sides(parts, depth_m, kinect_intrinsics(), table.up(), {});
  EXPECT_EQ(label_at(joined, table.place(0, 0.05, -0.09)), 1);
  EXPECT_EQ(label_at(joined, table.place(0, 0.11, 0)), 1);
  EXPECT_EQ(label_at(joined, table.place(0.2, 0, 0)), 2);
}

TEST(JoinSides, NothingIsNoError) {
  Segments const joined = join_sides({}, {}, {}, Vector3d(0, -1, 0), {});
  EXPECT_TRUE(joined.labels.empty());
  EXPECT_THAT(joined.pixel_counts, IsEmpty());
  Segments invalid;
  invalid.labels = Grid<std::int32_t>(4, 3, 0);
  EXPECT_EQ(join_sides(invalid, Grid<float>(4, 3, 0.0F), {}, Vector3d(0, -1, 0), {}).labels,
            invalid.labels);
}

}  // namespace
}  // namespace credo
