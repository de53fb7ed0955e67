#include "figure.hpp"

#include <array>
#include <cstdint>
#include <functional>

#include "io/belief_painter.hpp"
#include "io/canvas.hpp"
#include "io/palette.hpp"

namespace credo {
namespace {

constexpr int kWidth = 400;
constexpr int kHeight = 300;
constexpr int kGap = 4;
// Drawn so much larger and then averaged, for smooth points and lines.
constexpr int kFiner = 2;
constexpr int kPointPx = 2;
constexpr Rgb kWhite = {255, 255, 255};

/// Rows of five pixels, the leftmost the highest bit.
using Glyph = std::array<std::uint8_t, 9>;
constexpr Glyph kOpen = {2, 4, 8, 8, 8, 8, 8, 4, 2};
constexpr Glyph kClose = {8, 4, 2, 2, 2, 2, 2, 4, 8};
constexpr std::array<Glyph, 6> kLetters = {{{0, 0, 0, 14, 1, 15, 17, 15, 0},
                                            {16, 16, 16, 30, 17, 17, 17, 30, 0},
                                            {0, 0, 0, 15, 16, 16, 16, 15, 0},
                                            {1, 1, 1, 15, 17, 17, 17, 15, 0},
                                            {0, 0, 0, 14, 17, 31, 16, 15, 0},
                                            {6, 8, 8, 28, 8, 8, 8, 8, 0}}};

void write_glyph(Glyph const& glyph, Panel const& panel, int left, Canvas& canvas) {
  for (int y = 0; y < 18; ++y) {
    for (int x = 0; x < 10; ++x) {
      if ((glyph.at(static_cast<std::size_t>(y / 2)) >> (4 - x / 2) & 1) != 0) {
        canvas.set(panel, left + x, 8 + y, kWhite);
      }
    }
  }
}

/// Behind a panel's letter.
void darken_corner(Panel const& panel, Canvas& canvas) {
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 46; ++x) {
      canvas.set(panel, x, y, kBackground);
    }
  }
}

/// The mean of so many of the image's pixels as fall on each.
Grid<Rgb> shrunk(Grid<Rgb> const& image, int width, int height) {
  constexpr int kSamples = 4;
  Grid<Rgb> small(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      std::array<int, 3> sum = {0, 0, 0};
      for (int k = 0; k < kSamples * kSamples; ++k) {
        int const u = (x * kSamples + k % kSamples) * image.width() / (width * kSamples);
        int const v = (y * kSamples + k / kSamples) * image.height() / (height * kSamples);
        for (std::size_t c = 0; c < 3; ++c) {
          sum.at(c) += image[Pixel{u, v}].at(c);
        }
      }
      for (std::size_t c = 0; c < 3; ++c) {
        small[Pixel{x, y}].at(c) = static_cast<std::uint8_t>((sum.at(c) + kSamples * kSamples / 2) /
                                                             (kSamples * kSamples));
      }
    }
  }
  return small;
}

Grid<Rgb> painted(SceneRun const& run, double zoom,
                  std::function<void(BeliefPainter&)> const& paint) {
  Panel const panel{0, 0, kFiner * kWidth, kFiner * kHeight};
  Canvas canvas(panel.width, panel.height, kBackground);
  Se3 const& eye = run.looks.front().belief->T_world_camera;
  View view = oblique_view(eye, panel);
  view.scale *= zoom;
  BeliefPainter painter(view, canvas, run.outlines, kPointPx);
  painter.metre_grid(eye.translation());
  paint(painter);
  return shrunk(canvas.take(), kWidth, kHeight);
}

/// The thesis' colours: the box magenta, the table blue, whichever the belief tells first.
Rgb color_of_type(std::string const& type, double probability) {
  return object_color(type == "table" ? 1 : 0, probability);
}

}  // namespace

Grid<Rgb> color_panel(SceneLook const& look) {
  return shrunk(look.frame->color, kWidth, kHeight);
}

Grid<Rgb> cloud_panel(SceneRun const& run, double zoom) {
  SceneLook const& shown = run.looks.front();
  return painted(run, zoom, [&](BeliefPainter& painter) {
    painter.cloud_in_color(*shown.frame, shown.belief->T_world_camera);
  });
}

Grid<Rgb> segmentation_panel(SceneRun const& run, double zoom) {
  SceneLook const& shown = run.looks.front();
  return painted(run, zoom, [&](BeliefPainter& painter) {
    painter.segmentation(*shown.frame, shown.segmentation->labels, *shown.belief);
    for (ObjectObservation const& object : shown.segmentation->objects) {
      painter.outline(object.type, object.pose_world.mean, color_of_type(object.type, 1.0), 1.0);
    }
  });
}

Grid<Rgb> belief_panel(SceneRun const& run, std::size_t look, double zoom) {
  SceneLook const& shown = run.looks.at(look);
  return painted(run, zoom, [&](BeliefPainter& painter) {
    painter.cloud(*shown.frame, shown.segmentation->labels, shown.belief->T_world_camera);
    painter.surroundings(*shown.belief);
    for (ObjectBelief const& object : shown.belief->objects) {
      painter.outline(object.type, object.pose_world.mean,
                      color_of_type(object.type, probability_of(object.log_odds)), 1.0);
    }
    painter.camera(shown.belief->T_world_camera);
  });
}

Grid<Rgb> mounted(std::vector<Grid<Rgb>> const& panels, int columns) {
  int const count = static_cast<int>(panels.size());
  int const rows = (count + columns - 1) / columns;
  Canvas canvas(columns * (kWidth + kGap) - kGap, rows * (kHeight + kGap) - kGap, kWhite);
  for (int i = 0; i < count; ++i) {
    Panel const panel{i % columns * (kWidth + kGap), i / columns * (kHeight + kGap), kWidth,
                      kHeight};
    Grid<Rgb> const& image = panels[static_cast<std::size_t>(i)];
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        canvas.set(panel, x, y, image[Pixel{x, y}]);
      }
    }
    darken_corner(panel, canvas);
    write_glyph(kOpen, panel, 8, canvas);
    write_glyph(kLetters.at(static_cast<std::size_t>(i)), panel, 18, canvas);
    write_glyph(kClose, panel, 28, canvas);
  }
  return canvas.take();
}

}  // namespace credo
