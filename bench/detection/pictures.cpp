#include "pictures.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "io/canvas.hpp"
#include "io/palette.hpp"

namespace credo {
namespace {

constexpr Rgb kGreen = {60, 210, 90};
constexpr Rgb kYellow = {250, 210, 40};

/// Grey by depth, darker where the surface turns away.
Rgb shaded(OrganizedCloud const& cloud, Pixel pixel) {
  constexpr int kStep_px = 3;
  Pixel const right{pixel.u + kStep_px, pixel.v};
  Pixel const below{pixel.u, pixel.v + kStep_px};
  std::size_t const i = cloud.x.index(pixel);
  if (!cloud.valid(i)) {
    return kBackground;
  }
  Rgb const grey = depth_grey(cloud.z[i]);
  if (!cloud.x.contains(right) || !cloud.x.contains(below)) {
    return grey;
  }
  Eigen::Vector3f const at = cloud.at(i);
  Eigen::Vector3f const normal =
      (cloud.at(cloud.x.index(right)) - at).cross(cloud.at(cloud.x.index(below)) - at).normalized();
  float const cosine = std::abs(normal.dot(at.normalized()));
  return std::isnan(cosine) ? grey : mixed(kBackground, grey, 0.25 + 0.75 * cosine);
}

void draw(std::vector<OutlineEdge> const& edges, Se3 const& pose_camera, Rgb color,
          View const& view, Splats& splats) {
  for (OutlineEdge const& edge : edges) {
    Eigen::Vector3d const begin = pose_camera * edge.begin.cast<double>();
    bool const left = view.faces(begin, pose_camera.rotation() * edge.normal_left.cast<double>());
    bool const right = view.faces(begin, pose_camera.rotation() * edge.normal_right.cast<double>());
    if (left != right || (edge.sharp && left)) {
      splats.line(begin, pose_camera * edge.end.cast<double>(), color);
    }
  }
}

}  // namespace

Grid<Rgb> picture_of(TableView const& table, std::vector<Detection> const& detections,
                     DetectionScorer::Matches const& matches, Outlines const& outlines) {
  OrganizedCloud const& cloud = table.frame->cloud_camera;
  Canvas canvas(cloud.width(), cloud.height(), kBackground);
  Panel const panel{0, 0, cloud.width(), cloud.height()};
  for (int v = 0; v < cloud.height(); ++v) {
    for (int u = 0; u < cloud.width(); ++u) {
      canvas.set(panel, u, v, shaded(cloud, {u, v}));
    }
  }
  View const view = camera_view(Se3{}, table.frame->intrinsics, cloud.width(), panel);
  Splats splats(view, canvas);
  for (TrueInstance const& truth : table.truths) {
    draw(outlines.at(truth.model), truth.pose_camera, kGreen, view, splats);
  }
  Splats above(view, canvas);
  for (std::size_t i = 0; i < detections.size(); ++i) {
    draw(outlines.at(detections[i].type), detections[i].pose_camera.mean,
         matches[i].front() ? kYellow : kRed, view, above);
  }
  return canvas.take();
}

}  // namespace credo
