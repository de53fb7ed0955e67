#include "io/belief_painter.hpp"

#include <cmath>
#include <cstddef>

namespace credo {
namespace {

constexpr Rgb kGridLine = {52, 52, 60};
constexpr Rgb kWallLine = {255, 200, 230};
constexpr Rgb kCamera = {255, 255, 255};
// Of a Kinect's noise at the distance of a table, about three deviations.
constexpr double kOutlineAheadM = 0.02;
constexpr Rgb kGrey = {170, 170, 170};

}  // namespace

std::map<LabelCode, Rgb> colors_of_stuff(BeliefState const& belief) {
  std::map<LabelCode, Rgb> colors;
  for (StuffBelief const& stuff : belief.stuff) {
    if (stuff.label) {
      colors[*stuff.label] = stuff_color(stuff.id, 1.0);
    }
  }
  return colors;
}

BeliefPainter::BeliefPainter(View const& view, Canvas& canvas, Outlines const& outlines,
                             int point_px)
    : view_(view), splats_(view, canvas), outlines_(outlines), point_px_(point_px) {}

void BeliefPainter::metre_grid(Eigen::Vector3d const& centre) {
  double const cx = std::round(centre.x());
  double const cy = std::round(centre.y());
  for (int k = -6; k <= 6; ++k) {
    splats_.line({cx + k, cy - 6, 0}, {cx + k, cy + 6, 0}, kGridLine);
    splats_.line({cx - 6, cy + k, 0}, {cx + 6, cy + k, 0}, kGridLine);
  }
}

void BeliefPainter::cloud(Frame const& frame, LabelMap const& labels, Se3 const& T_world_camera) {
  for (int v = 0; v < frame.cloud_camera.height(); v += 3) {
    for (int u = 0; u < frame.cloud_camera.width(); u += 3) {
      std::size_t const i = frame.cloud_camera.x.index({u, v});
      if (labels[i] == kUnassigned || is_object(labels[i])) {
        splats_.point(T_world_camera * frame.cloud_camera.at(i).cast<double>(), kCyan, point_px_);
      }
    }
  }
}

void BeliefPainter::cloud_in_color(Frame const& frame, Se3 const& T_world_camera) {
  for (std::size_t i = 0; i < frame.cloud_camera.x.size(); ++i) {
    splats_.point(T_world_camera * frame.cloud_camera.at(i).cast<double>(),
                  frame.color.empty() ? kGrey : frame.color[i], point_px_);
  }
}

void BeliefPainter::segmentation(Frame const& frame, LabelMap const& labels,
                                 BeliefState const& belief) {
  std::map<LabelCode, Rgb> const known = colors_of_stuff(belief);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    auto const found = known.find(labels[i]);
    Rgb const of_label = is_object(labels[i]) ? kCyan : label_color(labels[i]);
    splats_.point(belief.T_world_camera * frame.cloud_camera.at(i).cast<double>(),
                  found != known.end() ? found->second : of_label, point_px_);
  }
}

void BeliefPainter::surroundings(BeliefState const& belief) {
  if (belief.floor) {
    points(*belief.floor->points, kRed);
  }
  for (WallBelief const& wall : belief.walls) {
    points(*wall.points, kPink);
    Eigen::Vector3d const a(wall.segment_start_m.x(), wall.segment_start_m.y(), 0.0);
    Eigen::Vector3d const b(wall.segment_end_m.x(), wall.segment_end_m.y(), 0.0);
    splats_.line(a, b, kWallLine);
  }
  for (StuffBelief const& stuff : belief.stuff) {
    points(stuff.latest().points_world, stuff_color(stuff.id, probability_of(stuff.log_odds)));
  }
}

void BeliefPainter::objects(BeliefState const& belief) {
  for (std::size_t i = 0; i < belief.objects.size(); ++i) {
    ObjectBelief const& object = belief.objects[i];
    outline(object.type, object.pose_world.mean, object_color(i, probability_of(object.log_odds)),
            1.0);
  }
}

void BeliefPainter::outline(std::string const& type, Se3 const& pose, Rgb color, double share) {
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
      splats_.line(a, b, color, {share, point_px_, kOutlineAheadM});
    }
  }
}

void BeliefPainter::camera(Se3 const& T_world_camera) {
  axes(T_world_camera, 0.25, kCamera);
}

void BeliefPainter::points(PointList const& list, Rgb color) {
  for (Eigen::Vector3f const& p : list) {
    splats_.point(p.cast<double>(), color, point_px_);
  }
}

void BeliefPainter::axes(Se3 const& pose, double length_m, Rgb color) {
  for (int axis = 0; axis < 3; ++axis) {
    splats_.line(pose.translation(), pose * (length_m * Eigen::Vector3d::Unit(axis)), color);
  }
}

}  // namespace credo
