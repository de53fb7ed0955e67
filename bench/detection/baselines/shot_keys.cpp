#include "shot_keys.hpp"

#include <pcl/features/shot.h>

#include "nearby_points.hpp"

namespace credo {

ShotKeys shot_keys(NormalCloud const& surface, double spacing_m, double radius_m) {
  auto const all = std::make_shared<NormalCloud>(surface);
  NormalCloud::Ptr const keys = thinned(surface, spacing_m);
  ShotKeys result{std::make_shared<pcl::PointCloud<pcl::PointXYZ>>(), {}};
  if (keys->empty()) {
    return result;
  }
  pcl::SHOTEstimation<pcl::PointNormal, pcl::PointNormal, pcl::SHOT352> estimation;
  estimation.setInputCloud(keys);
  estimation.setSearchSurface(all);
  estimation.setInputNormals(all);
  estimation.setRadiusSearch(radius_m);
  pcl::PointCloud<pcl::SHOT352> descriptors;
  estimation.compute(descriptors);
  result.descriptors.resize(pcl::SHOT352::descriptorSize(),
                            static_cast<Eigen::Index>(descriptors.size()));
  Eigen::Index count = 0;
  for (std::size_t i = 0; i < descriptors.size(); ++i) {
    Eigen::Map<Eigen::VectorXf const> const descriptor(descriptors[i].descriptor,
                                                       pcl::SHOT352::descriptorSize());
    if (descriptor.allFinite() && descriptor.norm() > 0.0F) {
      result.descriptors.col(count++) = descriptor.normalized();
      pcl::PointNormal const& key = (*keys)[i];
      result.points->emplace_back(key.x, key.y, key.z);
    }
  }
  result.descriptors.conservativeResize(Eigen::NoChange, count);
  return result;
}

ShotKeys joined(std::vector<ShotKeys> const& parts) {
  ShotKeys whole{std::make_shared<pcl::PointCloud<pcl::PointXYZ>>(), {}};
  Eigen::Index count = 0;
  for (ShotKeys const& part : parts) {
    count += part.descriptors.cols();
  }
  whole.descriptors.resize(pcl::SHOT352::descriptorSize(), count);
  Eigen::Index first = 0;
  for (ShotKeys const& part : parts) {
    if (part.descriptors.cols() > 0) {
      whole.descriptors.middleCols(first, part.descriptors.cols()) = part.descriptors;
      first += part.descriptors.cols();
      *whole.points += *part.points;
    }
  }
  return whole;
}

}  // namespace credo
