#include "stages/capture/coarse_cloud.hpp"

#include <Eigen/Geometry>
#include <cstdint>

namespace credo {
namespace {

constexpr int kStride = 4;

Eigen::Vector3f coarse_normal(OrganizedCloud const& cloud, Pixel p) {
  constexpr int kReach = 6;
  if (p.u < kReach || p.v < kReach || p.u + kReach >= cloud.width() ||
      p.v + kReach >= cloud.height()) {
    return Eigen::Vector3f::Constant(kNaN);
  }
  Eigen::Vector3f const du =
      cloud.at(Pixel{p.u + kReach, p.v}) - cloud.at(Pixel{p.u - kReach, p.v});
  Eigen::Vector3f const dv =
      cloud.at(Pixel{p.u, p.v + kReach}) - cloud.at(Pixel{p.u, p.v - kReach});
  return dv.cross(du).normalized();
}

}  // namespace

CoarseCloud coarse_cloud(OrganizedCloud const& cloud) {
  CoarseCloud coarse;
  coarse.points = Grid<Eigen::Vector3f>((cloud.width() + kStride - 1) / kStride,
                                        (cloud.height() + kStride - 1) / kStride,
                                        Eigen::Vector3f::Constant(kNaN));
  for (std::size_t i = 0; i < coarse.points.size(); ++i) {
    Pixel const cell = coarse.points.pixel(i);
    Pixel const p{cell.u * kStride, cell.v * kStride};
    std::size_t const at = cloud.x.index(p);
    if (cloud.valid(at)) {
      coarse.points[i] = cloud.at(at);
      coarse.search.add(cloud.at(at), coarse_normal(cloud, p), noise_tolerance_m(cloud.z[at]),
                        static_cast<std::uint32_t>(i));
    }
  }
  return coarse;
}

}  // namespace credo
