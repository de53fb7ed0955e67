#include "io/pictures.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "io/belief_painter.hpp"
#include "io/canvas.hpp"

namespace credo {
namespace {

constexpr Rgb kBlack = {0, 0, 0};
constexpr Rgb kRefused = {255, 140, 0};

void draw_color(Frame const& frame, Panel const& panel, Canvas& canvas) {
  OrganizedCloud const& cloud = frame.cloud_camera;
  for (int y = 0; y < panel.height; ++y) {
    for (int x = 0; x < panel.width; ++x) {
      Pixel const p{x * cloud.width() / panel.width, y * cloud.height() / panel.height};
      canvas.set(panel, x, y, frame.color.empty() ? depth_grey(cloud.z[p]) : frame.color[p]);
    }
  }
}

/// Where a piece of stuff ends, so that two of one colour are seen to be two.
bool is_border(LabelMap const& labels, Pixel p, Pixel next) {
  LabelCode const a = labels[p];
  LabelCode const b = labels[next];
  return a != b && a != kNoDepth && b != kNoDepth && (is_stuff(a) || is_stuff(b));
}

void draw_labels(Frame const& frame, LabelMap const& labels, BeliefState const& belief,
                 Panel const& panel, Canvas& canvas) {
  std::map<LabelCode, Rgb> const known = colors_of_stuff(belief);
  auto const pixel = [&](int x, int y) {
    return Pixel{std::min(x, panel.width - 1) * labels.width() / panel.width,
                 std::min(y, panel.height - 1) * labels.height() / panel.height};
  };
  for (int y = 0; y < panel.height; ++y) {
    for (int x = 0; x < panel.width; ++x) {
      Pixel const p = pixel(x, y);
      auto const stuff = is_stuff(labels[p]) ? known.find(labels[p]) : known.end();
      Rgb const color = stuff != known.end() ? stuff->second : label_color(labels[p]);
      bool const has_depth = labels[p] != kNoDepth;
      bool const border =
          is_border(labels, p, pixel(x + 1, y)) || is_border(labels, p, pixel(x, y + 1));
      canvas.set(panel, x, y,
                 has_depth ? mixed(mixed(color, depth_grey(frame.cloud_camera.z[p]), 0.25), kBlack,
                                   border ? 0.6 : 0.0)
                           : kBlack);
    }
  }
}

/// Where objects are, over what the camera sees.
void draw_outlines(Segmentation const& segmentation, BeliefState const& belief, View const& view,
                   Outlines const& outlines, Canvas& canvas) {
  BeliefPainter painter(view, canvas, outlines);
  for (RefusedDetection const& refused : segmentation.refused) {
    painter.outline(refused.type, refused.pose_world.mean, kRefused, 1.0);
  }
  for (std::size_t i = 0; i < belief.objects.size(); ++i) {
    ObjectBelief const& object = belief.objects[i];
    bool const seen = object.evidence == Evidence::kSeen;
    painter.outline(object.type, object.pose_world.mean, object_color(i, 1.0), seen ? 1.0 : 0.4);
  }
}

}  // namespace

Grid<Rgb> draw_picture(Frame const& frame, Segmentation const& segmentation,
                       BeliefState const& belief, Outlines const& outlines) {
  int const width = frame.cloud_camera.width() / 2;
  int const height = frame.cloud_camera.height() / 2;
  Canvas canvas(2 * width + 4, 2 * height + 4, kBackground);
  if (width == 0 || height == 0) {
    return {};
  }
  Panel const top_left{0, 0, width, height};
  Panel const top_right{width + 4, 0, width, height};
  Panel const bottom_left{0, height + 4, width, height};
  Panel const bottom_right{width + 4, height + 4, width, height};
  draw_color(frame, top_left, canvas);
  draw_labels(frame, segmentation.labels, belief, top_right, canvas);
  Se3 const& camera = belief.T_world_camera;
  draw_outlines(segmentation, belief,
                camera_view(camera, frame.intrinsics, frame.cloud_camera.width(), top_left),
                outlines, canvas);
  for (View const& view : {oblique_view(camera, bottom_left), map_view(camera, bottom_right)}) {
    BeliefPainter painter(view, canvas, outlines);
    painter.metre_grid(camera.translation());
    painter.cloud(frame, segmentation.labels, camera);
    painter.surroundings(belief);
    painter.objects(belief);
    painter.camera(camera);
  }
  return canvas.take();
}

}  // namespace credo
