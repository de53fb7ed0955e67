#include "io/calibration_picture.hpp"

#include "io/belief_painter.hpp"
#include "io/canvas.hpp"
#include "io/palette.hpp"

namespace credo {

Grid<Rgb> draw_calibration(Frame const& frame, LabelMap const& labels, Se3 const& T_world_camera) {
  int const width = labels.width();
  int const height = labels.height();
  if (labels.empty()) {
    return {};
  }
  Canvas canvas(width, height, kBackground);
  Panel const panel{0, 0, width, height};
  bool const in_color = frame.color_registered && frame.color.same_size(labels);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    Rgb const seen = in_color ? frame.color[i] : depth_grey(frame.cloud_camera.z[i]);
    bool const tinted = labels[i] == kFloor || is_wall(labels[i]);
    Pixel const p = labels.pixel(i);
    canvas.set(panel, p.u, p.v, tinted ? mixed(seen, label_color(labels[i]), 0.5) : seen);
  }
  Outlines const none;
  BeliefPainter painter(camera_view(T_world_camera, frame.intrinsics, width, panel), canvas, none);
  painter.metre_grid(T_world_camera.translation());
  painter.camera(Se3());
  return canvas.take();
}

}  // namespace credo
