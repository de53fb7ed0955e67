#include "described_points.hpp"

#include <pcl/features/fpfh.h>
#include <pcl/features/principal_curvatures.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <set>

namespace credo {
namespace {

using Surface = pcl::PointCloud<pcl::PointNormal>;

/// The first in each cell of a grid.
class CellGrid {
public:
  explicit CellGrid(double cell_m) : cell_m_(static_cast<float>(cell_m)) {}
  bool take(Eigen::Vector3f const& point) {
    Eigen::Array3i const cell = (point / cell_m_).array().floor().cast<int>();
    return taken_.insert({cell.x(), cell.y(), cell.z()}).second;
  }

private:
  float cell_m_;
  std::set<std::array<int, 3>> taken_;
};

pcl::PointNormal point_of(Eigen::Vector3f const& point, Eigen::Vector3f const& normal) {
  pcl::PointNormal result;
  result.getVector3fMap() = point;
  result.getNormalVector3fMap() = normal;
  return result;
}

pcl::IndicesPtr keys_of(Surface const& surface, double spacing_m) {
  CellGrid grid(spacing_m);
  auto keys = std::make_shared<pcl::Indices>();
  for (std::size_t i = 0; i < surface.size(); ++i) {
    if (grid.take(surface[i].getVector3fMap())) {
      keys->push_back(static_cast<pcl::index_t>(i));
    }
  }
  return keys;
}

template <typename Estimation>
void set_input(Estimation& estimation, Surface::Ptr const& surface, pcl::IndicesPtr const& keys,
               double radius_m) {
  estimation.setInputCloud(surface);
  estimation.setInputNormals(surface);
  estimation.setIndices(keys);
  estimation.setRadiusSearch(radius_m);
}

/// Of the surface at the keys; `positions` is where in the surface each is. Those without a
/// descriptor are left out.
DescribedPoints described_at(Surface::Ptr const& surface, pcl::IndicesPtr const& keys,
                             FpfhSettings const& settings, std::vector<std::size_t>& positions) {
  DescribedPoints result;
  if (keys->empty()) {
    return result;
  }
  pcl::FPFHEstimation<pcl::PointNormal, pcl::PointNormal, pcl::FPFHSignature33> estimation;
  set_input(estimation, surface, keys, settings.radius_m);
  pcl::PointCloud<pcl::FPFHSignature33> histograms;
  estimation.compute(histograms);
  pcl::PrincipalCurvaturesEstimation<pcl::PointNormal, pcl::PointNormal, pcl::PrincipalCurvatures>
      bending;
  set_input(bending, surface, keys, settings.radius_m);
  pcl::PointCloud<pcl::PrincipalCurvatures> bends;
  bending.compute(bends);
  constexpr Eigen::Index kBins = 33;
  result.features.resize(kBins, static_cast<Eigen::Index>(keys->size()));
  Eigen::Index count = 0;
  for (std::size_t i = 0; i < keys->size(); ++i) {
    Eigen::Map<Eigen::VectorXf const> const histogram(histograms[i].histogram, kBins);
    if (!histogram.allFinite() || histogram.sum() <= 0.0F) {
      continue;
    }
    auto const position = static_cast<std::size_t>((*keys)[i]);
    BentPoint point;
    point.point = (*surface)[position].getVector3fMap();
    point.normal = (*surface)[position].getNormalVector3fMap();
    Eigen::Vector3f bend(bends[i].principal_curvature);
    bend -= point.normal * point.normal.dot(bend);
    point.has_bend = bend.allFinite() && bend.norm() > 0.1F &&
                     bends[i].pc2 <= settings.round_share * bends[i].pc1;
    point.bend = point.has_bend ? bend.normalized() : point.normal.unitOrthogonal();
    result.points.push_back(point);
    result.features.col(count++) = histogram;
    positions.push_back(position);
  }
  result.features.conservativeResize(Eigen::NoChange, count);
  return result;
}

void append(DescribedPoints& all, DescribedPoints const& more) {
  all.points.insert(all.points.end(), more.points.begin(), more.points.end());
  Eigen::Index const before = all.features.cols();
  if (before == 0) {
    all.features = more.features;
  } else if (more.features.cols() > 0) {
    all.features.conservativeResize(Eigen::NoChange, before + more.features.cols());
    all.features.rightCols(more.features.cols()) = more.features;
  }
}

/// None of them twice: each the farthest from those before.
std::vector<std::size_t> spread_views(SearchModel const& model, std::size_t count) {
  std::vector<std::size_t> chosen;
  std::vector<float> nearest(model.views.size(), -2.0F);
  while (chosen.size() < std::min(count, model.views.size())) {
    auto const next = static_cast<std::size_t>(std::ranges::min_element(nearest) - nearest.begin());
    chosen.push_back(next);
    for (std::size_t i = 0; i < nearest.size(); ++i) {
      nearest[i] = std::max(nearest[i],
                            model.views[i].to_camera_model.dot(model.views[next].to_camera_model));
    }
  }
  return chosen;
}

}  // namespace

DescribedPoints described(SearchModel const& model, FpfhSettings const& settings) {
  DescribedPoints all;
  std::vector<std::size_t> positions;
  for (std::size_t const view : spread_views(model, settings.views)) {
    auto surface = std::make_shared<Surface>();
    for (std::uint16_t const i : model.views[view].visible) {
      surface->push_back(point_of(model.points_model[i], model.normals_model[i]));
    }
    append(all,
           described_at(surface, keys_of(*surface, settings.key_spacing_m), settings, positions));
  }
  return all;
}

DescribedPoints described(SearchScene const& scene, FpfhSettings const& settings) {
  auto surface = std::make_shared<Surface>();
  std::vector<Pixel> pixels;
  CellGrid grid(settings.surface_m);
  for (int v = 0; v < scene.pixels.height(); ++v) {
    for (int u = 0; u < scene.pixels.width(); ++u) {
      ScenePixel const& pixel = scene.pixels[{u, v}];
      bool const on_background =
          pixel.plane != kNoPlane && scene.planes[pixel.plane].extent_m >= settings.background_m;
      if (!pixel.has_normal() || pixel.segment == 0 || on_background) {
        continue;
      }
      Eigen::Vector3f const point = scene.point_at({u, v});
      if (grid.take(point)) {
        surface->push_back(point_of(point, pixel.normal_camera().normalized()));
        pixels.push_back({u, v});
      }
    }
  }
  std::vector<std::size_t> positions;
  DescribedPoints result =
      described_at(surface, keys_of(*surface, settings.key_spacing_m), settings, positions);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    result.points[i].pixel = pixels[positions[i]];
    result.points[i].segment = scene.pixels[pixels[positions[i]]].segment;
  }
  return result;
}

}  // namespace credo
