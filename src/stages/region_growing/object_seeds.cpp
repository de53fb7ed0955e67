#include "stages/region_growing/object_seeds.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace credo {
namespace {

/// Points within this distance of the model are its seeds.
double seed_reach_of(PlacedShape const& placed, RegionGrowingConfig const& config) {
  return placed.shape->closed() ? config.seed_distance_m : config.open_mesh_distance_m;
}

/// None of the model's pixels is farther from it.
double reach_of(PlacedShape const& placed, RegionGrowingConfig const& config) {
  return std::max(config.max_distance_m, seed_reach_of(placed, config));
}

Eigen::AlignedBox3d enlarged(Eigen::AlignedBox3d const& box, double margin_m) {
  Eigen::Vector3d const margin = Eigen::Vector3d::Constant(margin_m);
  return {box.min() - margin, box.max() + margin};
}

/// A rigid motion and boxes in floats: only to pass over what is clearly outside.
struct LooseBoxes {
  Eigen::Matrix3f R;
  Eigen::Vector3f t;
  std::vector<Eigen::AlignedBox3f> boxes;
};

LooseBoxes loose_boxes(PlacedShape const& placed, Eigen::AlignedBox3d const& bounds,
                       double reach_m) {
  constexpr double kFloatSlack_m = 1e-3;
  LooseBoxes loose{placed.T_model_camera.rotation().toRotationMatrix().cast<float>(),
                   placed.T_model_camera.translation().cast<float>(),
                   {}};
  for (Eigen::AlignedBox3d const& part : placed.shape->part_bounds()) {
    loose.boxes.push_back(
        enlarged(enlarged(part, reach_m).intersection(bounds), kFloatSlack_m).cast<float>());
  }
  return loose;
}

/// One row of points in the model's frame, and which of them are marked.
struct RowMarks {
  explicit RowMarks(std::size_t width) : a(width), b(width), c(width), marks(width) {}

  std::vector<float> a;
  std::vector<float> b;
  std::vector<float> c;
  std::vector<std::uint8_t> marks;
};

/// Sets a byte for each pixel of a row that may lie within a box. In floats and without branches,
/// so that the compiler makes vectors of it; NaN compares false.
void mark_row(OrganizedCloud const& cloud, int v, LooseBoxes const& loose, RowMarks& row) {
  float const* x = cloud.x.row(v).data();
  float const* y = cloud.y.row(v).data();
  float const* z = cloud.z.row(v).data();
  Eigen::Matrix3f const& R = loose.R;
  float const r00 = R(0, 0), r01 = R(0, 1), r02 = R(0, 2), t0 = loose.t.x();
  float const r10 = R(1, 0), r11 = R(1, 1), r12 = R(1, 2), t1 = loose.t.y();
  float const r20 = R(2, 0), r21 = R(2, 1), r22 = R(2, 2), t2 = loose.t.z();
  float* a = row.a.data();
  float* b = row.b.data();
  float* c = row.c.data();
  std::uint8_t* marks = row.marks.data();
  auto const width = row.marks.size();
  for (std::size_t u = 0; u < width; ++u) {
    a[u] = r00 * x[u] + r01 * y[u] + r02 * z[u] + t0;
    b[u] = r10 * x[u] + r11 * y[u] + r12 * z[u] + t1;
    c[u] = r20 * x[u] + r21 * y[u] + r22 * z[u] + t2;
    marks[u] = 0;
  }
  for (Eigen::AlignedBox3f const& box : loose.boxes) {
    float const low0 = box.min().x(), low1 = box.min().y(), low2 = box.min().z();
    float const high0 = box.max().x(), high1 = box.max().y(), high2 = box.max().z();
    for (std::size_t u = 0; u < width; ++u) {
      marks[u] = static_cast<std::uint8_t>(
          marks[u] | (static_cast<unsigned>(a[u] >= low0) & static_cast<unsigned>(a[u] <= high0) &
                      static_cast<unsigned>(b[u] >= low1) & static_cast<unsigned>(b[u] <= high1) &
                      static_cast<unsigned>(c[u] >= low2) & static_cast<unsigned>(c[u] <= high2)));
    }
  }
}

/// The pixels whose points lie within the model's bounding box, `bounds_margin_m` larger on each
/// side, and may be within reach of its surface; in raster order.
std::vector<std::size_t> near_pixels(OrganizedCloud const& cloud, PlacedShape const& placed,
                                     RegionGrowingConfig const& config) {
  Eigen::AlignedBox3d const bounds = enlarged(placed.shape->bounds(), config.bounds_margin_m);
  LooseBoxes const loose = loose_boxes(placed, bounds, reach_of(placed, config));
  RowMarks row(static_cast<std::size_t>(cloud.width()));
  std::vector<std::size_t> pixels;
  for (int v = 0; v < cloud.height(); ++v) {
    mark_row(cloud, v, loose, row);
    std::size_t const begin = cloud.x.index({0, v});
    for (std::size_t u = 0; u < row.marks.size(); ++u) {
      if (row.marks[u] != 0 &&
          bounds.contains(placed.T_model_camera * cloud.at(begin + u).cast<double>())) {
        pixels.push_back(begin + u);
      }
    }
  }
  return pixels;
}

/// May a point with this normal (camera frame) be of the model's surface, which is near?
bool faces_alike(Eigen::Vector3d const& point_model, Eigen::Vector3f const& normal_camera,
                 SurfaceDistance const& surface, PlacedShape const& placed, double min_cosine,
                 double crease_radius_m) {
  DirectionCone const cone{placed.T_model_camera.rotation() * normal_camera.cast<double>(),
                           min_cosine};
  // A mesh with holes may be seen from its back.
  return cone.holds(surface.normal) || (!placed.shape->closed() && cone.holds(-surface.normal)) ||
         placed.shape->has_face_near(point_model, crease_radius_m, cone);
}

}  // namespace

ObjectPixels object_pixels(OrganizedCloud const& cloud, NormalMap const& normals,
                           PlacedShape const& placed, RegionGrowingConfig const& config) {
  std::vector<std::size_t> const pixels = near_pixels(cloud, placed, config);
  double const seed_reach_m = seed_reach_of(placed, config);
  bool const any_normal = config.max_model_angle_rad >= std::numbers::pi;
  double const reach_m = reach_of(placed, config);
  double const min_cosine = std::cos(config.max_model_angle_rad);
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
              (any_normal || faces_alike(point, normals.at(i), surface, placed, min_cosine,
                                         config.crease_radius_m))) {
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
