#include "scene_cloud.hpp"

#include <pcl/features/integral_image_normal.h>
#include <pcl/filters/extract_indices.h>
#include <pcl/segmentation/sac_segmentation.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "geometry/convex_hull.hpp"
#include "stages/segments/segments.hpp"

namespace credo {
namespace {

constexpr float kFarthest_m = 2.2F;

using Points = pcl::PointCloud<pcl::PointXYZ>;

/// A table top: its plane, normal up, and its rim along two axes in it.
struct Table {
  Eigen::Vector3f normal;
  float offset_m;
  Eigen::Vector3f x;
  Eigen::Vector3f y;
  std::vector<Eigen::Vector2d> rim;

  [[nodiscard]] float height_of(Eigen::Vector3f const& p) const { return normal.dot(p) + offset_m; }
  [[nodiscard]] bool is_over(Eigen::Vector3f const& p) const {
    constexpr float kLow_m = 0.01F;
    constexpr float kHigh_m = 0.6F;
    constexpr double kBeyond_m = 0.02;
    float const height_m = height_of(p);
    return height_m > kLow_m && height_m < kHigh_m &&
           depth_inside(rim, {x.dot(p), y.dot(p)}) > -kBeyond_m;
  }
};

Points::Ptr sparse_points(OrganizedCloud const& cloud) {
  constexpr int kStep_px = 4;
  auto points = std::make_shared<Points>();
  for (int v = 0; v < cloud.height(); v += kStep_px) {
    for (int u = 0; u < cloud.width(); u += kStep_px) {
      std::size_t const i = cloud.x.index({u, v});
      if (cloud.valid(i) && cloud.z[i] < kFarthest_m) {
        points->emplace_back(cloud.x[i], cloud.y[i], cloud.z[i]);
      }
    }
  }
  return points;
}

Table table_of(Eigen::Vector4f const& plane, Points const& points, pcl::Indices const& inliers) {
  Table table{plane.head<3>(), plane.w(), plane.head<3>().unitOrthogonal(), {}, {}};
  table.y = table.normal.cross(table.x);
  // A plane without end crosses the wall: what is far from its middle point is left out.
  constexpr double kLargest_m = 0.9;
  std::vector<Eigen::Vector2d> flat;
  std::array<std::vector<double>, 2> along;
  for (int const i : inliers) {
    Eigen::Vector3f const p = points[static_cast<std::size_t>(i)].getVector3fMap();
    flat.emplace_back(table.x.dot(p), table.y.dot(p));
    along[0].push_back(flat.back().x());
    along[1].push_back(flat.back().y());
  }
  for (std::vector<double>& values : along) {
    std::ranges::nth_element(values,
                             values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
  }
  Eigen::Vector2d const middle(along[0][flat.size() / 2], along[1][flat.size() / 2]);
  std::erase_if(flat, [&](Eigen::Vector2d const& p) { return (p - middle).norm() > kLargest_m; });
  table.rim = convex_polygon(flat);
  return table;
}

/// Of the largest planes that face up (the camera is upright) the nearest, but none that is a small
/// part of the largest: that is the top of a box.
std::optional<Table> find_table(OrganizedCloud const& cloud) {
  constexpr int kPlanes = 4;
  constexpr std::size_t kLeastPoints = 800;
  constexpr float kUp = 0.25F;
  Points::Ptr rest = sparse_points(cloud);
  constexpr double kSmallPart = 0.35;
  std::optional<Table> nearest;
  std::size_t most = 0;
  for (int k = 0; k < kPlanes && rest->size() > kLeastPoints; ++k) {
    pcl::SACSegmentation<pcl::PointXYZ> search;
    search.setModelType(pcl::SACMODEL_PLANE);
    search.setMethodType(pcl::SAC_RANSAC);
    search.setDistanceThreshold(0.01);
    search.setMaxIterations(300);
    search.setOptimizeCoefficients(true);
    search.setInputCloud(rest);
    pcl::ModelCoefficients coefficients;
    auto const inliers = std::make_shared<pcl::PointIndices>();
    search.segment(*inliers, coefficients);
    if (inliers->indices.size() < kLeastPoints) {
      break;
    }
    Eigen::Vector4f plane = Eigen::Map<Eigen::Vector4f>(coefficients.values.data());
    plane = plane.w() < 0.0F ? Eigen::Vector4f(-plane) : plane;  // towards the camera
    if (-plane.y() > kUp) {
      most = std::max(most, inliers->indices.size());
      bool const small =
          static_cast<double>(inliers->indices.size()) < kSmallPart * static_cast<double>(most);
      if (!small && (!nearest || plane.w() < nearest->offset_m)) {
        nearest = table_of(plane, *rest, inliers->indices);
      }
    }
    pcl::ExtractIndices<pcl::PointXYZ> others(false);
    others.setInputCloud(rest);
    others.setIndices(inliers);
    others.setNegative(true);
    auto remaining = std::make_shared<Points>();
    others.filter(*remaining);
    rest = remaining;
  }
  return nearest;
}

pcl::PointCloud<pcl::Normal> normals_of(OrganizedCloud const& cloud) {
  auto points = std::make_shared<Points>(static_cast<std::uint32_t>(cloud.width()),
                                         static_cast<std::uint32_t>(cloud.height()));
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    (*points)[i] = {cloud.x[i], cloud.y[i], cloud.z[i]};
  }
  points->is_dense = false;
  pcl::IntegralImageNormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setNormalEstimationMethod(estimation.COVARIANCE_MATRIX);
  estimation.setMaxDepthChangeFactor(0.02F);
  estimation.setNormalSmoothingSize(12.0F);
  estimation.setInputCloud(points);
  pcl::PointCloud<pcl::Normal> normals;
  estimation.compute(normals);
  return normals;
}

}  // namespace

SceneCloud scene_cloud(Frame const& frame) {
  constexpr int kStep_px = 2;
  OrganizedCloud const& cloud = frame.cloud_camera;
  SceneCloud scene{std::make_shared<NormalCloud>(), {}, 0, cloud.z, frame.intrinsics};
  std::optional<Table> const table = find_table(cloud);
  pcl::PointCloud<pcl::Normal> const normals = normals_of(cloud);
  Segments const segments = convex_segments(cloud.z, frame.intrinsics.fx_px, {});
  std::map<std::int32_t, int> numbers;
  for (int v = 0; v < cloud.height(); v += kStep_px) {
    for (int u = 0; u < cloud.width(); u += kStep_px) {
      std::size_t const i = cloud.x.index({u, v});
      if (!cloud.valid(i) || std::isnan(normals[i].normal_x) || segments.labels[i] == 0) {
        continue;
      }
      Eigen::Vector3f const p = cloud.at(i);
      if (table ? !table->is_over(p) : p.z() > kFarthest_m) {
        continue;
      }
      pcl::PointNormal point;
      point.getVector3fMap() = p;
      point.getNormalVector3fMap() = normals[i].getNormalVector3fMap();
      scene.points->push_back(point);
      int const next = static_cast<int>(numbers.size());
      scene.segment.push_back(numbers.try_emplace(segments.labels[i], next).first->second);
    }
  }
  scene.segment_count = static_cast<int>(numbers.size());
  return scene;
}

}  // namespace credo
