#include "stages/region_growing/object_seeds.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace credo {
namespace {

/// Sets a byte for each pixel of a row that may lie within the box. In floats and without branches,
/// so that the compiler makes vectors of it; NaN compares false.
void mark_row(OrganizedCloud const& cloud, int v, Eigen::Matrix3f const& R,
              Eigen::Vector3f const& t, Eigen::AlignedBox3f const& box, std::uint8_t* marks) {
  float const* x = cloud.x.row(v).data();
  float const* y = cloud.y.row(v).data();
  float const* z = cloud.z.row(v).data();
  float const r00 = R(0, 0), r01 = R(0, 1), r02 = R(0, 2), t0 = t.x();
  float const r10 = R(1, 0), r11 = R(1, 1), r12 = R(1, 2), t1 = t.y();
  float const r20 = R(2, 0), r21 = R(2, 1), r22 = R(2, 2), t2 = t.z();
  Eigen::Vector3f const& low = box.min();
  Eigen::Vector3f const& high = box.max();
  float const low0 = low.x(), low1 = low.y(), low2 = low.z();
  float const high0 = high.x(), high1 = high.y(), high2 = high.z();
  int const width = cloud.width();
  for (int u = 0; u < width; ++u) {
    float const a = r00 * x[u] + r01 * y[u] + r02 * z[u] + t0;
    float const b = r10 * x[u] + r11 * y[u] + r12 * z[u] + t1;
    float const c = r20 * x[u] + r21 * y[u] + r22 * z[u] + t2;
    marks[u] = static_cast<std::uint8_t>(
        static_cast<unsigned>(a >= low0) & static_cast<unsigned>(a <= high0) &
        static_cast<unsigned>(b >= low1) & static_cast<unsigned>(b <= high1) &
        static_cast<unsigned>(c >= low2) & static_cast<unsigned>(c <= high2));
  }
}

/// May a point with this normal (camera frame) be of the model's surface, which is near?
bool faces_alike(Eigen::Vector3d const& point_model, Eigen::Vector3f const& normal_camera,
                 SurfaceDistance const& surface, PlacedShape const& placed,
                 RegionGrowingConfig const& config) {
  DirectionCone const cone{placed.T_model_camera.rotation() * normal_camera.cast<double>(),
                           std::cos(config.max_model_angle_rad)};
  // A mesh with holes may be seen from its back.
  return cone.holds(surface.normal) || (!placed.shape->closed() && cone.holds(-surface.normal)) ||
         placed.shape->has_face_near(point_model, config.crease_radius_m, cone);
}

}  // namespace

std::vector<std::size_t> pixels_in_bounds(OrganizedCloud const& cloud, PlacedShape const& placed,
                                          double margin_m) {
  // Points are told apart in doubles; floats only pass over what is clearly outside.
  constexpr double kFloatSlack_m = 1e-3;
  Eigen::Vector3d const margin = Eigen::Vector3d::Constant(margin_m);
  Eigen::AlignedBox3d const box(placed.shape->bounds().min() - margin,
                                placed.shape->bounds().max() + margin);
  Eigen::Vector3d const slack = Eigen::Vector3d::Constant(kFloatSlack_m);
  Eigen::AlignedBox3f const loose((box.min() - slack).cast<float>(),
                                  (box.max() + slack).cast<float>());
  Eigen::Matrix3f const R = placed.T_model_camera.rotation().toRotationMatrix().cast<float>();
  Eigen::Vector3f const t = placed.T_model_camera.translation().cast<float>();
  std::vector<std::uint8_t> marks(static_cast<std::size_t>(cloud.width()));
  std::vector<std::size_t> pixels;
  for (int v = 0; v < cloud.height(); ++v) {
    mark_row(cloud, v, R, t, loose, marks.data());
    std::size_t const begin = cloud.x.index({0, v});
    for (std::size_t u = 0; u < marks.size(); ++u) {
      if (marks[u] != 0 &&
          box.contains(placed.T_model_camera * cloud.at(begin + u).cast<double>())) {
        pixels.push_back(begin + u);
      }
    }
  }
  return pixels;
}

ObjectPixels object_pixels(std::vector<std::size_t> const& pixels, OrganizedCloud const& cloud,
                           NormalMap const& normals, PlacedShape const& placed,
                           RegionGrowingConfig const& config) {
  double const seed_reach_m =
      placed.shape->closed() ? config.seed_distance_m : config.open_mesh_distance_m;
  bool const any_normal = config.max_model_angle_rad >= std::numbers::pi;
  double const reach_m = std::max(seed_reach_m, config.max_distance_m);
  constexpr std::uint8_t kAllowed = 1;
  constexpr std::uint8_t kSeed = 2;
  std::vector<std::uint8_t> roles(pixels.size(), 0);
  constexpr std::size_t kChunk = 512;
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, pixels.size(), kChunk), [&](auto const& part) {
        for (std::size_t k = part.begin(); k < part.end(); ++k) {
          std::size_t const i = pixels[k];
          bool const has_normal = normals.valid(i);
          if (!any_normal && !has_normal) {
            continue;
          }
          Eigen::Vector3d const point = placed.T_model_camera * cloud.at(i).cast<double>();
          SurfaceDistance const surface = placed.shape->distance_to(point);
          if (surface.distance_m <= reach_m &&
              (any_normal || faces_alike(point, normals.at(i), surface, placed, config))) {
            bool const seed = surface.distance_m <= seed_reach_m;
            roles[k] =
                static_cast<std::uint8_t>((has_normal ? kAllowed : 0U) | (seed ? kSeed : 0U));
          }
        }
      });
  ObjectPixels result;
  for (std::size_t k = 0; k < pixels.size(); ++k) {
    if ((roles[k] & kAllowed) != 0) {
      result.allowed.push_back(pixels[k]);
    }
    if ((roles[k] & kSeed) != 0) {
      result.seeds.push_back(pixels[k]);
    }
  }
  return result;
}

}  // namespace credo
