#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/cloud.hpp"
#include "core/frame.hpp"
#include "core/plane.hpp"

namespace credo::test {

/// A ball; camera frame.
struct Sphere {
  Eigen::Vector3d centre_m;
  double radius_m = 0.0;
};

/// A convex body: what lies on the negative side of all its planes; camera frame.
using Convex = std::vector<Plane>;

/// A body with its axes turned: `axes` are its unit axes as columns.
Convex box(Eigen::Vector3d const& centre_m, Eigen::Matrix3d const& axes,
           Eigen::Vector3d const& half_size_m);

/// Things whose depth and normals are known exactly. A plane is seen from its positive side.
struct Scene {
  std::vector<Plane> planes;
  std::vector<Convex> bodies;
  std::vector<Sphere> spheres;
};

/// What a perfect camera sees: depth 0 and NaN normals where a ray meets nothing.
struct Rendering {
  Grid<float> depth_m;
  NormalMap normals;
};
Rendering render(Scene const& scene, int width, int height, CameraIntrinsics const& intrinsics);

/// Depth as a Kinect measures it: each pixel looks about half a pixel aside, and inverse depth is
/// scattered and rounded to the sensor's disparity steps (Barron and Malik, "Intrinsic Scene
/// Properties from a Single RGB-D Image", CVPR 2013, unbiased form). What the projector beside the
/// camera cannot light is lost.
Grid<float> with_kinect_noise(Grid<float> const& depth_m, unsigned seed);

/// The camera of the scenes below, 640x480.
CameraIntrinsics kinect_intrinsics();

/// A room corner seen from 1.2 m above the floor, with a table, boxes and balls 0.8 to 3 m away.
Scene room_scene();

}  // namespace credo::test
