#include "sim/depth_sensor.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>

namespace credo {
namespace {

constexpr double kBaseline_m = 0.075;
/// Disparity in eighths of a pixel is this over depth, for a Kinect's focal length of 585 px.
constexpr double kDisparityUnit_m = 351.30;
constexpr double kDegree = std::numbers::pi / 180.0;

/// 0 up to `from`, 1 from `to` on.
double ramp(double value, double from, double to) {
  return std::clamp((value - from) / (to - from), 0.0, 1.0);
}

/// Probability that a surface returns nothing.
double dropout(SceneSurface surface, double depth_m, double incidence_rad) {
  double const grazing = ramp(incidence_rad, 70 * kDegree, 85 * kDegree);
  switch (surface) {
    case SceneSurface::kMatte:
      return grazing;
    case SceneSurface::kDark:
      return std::max(grazing, ramp(depth_m, 2.0, 4.0));
    case SceneSurface::kShiny:
      return std::max({grazing, incidence_rad < 8 * kDegree ? 1.0 : 0.0,
                       ramp(incidence_rad, 50 * kDegree, 70 * kDegree)});
    case SceneSurface::kGlass:
      break;
  }
  return 1.0;
}

/// One frame's measurement, row by row, each with numbers of its own.
class Measurement {
public:
  Measurement(RenderedView const& view, Scene const& scene, SensorModel model, int seed,
              FrameIndex index)
      : view_(view),
        scene_(scene),
        model_(model),
        seed_(seed),
        index_(index),
        lit_(view.depth_m.width(), view.depth_m.height(), 0),
        depth_m_(view.depth_m.width(), view.depth_m.height(), 0.0F) {}

  Grid<float> depth() {
    for_rows([this](int v) { light_row(v); });
    for_rows([this](int v) { measure_row(v); });
    return std::move(depth_m_);
  }

private:
  template <typename Row>
  void for_rows(Row const& row) const {
    tbb::parallel_for(tbb::blocked_range<int>(0, lit_.height(), 16), [&](auto const& rows) {
      for (int v = rows.begin(); v < rows.end(); ++v) {
        row(v);
      }
    });
  }

  /// From right to left the projector's columns fall; where they rise again, something nearer to
  /// the right has taken the light.
  void light_row(int v) {
    double least = std::numeric_limits<double>::infinity();
    for (int u = lit_.width() - 1; u >= 0; --u) {
      double const z = view_.depth_m[{u, v}];
      if (z > 0.0) {
        double const projector_px = u - scene_.camera.fx_px * kBaseline_m / z;
        constexpr double kSamePoint_px = 0.5;
        lit_[{u, v}] = projector_px <= least + kSamePoint_px ? 1 : 0;
        least = std::min(least, projector_px);
      }
    }
  }

  void measure_row(int v) {
    auto const frame = static_cast<std::uint64_t>(number(index_));
    std::seed_seq seed{static_cast<std::uint32_t>(seed_), static_cast<std::uint32_t>(frame),
                       static_cast<std::uint32_t>(frame >> 32U), static_cast<std::uint32_t>(v)};
    std::mt19937_64 random(seed);
    for (int u = 0; u < depth_m_.width(); ++u) {
      depth_m_[{u, v}] = measured({u, v}, random);
    }
  }

  [[nodiscard]] double incidence_rad(Pixel pixel) const {
    return std::acos(std::clamp(static_cast<double>(view_.incidence_cosine[pixel]), 0.0, 1.0));
  }

  float measured(Pixel pixel, std::mt19937_64& random) const {
    std::normal_distribution<double> normal;
    double const lateral_px = lateral_sigma_px(pixel);
    Pixel const source{shifted(pixel.u, lateral_px * normal(random), depth_m_.width()),
                       shifted(pixel.v, lateral_px * normal(random), depth_m_.height())};
    double const noise = normal(random);
    double const chance = std::uniform_real_distribution<double>()(random);
    if (lit_[source] == 0) {
      return 0.0F;
    }
    double const z = view_.depth_m[source];
    auto const thing = static_cast<std::size_t>(view_.thing[source]);
    if (chance < dropout(scene_.things[thing].surface, z, incidence_rad(source))) {
      return 0.0F;
    }
    double const noisy = model_ == SensorModel::kDisparity
                             ? disparity_depth(z, noise)
                             : z + axial_sigma_m(z, incidence_rad(source)) * noise;
    return noisy >= scene_.camera.min_range_m && noisy <= scene_.camera.max_range_m
               ? whole_millimetres(noisy)
               : 0.0F;
  }

  /// As a driver tells them, and as a dataset in fifths of a millimetre gives them back.
  static float whole_millimetres(double depth_m) {
    constexpr auto kFifth_m = static_cast<float>(1.0 / 5000.0);
    return static_cast<float>(5 * std::lround(depth_m * 1000.0)) * kFifth_m;
  }

  static int shifted(int position, double by_px, int size) {
    return std::clamp(position + static_cast<int>(std::lround(by_px)), 0, size - 1);
  }

  [[nodiscard]] double lateral_sigma_px(Pixel pixel) const {
    if (model_ == SensorModel::kDisparity) {
      return 0.5;
    }
    double const t = std::min(incidence_rad(pixel), 80 * kDegree);
    // Nguyen's figures are of a focal length of 585 px.
    return (0.8 + 0.035 * t / (std::numbers::pi / 2 - t)) * scene_.camera.fx_px / 585.0;
  }

  static double axial_sigma_m(double z, double incidence_rad) {
    double const sigma = 0.0012 + 0.0019 * (z - 0.4) * (z - 0.4);
    double const t = std::min(incidence_rad, 80 * kDegree);
    double const slant = t / (std::numbers::pi / 2 - t);
    return sigma + (t > 60 * kDegree ? 0.0001 / std::sqrt(z) * slant * slant : 0.0);
  }

  static double disparity_depth(double z, double noise) {
    return kDisparityUnit_m / std::floor(kDisparityUnit_m / z + noise / 6.0 + 0.5);
  }

  RenderedView const& view_;
  Scene const& scene_;
  SensorModel model_;
  int seed_;
  FrameIndex index_;
  Grid<std::uint8_t> lit_;
  Grid<float> depth_m_;
};

Grid<float> without_glass(RenderedView const& view, Scene const& scene) {
  Grid<float> depth_m = view.depth_m;
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    std::int32_t const thing = view.thing[i];
    if (thing >= 0 &&
        scene.things[static_cast<std::size_t>(thing)].surface == SceneSurface::kGlass) {
      depth_m[i] = 0.0F;
    }
  }
  return depth_m;
}

}  // namespace

Grid<float> measured_depth(RenderedView const& view, Scene const& scene, SensorModel model,
                           int seed, FrameIndex index) {
  return model == SensorModel::kIdeal ? without_glass(view, scene)
                                      : Measurement(view, scene, model, seed, index).depth();
}

}  // namespace credo
