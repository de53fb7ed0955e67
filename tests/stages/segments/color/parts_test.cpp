#include "stages/segments/color/parts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <random>

#include "stages/segments/table.hpp"
#include "stages/segments/things.hpp"

namespace credo {
namespace {

using test::label_at;
using test::Table;

constexpr Rgb kWood = {165, 130, 100};
constexpr Rgb kRed = {180, 70, 60};
constexpr Rgb kBlue = {60, 100, 170};
constexpr Rgb kGreen = {70, 150, 80};

/// A colour for each place: right, up and ahead of the table's middle.
using Paint = std::function<Rgb(double right, double up, double ahead)>;

Rgb times(Rgb color, double light) {
  for (std::uint8_t& channel : color) {
    channel = static_cast<std::uint8_t>(std::min(255.0, channel * light));
  }
  return color;
}

/// What a camera sees of the painted table, its noise (5 of 255) included.
Grid<Rgb> painted(Table const& table, Paint const& paint) {
  Grid<float> const depth_m = table.depth_m(false);
  CameraIntrinsics const camera = test::kinect_intrinsics();
  Eigen::Vector3d const middle = table.place(0, 0, 0);
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 5.0);
  Grid<Rgb> color(depth_m.width(), depth_m.height());
  for (std::size_t i = 0; i < color.size(); ++i) {
    auto const [u, v] = color.pixel(i);
    auto const z = static_cast<double>(depth_m[i]);
    Eigen::Vector3d const p = Eigen::Vector3d((u - camera.cx_px) / camera.fx_px * z,
                                              (v - camera.cy_px) / camera.fy_px * z, z) -
                              middle;
    color[i] = paint(p.dot(table.place(1, 0, 0) - middle), p.dot(table.place(0, 1, 0) - middle),
                     p.dot(table.place(0, 0, 1) - middle));
    for (std::uint8_t& channel : color[i]) {
      channel = static_cast<std::uint8_t>(std::clamp(channel + noise(random), 0.0, 255.0));
    }
  }
  return color;
}

Segments parts(Table const& table, Grid<Rgb> const& color, SegmentsConfig const& config = {}) {
  Grid<float> const depth_m = table.depth_m(true);
  double const focal_px = test::kinect_intrinsics().fx_px;
  return split_by_color(convex_segments(depth_m, focal_px, config), depth_m, color, focal_px,
                        config);
}

/// Wood, and `thing` above it.
Paint on_wood(Paint const& thing) {
  return [thing](double right, double up, double ahead) {
    return up < 0.003 ? kWood : thing(right, up, ahead);
  };
}

Paint red_and_blue() {
  return on_wood([](double right, double, double) { return right < 0.0 ? kRed : kBlue; });
}

/// Its front and its top are seen: 24 cm wide, 16 cm high, 10 cm deep.
Table one_box(double distance_m = 1.0) {
  Table table(distance_m);
  table.add_box(0.0, 0.0, 0.0, {0.12, 0.08, 0.05});
  return table;
}

/// How many segments the box of `one_box` is in a picture that is painted so.
std::size_t pieces_of_box(Paint const& paint, double distance_m = 1.0) {
  Table const table = one_box(distance_m);
  Segments const whole = parts(table, {});
  Segments const split = parts(table, painted(table, paint));
  return 1 + split.pixel_counts.size() - whole.pixel_counts.size();
}

void expect_numbered(Segments const& segments) {
  std::vector<std::uint32_t> counts;
  for (std::int32_t const label : segments.labels) {
    if (label > 0) {
      ASSERT_LE(static_cast<std::size_t>(label), counts.size() + 1) << "not in raster order";
      counts.resize(std::max(counts.size(), static_cast<std::size_t>(label)), 0);
      ++counts[static_cast<std::size_t>(label - 1)];
    }
  }
  EXPECT_EQ(counts, segments.pixel_counts);
}

TEST(ColorParts, FlushBoxesAreTwoThings) {
  for (double const distance_m : {0.7, 1.0, 1.6}) {
    SCOPED_TRACE(distance_m);
    Table const table = one_box(distance_m);
    Segments const whole = parts(table, {});
    Segments const split = parts(table, painted(table, red_and_blue()));
    EXPECT_EQ(split.pixel_counts.size(), whole.pixel_counts.size() + 1);
    for (double const up : {0.03, 0.13}) {
      std::int32_t const left = label_at(split, table.place(-0.01, up, -0.05));
      std::int32_t const right = label_at(split, table.place(0.01, up, -0.05));
      EXPECT_NE(left, right) << up;
      EXPECT_EQ(left, label_at(split, table.place(-0.1, up, -0.05)));
      EXPECT_EQ(right, label_at(split, table.place(0.1, up, -0.05)));
    }
    // The cut goes on over the top.
    EXPECT_EQ(label_at(split, table.place(-0.01, 0.16, 0.0)),
              label_at(split, table.place(-0.01, 0.1, -0.05)));
    EXPECT_NE(label_at(split, table.place(-0.01, 0.16, 0.0)),
              label_at(split, table.place(0.01, 0.16, 0.0)));
    expect_numbered(split);
  }
}

TEST(ColorParts, FlushBoxesOfTwoHeightsAreTwoThings) {
  Table table(1.0);
  table.add_box(-0.06, 0.0, 0.0, {0.06, 0.08, 0.05});
  table.add_box(0.05, 0.0, 0.0, {0.05, 0.05, 0.05});
  Segments const split = parts(table, painted(table, red_and_blue()));
  EXPECT_NE(label_at(split, table.place(-0.01, 0.05, -0.05)),
            label_at(split, table.place(0.01, 0.05, -0.05)));
}

TEST(ColorParts, OneOfThreeColoursAfterTheOther) {
  EXPECT_EQ(pieces_of_box(on_wood([](double right, double, double) {
              return right < -0.04 ? kRed : right < 0.04 ? kBlue : kGreen;
            })),
            3U);
}

TEST(ColorParts, PlainThingsAreOne) {
  EXPECT_EQ(pieces_of_box(on_wood([](double, double, double) { return kRed; })), 1U);
}

TEST(ColorParts, PrintsWithinAFaceCutNothing) {
  // Inside, at one edge, at a corner, and a stripe from edge to edge.
  EXPECT_EQ(pieces_of_box(on_wood([](double right, double up, double) {
              return std::abs(right) < 0.06 && std::abs(up - 0.08) < 0.05 ? kBlue : kRed;
            })),
            1U);
  EXPECT_EQ(pieces_of_box(on_wood([](double right, double up, double) {
              return right < 0.0 && std::abs(up - 0.08) < 0.04 ? kBlue : kRed;
            })),
            1U);
  EXPECT_EQ(pieces_of_box(on_wood([](double right, double up, double) {
              return right < 0.0 && up < 0.09 ? kBlue : kRed;
            })),
            1U);
  EXPECT_EQ(pieces_of_box(on_wood([](double right, double, double) {
              return std::abs(right) < 0.05 ? kBlue : kRed;
            })),
            1U);
}

TEST(ColorParts, PatternsCutNothing) {
  auto const odd = [](double a, double size) {
    return (static_cast<int>(std::floor(a / size)) & 1) != 0;
  };
  for (double const size_m : {0.01, 0.03}) {
    SCOPED_TRACE(size_m);
    EXPECT_EQ(pieces_of_box(on_wood(
                  [&](double right, double, double) { return odd(right, size_m) ? kBlue : kRed; })),
              1U);
    EXPECT_EQ(pieces_of_box(on_wood([&](double right, double up, double ahead) {
                return odd(right, size_m) != odd(up - ahead, size_m) ? kBlue : kRed;
              })),
              1U);
  }
}

TEST(ColorParts, ManyColouredHalvesCutNothing) {
  // One half is printed with blotches of all colours.
  EXPECT_EQ(pieces_of_box(on_wood([](double right, double up, double ahead) {
              double const wave = std::sin(260.0 * right) * std::sin(260.0 * (up - ahead));
              Rgb const blotch = wave > 0.4 ? kGreen : wave < -0.4 ? Rgb{200, 190, 60} : kBlue;
              return right < 0.0 ? kRed : blotch;
            })),
            1U);
}

TEST(ColorParts, FacesOfOneBoxCutNothing) {
  EXPECT_EQ(
      pieces_of_box(on_wood([](double, double up, double) { return up > 0.155 ? kBlue : kRed; })),
      1U);
}

TEST(ColorParts, LightAndShadeCutNothing) {
  EXPECT_EQ(pieces_of_box(on_wood(
                [](double right, double, double) { return times(kRed, right < 0.0 ? 1.2 : 0.5); })),
            1U);
  EXPECT_EQ(pieces_of_box(on_wood(
                [](double right, double, double) { return times(kRed, 0.8 + 3.0 * right); })),
            1U);
  // A highlight.
  EXPECT_EQ(pieces_of_box(on_wood([](double right, double up, double) {
              return std::hypot(right - 0.03, up - 0.08) < 0.04 ? Rgb{255, 255, 255} : kRed;
            })),
            1U);
}

TEST(ColorParts, DarkAndGreyCutNothing) {
  EXPECT_EQ(pieces_of_box(on_wood([](double right, double, double) {
              return right < 0.0 ? Rgb{26, 8, 8} : Rgb{8, 8, 26};
            })),
            1U);
  EXPECT_EQ(pieces_of_box(on_wood([](double right, double, double) {
              return right < 0.0 ? Rgb{70, 70, 70} : Rgb{210, 210, 210};
            })),
            1U);
}

TEST(ColorParts, ColoursThatAreHardlyApartCutNothing) {
  Paint const alike = on_wood([](double right, double, double) {
    return right < 0.0 ? kRed : Rgb{180, 90, 60};
  });
  EXPECT_EQ(pieces_of_box(alike), 1U);
  Table const table = one_box();
  SegmentsConfig config;
  config.color_apart = 0.03;
  EXPECT_EQ(parts(table, painted(table, alike), config).pixel_counts.size(),
            parts(table, {}).pixel_counts.size() + 1);
}

TEST(ColorParts, ASmallThingBesideALargeOne) {
  EXPECT_EQ(pieces_of_box(
                on_wood([](double right, double, double) { return right < -0.07 ? kRed : kBlue; })),
            2U);
}

TEST(ColorParts, TheCutIsAPlaneInSpace) {
  // Over the front, up, and over the top, aside.
  constexpr double kYaw_rad = 0.7;
  auto const across = [](double right, double ahead) {
    return right * std::cos(kYaw_rad) + ahead * std::sin(kYaw_rad);
  };
  for (double const yaw_rad : {-kYaw_rad, kYaw_rad}) {
    double const mirror = yaw_rad < 0.0 ? 1.0 : -1.0;
    Table table(0.9);
    table.add_box(0.0, 0.0, yaw_rad, {0.1, 0.05, 0.1});
    Paint const paint = on_wood([&](double right, double, double ahead) {
      return across(mirror * right, ahead) < 0.0 ? kRed : kBlue;
    });
    Segments const split = parts(table, painted(table, paint));
    Grid<Rgb> const color = painted(table, paint);
    std::int32_t const red = label_at(split, table.place(-0.03 * mirror, 0.1, -0.03));
    std::int32_t const blue = label_at(split, table.place(0.03 * mirror, 0.1, 0.03));
    ASSERT_NE(red, blue);
    std::size_t wrong = 0;
    std::size_t pixels = 0;
    for (std::size_t i = 0; i < color.size(); ++i) {
      if (split.labels[i] == red || split.labels[i] == blue) {
        ++pixels;
        bool const is_red = color[i][0] > color[i][2] + 60;
        bool const is_blue = color[i][2] > color[i][0] + 60;
        wrong += (is_red && split.labels[i] == blue) || (is_blue && split.labels[i] == red) ? 1 : 0;
      }
    }
    EXPECT_LT(wrong, pixels / 50) << pixels;
  }
}

TEST(ColorParts, AStripAlongAnEdgeCutsNothing) {
  Table table(0.7);
  table.add_box(0.0, 0.0, 0.0, {0.04, 0.08, 0.05});
  Grid<Rgb> const color = painted(
      table, on_wood([](double right, double, double) { return right < -0.028 ? kRed : kBlue; }));
  EXPECT_EQ(parts(table, color).pixel_counts, parts(table, {}).pixel_counts);
}

TEST(ColorParts, SmallSidesAreLeft) {
  EXPECT_EQ(
      pieces_of_box(
          on_wood([](double right, double, double) { return right < -0.09 ? kRed : kBlue; }), 2.2),
      1U);
  EXPECT_EQ(pieces_of_box(on_wood(
                [](double right, double, double) { return right < -0.112 ? kRed : kBlue; })),
            1U);
}

TEST(ColorParts, FurnitureIsLeft) {
  // 0.9 by 0.8 m, 3 m away: as many pixels as the box that comes apart.
  Table table(3.0);
  table.add_box(0.0, 0.0, 0.0, {0.45, 0.4, 0.1});
  EXPECT_EQ(parts(table, painted(table, red_and_blue())).pixel_counts,
            parts(table, {}).pixel_counts);
  // The table itself.
  Table const bare(1.0);
  EXPECT_EQ(parts(bare, painted(bare, [](double right, double,
                                         double) { return right < 0.0 ? kRed : kBlue; }))
                .pixel_counts.size(),
            1U);
}

TEST(ColorParts, WithoutColourNothingHappens) {
  Table const table = one_box();
  Segments const whole = parts(table, {});
  EXPECT_TRUE(parts(table, Grid<Rgb>(320, 240, kRed)).labels == whole.labels);
  SegmentsConfig off;
  off.color_apart = 0.0;
  Segments const untouched = parts(table, painted(table, red_and_blue()), off);
  EXPECT_TRUE(untouched.labels == whole.labels);
  EXPECT_EQ(untouched.pixel_counts, whole.pixel_counts);
}

TEST(ColorParts, ImagesOfNothing) {
  for (auto const [width, height] : {Pixel{0, 0}, Pixel{1, 1}, Pixel{3, 200}, Pixel{64, 48}}) {
    Grid<float> const depth_m(width, height, std::numeric_limits<float>::quiet_NaN());
    Grid<Rgb> const color(width, height, kRed);
    Segments const split =
        split_by_color(convex_segments(depth_m, 525.0, {}), depth_m, color, 525.0, {});
    EXPECT_TRUE(split.labels.same_size(depth_m));
    EXPECT_TRUE(split.pixel_counts.empty());
  }
}

TEST(ColorParts, CountOnlyWhereColourIsRegistered) {
  Table const table = one_box();
  Frame frame;
  frame.intrinsics = test::kinect_intrinsics();
  frame.cloud_camera = cloud_from_depth(table.depth_m(true), frame.intrinsics);
  Segments const by_depth = segment_things(frame, table.up(), {});
  frame.color = painted(table, red_and_blue());
  EXPECT_TRUE(segment_things(frame, table.up(), {}).labels == by_depth.labels);
  frame.color_registered = true;
  EXPECT_EQ(segment_things(frame, table.up(), {}).pixel_counts.size(),
            by_depth.pixel_counts.size() + 1);
}

}  // namespace
}  // namespace credo
