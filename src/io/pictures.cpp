#include "io/pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "io/canvas.hpp"

namespace credo {
namespace {

constexpr Rgb kBlack = {0, 0, 0};
constexpr Rgb kBackground = {24, 24, 28};
constexpr Rgb kGridLine = {52, 52, 60};
constexpr Rgb kCyan = {0, 190, 200};
constexpr Rgb kRed = {225, 40, 40};
constexpr Rgb kPink = {255, 130, 190};
constexpr Rgb kWallLine = {255, 200, 230};
constexpr Rgb kRefused = {255, 140, 0};
constexpr Rgb kCamera = {255, 255, 255};

constexpr std::array<Rgb, 8> kStuff = {{{165, 80, 235},
                                        {245, 220, 40},
                                        {70, 205, 70},
                                        {250, 150, 40},
                                        {90, 120, 255},
                                        {190, 240, 110},
                                        {200, 120, 160},
                                        {130, 220, 190}}};

constexpr std::array<Rgb, 6> kObjects = {{{255, 0, 255},
                                          {70, 110, 255},
                                          {0, 220, 130},
                                          {255, 90, 90},
                                          {200, 160, 255},
                                          {120, 200, 255}}};

Rgb mixed(Rgb a, Rgb b, double share_of_b) {
  Rgb result{};
  for (std::size_t c = 0; c < 3; ++c) {
    result[c] =
        static_cast<std::uint8_t>(std::lround((1.0 - share_of_b) * a[c] + share_of_b * b[c]));
  }
  return result;
}

Rgb depth_grey(float z) {
  if (std::isnan(z)) {
    return kBlack;
  }
  auto const level = static_cast<std::uint8_t>(std::clamp(255.0F - 42.0F * z, 40.0F, 255.0F));
  return {level, level, level};
}

void draw_color(Frame const& frame, Panel const& panel, Canvas& canvas) {
  OrganizedCloud const& cloud = frame.cloud_camera;
  for (int y = 0; y < panel.height; ++y) {
    for (int x = 0; x < panel.width; ++x) {
      Pixel const p{x * cloud.width() / panel.width, y * cloud.height() / panel.height};
      canvas.set(panel, x, y, frame.color.empty() ? depth_grey(cloud.z[p]) : frame.color[p]);
    }
  }
}

/// Stuff that the belief knows has its belief's colour, so that both halves of the picture agree.
std::map<LabelCode, Rgb> colors_of_stuff(BeliefState const& belief) {
  std::map<LabelCode, Rgb> colors;
  for (StuffBelief const& stuff : belief.stuff) {
    if (stuff.label) {
      colors[*stuff.label] = stuff_color(stuff.id, 1.0);
    }
  }
  return colors;
}

void draw_labels(Frame const& frame, LabelMap const& labels, BeliefState const& belief,
                 Panel const& panel, Canvas& canvas) {
  std::map<LabelCode, Rgb> const known = colors_of_stuff(belief);
  for (int y = 0; y < panel.height; ++y) {
    for (int x = 0; x < panel.width; ++x) {
      Pixel const p{x * labels.width() / panel.width, y * labels.height() / panel.height};
      auto const stuff = is_stuff(labels[p]) ? known.find(labels[p]) : known.end();
      Rgb const color = stuff != known.end() ? stuff->second : label_color(labels[p]);
      bool const has_depth = labels[p] != kNoDepth;
      canvas.set(panel, x, y,
                 has_depth ? mixed(color, depth_grey(frame.cloud_camera.z[p]), 0.25) : kBlack);
    }
  }
}

/// Draws everything a belief holds into one view of the world.
class BeliefPainter {
public:
  BeliefPainter(View const& view, Canvas& canvas, Outlines const& outlines)
      : view_(view), splats_(view, canvas), outlines_(outlines) {}

  void metre_grid(Eigen::Vector3d const& centre) {
    double const cx = std::round(centre.x());
    double const cy = std::round(centre.y());
    for (int k = -6; k <= 6; ++k) {
      splats_.line({cx + k, cy - 6, 0}, {cx + k, cy + 6, 0}, kGridLine);
      splats_.line({cx - 6, cy + k, 0}, {cx + 6, cy + k, 0}, kGridLine);
    }
  }

  void cloud(Frame const& frame, LabelMap const& labels, Se3 const& T_world_camera) {
    for (int v = 0; v < frame.cloud_camera.height(); v += 3) {
      for (int u = 0; u < frame.cloud_camera.width(); u += 3) {
        std::size_t const i = frame.cloud_camera.x.index({u, v});
        if (labels[i] == kUnassigned) {
          splats_.point(T_world_camera * frame.cloud_camera.at(i).cast<double>(), kCyan, 1);
        }
      }
    }
  }

  void points(PointList const& list, Rgb color, int radius_px) {
    for (Eigen::Vector3f const& p : list) {
      splats_.point(p.cast<double>(), color, radius_px);
    }
  }

  void belief(BeliefState const& belief) {
    if (belief.floor) {
      points(*belief.floor->points, kRed, 1);
    }
    for (WallBelief const& wall : belief.walls) {
      points(*wall.points, kPink, 1);
      Eigen::Vector3d const a(wall.segment_start_m.x(), wall.segment_start_m.y(), 0.0);
      Eigen::Vector3d const b(wall.segment_end_m.x(), wall.segment_end_m.y(), 0.0);
      splats_.line(a, b, kWallLine);
    }
    for (StuffBelief const& stuff : belief.stuff) {
      points(stuff.latest().points_world, stuff_color(stuff.id, probability_of(stuff.log_odds)), 1);
    }
    for (std::size_t i = 0; i < belief.objects.size(); ++i) {
      ObjectBelief const& object = belief.objects[i];
      outline(object.type, object.pose_world.mean, object_color(i, probability_of(object.log_odds)),
              1.0);
    }
  }

  /// `share` of each line is drawn, as dots.
  void outline(std::string const& type, Se3 const& pose, Rgb color, double share) {
    auto const found = outlines_.find(type);
    if (found == outlines_.end()) {
      axes(pose, 0.15, color);
      return;
    }
    for (OutlineEdge const& edge : found->second) {
      Eigen::Vector3d const a = pose * edge.begin.cast<double>();
      Eigen::Vector3d const b = pose * edge.end.cast<double>();
      bool const left = view_.faces(a, pose.rotation() * edge.normal_left.cast<double>());
      bool const right = view_.faces(a, pose.rotation() * edge.normal_right.cast<double>());
      if (edge.sharp || left != right) {
        splats_.line(a, b, color, share);
      }
    }
  }

  void camera(Se3 const& T_world_camera) { axes(T_world_camera, 0.25, kCamera); }

private:
  void axes(Se3 const& pose, double length_m, Rgb color) {
    for (int axis = 0; axis < 3; ++axis) {
      splats_.line(pose.translation(), pose * (length_m * Eigen::Vector3d::Unit(axis)), color);
    }
  }

  View view_;
  Splats splats_;
  Outlines const& outlines_;
};

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

Rgb label_color(LabelCode label) {
  if (label == kNoDepth) {
    return kBlack;
  }
  if (label == kFloor) {
    return kRed;
  }
  if (is_wall(label)) {
    return mixed(kPink, {255, 255, 255}, 0.12 * ((label - kFirstWall) % 4));
  }
  if (is_object(label)) {
    return object_color(static_cast<std::size_t>(label - kFirstObject), 1.0);
  }
  return is_stuff(label) ? kStuff[static_cast<std::size_t>(label - kFirstStuff) % kStuff.size()]
                         : kCyan;
}

Rgb object_color(std::size_t object, double probability) {
  return mixed(kBackground, kObjects[object % kObjects.size()], std::clamp(probability, 0.25, 1.0));
}

Rgb stuff_color(std::uint32_t id, double probability) {
  return mixed(kBackground, kStuff[id % kStuff.size()], std::clamp(probability, 0.15, 1.0));
}

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
    painter.belief(belief);
    painter.camera(camera);
  }
  return canvas.take();
}

}  // namespace credo
