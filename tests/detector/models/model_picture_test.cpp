#include "detector/models/model_picture.hpp"

#include <gtest/gtest.h>

#include "detector/views.hpp"
#include "geometry/shapes/model_mesh.hpp"
#include "io/palette.hpp"

namespace credo::test {
namespace {

/// A triangle about the middle of the y-z plane, seen from its outside from +x.
TriangleMesh sail() {
  TriangleMesh mesh;
  mesh.vertices = {{0, -0.1F, -0.1F}, {0, 0.1F, -0.1F}, {0, 0, 0.1F}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

Rgb middle_of(Grid<Rgb> const& picture, int column, int row) {
  return picture[Pixel{column * picture.width() / 3 + picture.width() / 6,
                       row * picture.height() / 2 + picture.height() / 4}];
}

TEST(ModelPicture, TheInsideIsRed) {
  Grid<Rgb> const picture = draw_model(sail());
  Rgb const outside = middle_of(picture, 0, 0);
  Rgb const inside = middle_of(picture, 0, 1);
  EXPECT_LT(outside[0] - outside[2], 20) << "grey";
  EXPECT_GT(outside[0], 200);
  EXPECT_GT(inside[0], inside[2] + 80) << "red";
  EXPECT_EQ(middle_of(picture, 1, 0), kBackground) << "from its edge it is nothing";
}

TEST(ModelPicture, UpIsUp) {
  // Its tip is at +z: the sail's row below the middle is wider than the one above.
  Grid<Rgb> const picture = draw_model(sail());
  int const panel = picture.width() / 3;
  auto const width_at = [&](int v) {
    int width = 0;
    for (int u = 0; u < panel; ++u) {
      width += picture[Pixel{u, v}] != kBackground ? 1 : 0;
    }
    return width;
  };
  EXPECT_GT(width_at(panel * 5 / 8), width_at(panel * 3 / 8) + 20);
}

TEST(ModelPicture, EachPanelShowsItsSide) {
  // Of the bracket the post stands at -x, so that it is on the right as seen from +y.
  Grid<Rgb> const picture = draw_model(mesh_of(bracket()));
  int const panel = picture.width() / 3;
  auto const shown = [&](int left, int right, int top, int bottom) {
    int pixels = 0;
    for (int v = top; v < bottom; ++v) {
      for (int u = left; u < right; ++u) {
        pixels += picture[Pixel{u, v}] != kBackground ? 1 : 0;
      }
    }
    return pixels;
  };
  EXPECT_GT(shown(panel * 3 / 2, panel * 2, 0, panel / 2),
            shown(panel, panel * 3 / 2, 0, panel / 2) + 500);
}

TEST(ModelPicture, WithoutTrianglesThereIsNone) {
  EXPECT_TRUE(draw_model({}).empty());
}

}  // namespace
}  // namespace credo::test
