#include "detector/bpa/rendered_bracket.hpp"

#include <Eigen/Geometry>
#include <vector>

#include "core/frame.hpp"
#include "core/object_model.hpp"
#include "detector/scenes/scene_of_frame.hpp"

namespace credo::test {

SearchModel const& rendered_bracket() {
  static SearchModel const model =
      prepare_model({"bracket",
                     std::vector<Solid>{BoxSolid{{-0.08, -0.04, 0.0}, {0.08, 0.04, 0.03}},
                                        BoxSolid{{-0.08, -0.04, 0.03}, {-0.045, 0.04, 0.12}},
                                        BoxSolid{{0.02, 0.0, 0.03}, {0.06, 0.04, 0.075}}},
                     {}});
  return model;
}

SearchScene scene_with_bracket(CameraPose const& pose) {
  constexpr float kWall_m = 1.6F;
  Frame frame;
  Grid<float> depth_m(640, 480, kWall_m);
  DepthPatch const patch =
      rendered_bracket().rendered(pose, frame.intrinsics, {depth_m.width(), depth_m.height()});
  for (int v = 0; v < patch.depth_m.height(); ++v) {
    for (int u = 0; u < patch.depth_m.width(); ++u) {
      if (patch.depth_m[{u, v}] < kNoSurface_m) {
        depth_m[{u + patch.corner.u, v + patch.corner.v}] = patch.depth_m[{u, v}];
      }
    }
  }
  frame.cloud_camera = cloud_from_depth(depth_m, frame.intrinsics);
  return scene_of(frame);
}

CameraPose bracket_pose() {
  Eigen::Matrix3f const turn = (Eigen::AngleAxisf(2.2F, Eigen::Vector3f::UnitX()) *
                                Eigen::AngleAxisf(0.6F, Eigen::Vector3f::UnitZ()))
                                   .toRotationMatrix();
  return {turn, {0.02F, 0.03F, 0.9F}};
}

CameraPose moved_off(CameraPose const& pose, Eigen::Vector3f const& shift_m,
                     Eigen::Vector3f const& turn_rad) {
  Eigen::Vector3f const centre = pose * rendered_bracket().centre_model;
  float const angle = turn_rad.norm();
  Eigen::Vector3f const axis =
      angle > 0.0F ? Eigen::Vector3f(turn_rad / angle) : Eigen::Vector3f::UnitX();
  Eigen::Matrix3f const turn = Eigen::AngleAxisf(angle, axis).toRotationMatrix();
  return {turn * pose.rotation, turn * (pose.translation_m - centre) + centre + shift_m};
}

double mean_apart_m(CameraPose const& a, CameraPose const& b) {
  double sum = 0.0;
  for (Eigen::Vector3f const& p : rendered_bracket().points_model) {
    sum += static_cast<double>((a * p - b * p).norm());
  }
  return sum / static_cast<double>(rendered_bracket().points_model.size());
}

}  // namespace credo::test
