#include "stages/segments/parts/thing_parts.hpp"

#include <gmock/gmock.h>

#include <optional>

#include "stages/segments/parts/outlines.hpp"
#include "stages/segments/schematic.hpp"
#include "stages/segments/table.hpp"

namespace credo {
namespace {

using Eigen::Vector3d;
using test::flat_inside;
using test::front;
using test::hollow;
using test::hollow_inside;
using test::kinect_intrinsics;
using test::label_at;
using test::Schematic;
using test::Table;
using test::vessel;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

Segments parts_of(Table const& table, bool noisy) {
  return convex_segments(table.depth_m(noisy), kinect_intrinsics().fx_px, {});
}
Segments things_of(Table const& table, bool noisy, std::optional<Vector3d> const& up) {
  Grid<float> const depth_m = table.depth_m(noisy);
  return join_parts(convex_segments(depth_m, kinect_intrinsics().fx_px, {}), depth_m,
                    kinect_intrinsics(), up, {});
}

TEST(JoinParts, ACartonsInsideAndOutsideAreOneThing) {
  Table table(0.9);
  table.add_carton(0.0, 0.0, 0.2, 0.14);
  Vector3d const front = table.place(0, 0.07, -0.14);
  Segments const parts = parts_of(table, false);
  Segments const things = things_of(table, false, std::nullopt);
  for (double const side : {-1.0, 1.0}) {
    Vector3d const inside = table.place(side * 0.06, 0.11, 0.07);
    EXPECT_NE(label_at(parts, front), label_at(parts, inside)) << side;
    EXPECT_EQ(label_at(things, front), label_at(things, inside)) << side;
  }
  EXPECT_NE(label_at(things, front), label_at(things, table.place(0.25, 0, 0)));
}

TEST(JoinParts, AThingInACartonStaysApart) {
  Table table(0.9);
  table.add_carton(0.0, 0.0, 0.22, 0.12);
  table.add_ball(0.0, 0.07, 0.03);
  Segments const things = things_of(table, false, std::nullopt);
  std::int32_t const carton = label_at(things, table.place(0, 0.06, -0.155));
  EXPECT_EQ(carton, label_at(things, table.place(0.06, 0.11, 0.09)));
  EXPECT_NE(carton, label_at(things, table.place(0, 0.06, 0.07)));
}

TEST(JoinParts, WhatStandsBehindSomethingStaysApart) {
  // Its foot is hidden; it is not hollow.
  Table table(1.0);
  table.add_box(0.0, 0.0, 0.0, {0.1, 0.06, 0.04});
  table.add_box(0.0, 0.12, 0.0, {0.06, 0.08, 0.04});
  for (auto const& up : {std::optional<Vector3d>(), std::optional(table.up())}) {
    Segments const things = things_of(table, false, up);
    EXPECT_NE(label_at(things, table.place(0, 0.06, -0.04)),
              label_at(things, table.place(0, 0.155, 0.08)));
  }
}

TEST(JoinParts, AHandleIsAPartWhereItIsKnownWhatIsLevel) {
  for (bool const noisy : {false, true}) {
    Table table(0.9);
    table.add_box(0.0, 0.0, 0.0, {0.1, 0.1, 0.1});
    table.add_box_at({0.125, 0.12, -0.06}, 0.0, {0.027, 0.02, 0.03});
    Vector3d const body = table.place(0, 0.1, -0.1);
    Vector3d const handle = table.place(0.13, 0.12, -0.09);
    Segments const parts = things_of(table, noisy, std::nullopt);
    EXPECT_NE(label_at(parts, body), label_at(parts, handle)) << noisy;
    Segments const things = things_of(table, noisy, table.up());
    EXPECT_EQ(label_at(things, body), label_at(things, handle)) << noisy;
    EXPECT_NE(label_at(things, body), label_at(things, table.place(0.25, 0, -0.1))) << noisy;
  }
}

TEST(JoinParts, WhatStandsOnAThingIsNoPartOfIt) {
  for (bool const noisy : {false, true}) {
    Table table(0.9);
    table.add_box(0.0, 0.0, 0.0, {0.12, 0.06, 0.12});
    table.add_box_at({0.0, 0.15, 0.09}, 0.0, {0.03, 0.03, 0.03});
    Segments const things = things_of(table, noisy, table.up());
    EXPECT_NE(label_at(things, table.place(0, 0.12, -0.05)),
              label_at(things, table.place(0, 0.16, 0.06)))
        << noisy;
  }
}

TEST(JoinParts, WhatTheImageCutsOffIsNoPart) {
  // A plate before a wall, from the image's border.
  Grid<float> depth_m(200, 150, 1.2F);
  for (int const first_u : {0, 60}) {
    Segments segments;
    segments.labels = Grid<std::int32_t>(200, 150, 1);
    for (int v = 40; v < 80; ++v) {
      for (int u = first_u; u < first_u + 40; ++u) {
        segments.labels[Pixel{u, v}] = 2;
      }
    }
    // A third thing, far behind, so that the plate sticks out.
    for (int v = 40; v < 80; ++v) {
      for (int u = first_u + 40; u < 130; ++u) {
        segments.labels[Pixel{u, v}] = 3;
        depth_m[Pixel{u, v}] = 3.0F;
      }
    }
    std::uint32_t const third = static_cast<std::uint32_t>(40 * (130 - first_u - 40));
    segments.pixel_counts = {200 * 150 - 1600 - third, 1600, third};
    Segments const joined =
        join_parts(segments, depth_m, {525.0, 525.0, 99.5, 74.5}, Vector3d(0, -1, 0), {});
    Pixel const plate{first_u + 20, 60};
    EXPECT_EQ(joined.labels[plate], first_u == 0 ? 2 : 1) << first_u;
    depth_m = Grid<float>(200, 150, 1.2F);
  }
}

TEST(JoinParts, AnInsideIsHollowNotTooLargeAndBehindNothingElse) {
  EXPECT_TRUE(vessel(hollow_inside).joins(std::nullopt));
  EXPECT_FALSE(vessel(flat_inside).joins(std::nullopt)) << "a box behind the front";
  EXPECT_FALSE(vessel(hollow_inside, 4).joins(std::nullopt)) << "more than four times its front";
  Schematic behind_another = vessel(hollow_inside);
  behind_another.add({50, 45}, {70, 70}, [](Pixel) { return 0.8; });
  EXPECT_FALSE(behind_another.joins(std::nullopt)) << "something else hides a part of it";
}

// Beneath a table the floor goes on to the border, and the table does not.
TEST(JoinParts, AnInsideIsNotCutOffBesideItsOutside) {
  struct Case {
    char const* name;
    Pixel first;
    Pixel last;
    Pixel front_first;
    Pixel front_last;
    bool joins;
  };
  // The image is 200 by 150.
  for (Case const& c : {
           Case{"left, both", {0, 50}, {80, 70}, {0, 70}, {80, 100}, true},
           Case{"left, one", {0, 50}, {80, 70}, {20, 70}, {100, 100}, false},
           Case{"right, both", {120, 50}, {200, 70}, {120, 70}, {200, 100}, true},
           Case{"right, one", {120, 50}, {200, 70}, {100, 70}, {180, 100}, false},
           Case{"bottom, both", {60, 100}, {140, 150}, {10, 110}, {60, 150}, true},
           Case{"bottom, one", {60, 100}, {140, 150}, {10, 110}, {60, 149}, false},
           Case{"top, where its outside is not", {60, 0}, {140, 20}, {60, 20}, {140, 50}, true},
       }) {
    Schematic picture;
    picture.add(c.front_first, c.front_last, [](Pixel) { return 0.93; });
    double const middle_u = (c.first.u + c.last.u) / 2.0;
    picture.add(c.first, c.last, [&](Pixel p) { return hollow(p.u - middle_u, 1.05); });
    EXPECT_EQ(picture.joins(std::nullopt), c.joins) << c.name;
  }
}

// What something near hides the foot of has nothing else before it either.
TEST(JoinParts, AnInsideIsNotFartherBehindItsOutsideThanBothAreLarge) {
  // 63 pixels are 12 cm at 1 m.
  for (auto const& [deepest_m, joins] : {std::pair(1.12, true), std::pair(1.25, false)}) {
    Schematic picture;
    picture.add({60, 70}, {140, 100}, front);
    picture.add({60, 50}, {140, 70}, [&, d = deepest_m](Pixel p) { return hollow(p.u - 99.5, d); });
    EXPECT_EQ(picture.joins(std::nullopt), joins) << deepest_m;
  }
}

TEST(JoinParts, AnAttachmentIsSmallAndTouchesWhereItMeets) {
  Vector3d const up(0, -1, 0);
  auto const body_with = [](Pixel last, auto const& handle_m) {
    Schematic picture;
    picture.add({60, 70}, {140, 100}, front);
    picture.add({140, 74}, last, handle_m);
    return picture;
  };
  EXPECT_TRUE(body_with({152, 92}, front).joins(up));
  EXPECT_FALSE(body_with({180, 92}, front).joins(up)) << "more than a quarter of it";
  EXPECT_FALSE(body_with({152, 92}, [](Pixel p) { return p.v < 86 ? 0.9 : 1.0; }).joins(up))
      << "in front of it, but for a corner";
}

TEST(JoinParts, TheResultIsNumberedInRasterOrder) {
  Table table(0.9);
  table.add_carton(0.0, 0.0, 0.2, 0.14);
  table.add_box(-0.25, 0.0, 0.3, {0.05, 0.05, 0.05});
  Segments const things = things_of(table, true, table.up());
  std::vector<std::uint32_t> counts(things.pixel_counts.size(), 0);
  std::int32_t highest = 0;
  for (std::int32_t const label : things.labels) {
    ASSERT_LE(label, highest + 1);
    highest = std::max(highest, label);
    if (label > 0) {
      ++counts[static_cast<std::size_t>(label - 1)];
    }
  }
  EXPECT_EQ(counts, things.pixel_counts);
}

TEST(JoinParts, NothingIsNoError) {
  Segments const joined = join_parts({}, {}, {}, std::nullopt, {});
  EXPECT_TRUE(joined.labels.empty());
  EXPECT_THAT(joined.pixel_counts, IsEmpty());
  Segments invalid;
  invalid.labels = Grid<std::int32_t>(4, 3, 0);
  EXPECT_EQ(join_parts(invalid, Grid<float>(4, 3, 0.0F), {}, Vector3d(0, -1, 0), {}).labels,
            invalid.labels);
}

namespace outlines {

using segments::LabelledRows;
using segments::Meeting;
using segments::Outline;

/// Every pair of neighbours, one by one.
std::map<std::pair<std::int32_t, std::int32_t>, std::array<std::uint32_t, 3>> literal_meetings(
    Segments const& segments, Grid<float> const& depth_m, float link_per_m) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::array<std::uint32_t, 3>> result;
  for (int v = 0; v < depth_m.height(); ++v) {
    for (int u = 0; u < depth_m.width(); ++u) {
      for (Pixel const q : {Pixel{u + 1, v}, Pixel{u - 1, v}, Pixel{u, v + 1}, Pixel{u, v - 1}}) {
        Pixel const p{u, v};
        if (!depth_m.contains(q) || segments.labels[p] == 0 || segments.labels[q] == 0 ||
            segments.labels[p] == segments.labels[q]) {
          continue;
        }
        float const nearer = 1.0F / depth_m[p] - 1.0F / depth_m[q];
        std::size_t const kind = std::abs(nearer) < link_per_m ? 0 : nearer > 0.0F ? 1 : 2;
        ++result[{segments.labels[p], segments.labels[q]}][kind];
      }
    }
  }
  return result;
}

TEST(Outlines, AreThePairsOfNeighbours) {
  Table table(0.9);
  table.add_carton(0.0, 0.0, 0.2, 0.14);
  table.add_box(-0.25, 0.0, 0.3, {0.05, 0.05, 0.05});
  Grid<float> const depth_m = table.depth_m(true);
  constexpr float kLink_per_m = 0.026F;
  Segments const segments = convex_segments(depth_m, kinect_intrinsics().fx_px, {});
  std::vector<Outline> const outlines =
      segments::outlines_of(segments, LabelledRows(segments.labels), depth_m, kLink_per_m);
  decltype(literal_meetings(segments, depth_m, kLink_per_m)) found;
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    for (auto const& [other, meeting] : outlines[i].meetings) {
      found[{static_cast<std::int32_t>(i), other}] = {meeting.touching, meeting.before,
                                                      meeting.behind};
    }
  }
  EXPECT_GT(found.size(), 4U);
  EXPECT_EQ(found, literal_meetings(segments, depth_m, kLink_per_m));
}

TEST(Outlines, OfJoinedSegmentsAreThoseOfTheirUnion) {
  Segments segments;
  // 1 2
  // 3 3
  segments.labels = Grid<std::int32_t>(2, 2, std::vector<std::int32_t>{1, 2, 3, 3});
  segments.pixel_counts = {1, 1, 2};
  Grid<float> const depth_m(2, 2, std::vector<float>{1.0F, 2.0F, 1.0F, 1.0F});
  std::vector<Outline> outlines =
      segments::outlines_of(segments, LabelledRows(segments.labels), depth_m, 0.1F);
  EXPECT_EQ(outlines[1].meetings.at(2).before, 1U);
  EXPECT_EQ(outlines[2].meetings.at(3).behind, 1U);
  segments::join_outlines(outlines, 1, 3);
  EXPECT_EQ(outlines[1].pixels, 3U);
  EXPECT_EQ(outlines[1].meetings.size(), 1U);
  EXPECT_EQ(outlines[1].meetings.at(2).before, 2U);
  EXPECT_EQ(outlines[2].meetings.at(1).behind, 2U);
  EXPECT_THAT(outlines[3].meetings, IsEmpty());
  Pixel const last{1, 1};
  EXPECT_EQ(outlines[1].box.last, last);
}

}  // namespace outlines
}  // namespace
}  // namespace credo
