#include "stages/normals/pca_normals.hpp"

#include <pcl/features/normal_3d.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>

#include <memory>

namespace credo::test {

std::vector<Eigen::Vector3f> pca_normals(OrganizedCloud const& cloud,
                                         std::vector<std::size_t> const& pixels, double radius_m) {
  auto const points = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  std::vector<int> position(cloud.size(), -1);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.valid(i)) {
      position[i] = static_cast<int>(points->size());
      points->emplace_back(cloud.x[i], cloud.y[i], cloud.z[i]);
    }
  }
  auto const wanted = std::make_shared<pcl::Indices>();
  for (std::size_t const i : pixels) {
    wanted->push_back(position.at(i));
  }
  pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setInputCloud(points);
  estimation.setIndices(wanted);
  estimation.setSearchMethod(std::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
  estimation.setRadiusSearch(radius_m);
  pcl::PointCloud<pcl::Normal> normals;
  estimation.compute(normals);
  std::vector<Eigen::Vector3f> result;
  for (pcl::Normal const& normal : normals) {
    result.emplace_back(normal.normal_x, normal.normal_y, normal.normal_z);
  }
  return result;
}

}  // namespace credo::test
