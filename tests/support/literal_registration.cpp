#include "support/literal_registration.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace credo::test {
namespace {

using Vector2d = Eigen::Vector2d;

struct Footprint {
  Vector2d begin, end;
  double depth_m;
};

class Registration {
public:
  Registration(Grid<float> const& depth_m, DepthCalibration const& calibration)
      : depth_m_(depth_m), calibration_(calibration) {}

  /// A pixel of the depth image, seen at a depth, in the colour camera's frame.
  [[nodiscard]] Eigen::Vector3d point(double u, double v, double z) const {
    CameraIntrinsics const& c = calibration_.depth;
    return calibration_.T_color_depth *
           Eigen::Vector3d((u - c.cx_px) / c.fx_px * z, (v - c.cy_px) / c.fy_px * z, z);
  }

  [[nodiscard]] Vector2d seen_at(Eigen::Vector3d const& p) const {
    CameraIntrinsics const& c = calibration_.color;
    return {p.x() / p.z() * c.fx_px + c.cx_px, p.y() / p.z() * c.fy_px + c.cy_px};
  }

  /// How far a corner of the pixels at infinity is off the straight, at most.
  [[nodiscard]] Vector2d corner() const {
    auto const far = [this](double u, double v) {
      Eigen::Vector3d const ray = point(u, v, 1.0) - calibration_.T_color_depth.translation();
      return seen_at(ray);
    };
    Vector2d most(0.0, 0.0);
    for (int column = 0; column < 3; ++column) {
      for (int row = 0; row < 3; ++row) {
        double const u = 0.5 * column * (depth_m_.width() - 1);
        double const v = 0.5 * row * (depth_m_.height() - 1);
        most.x() = std::max(most.x(), 0.5 * std::abs((far(u, v + 1.0) - far(u, v)).x()));
        most.y() = std::max(most.y(), 0.5 * std::abs((far(u + 1.0, v) - far(u, v)).y()));
      }
    }
    return (most.array() < 1e-6).select(0.0, most);
  }

  [[nodiscard]] std::optional<Footprint> footprint(Pixel pixel) const {
    double const z = depth_m_[pixel];
    if (!(z > 0.0) || !std::isfinite(z)) {
      return {};
    }
    Eigen::Vector3d const p = point(pixel.u, pixel.v, z);
    if (!(p.z() > 0.0)) {
      return {};
    }
    Vector2d const centre = seen_at(p);
    Vector2d const half(0.5 * calibration_.color.fx_px / calibration_.depth.fx_px * z / p.z(),
                        0.5 * calibration_.color.fy_px / calibration_.depth.fy_px * z / p.z());
    auto const end = [&](int axis, int step) {
      Pixel const next{pixel.u + (axis == 0 ? step : 0), pixel.v + (axis == 1 ? step : 0)};
      double const z_next = depth_m_.contains(next) ? depth_m_[next] : 0.0;
      if (!(z_next > 0.0) || !(std::abs(z_next - z) <= static_cast<double>(0.03F) * z)) {
        return centre[axis] + step * half[axis];
      }
      return 0.5 * (centre[axis] + seen_at(point(next.u, next.v, z_next))[axis]);
    };
    return Footprint{.begin = Vector2d(end(0, -1), end(1, -1)) - corner(),
                     .end = Vector2d(end(0, 1), end(1, 1)) + corner(),
                     .depth_m = p.z()};
  }

private:
  Grid<float> const& depth_m_;
  DepthCalibration const& calibration_;
};

}  // namespace

Grid<float> literal_registration(Grid<float> const& depth_m, DepthCalibration const& calibration,
                                 int width, int height) {
  Registration const registration(depth_m, calibration);
  std::vector<Footprint> footprints;
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    if (auto const footprint = registration.footprint(depth_m.pixel(i))) {
      footprints.push_back(*footprint);
    }
  }
  Grid<float> registered_m(width, height, 0.0F);
  for (std::size_t i = 0; i < registered_m.size(); ++i) {
    Pixel const pixel = registered_m.pixel(i);
    Eigen::Array2d const p(pixel.u, pixel.v);
    for (Footprint const& f : footprints) {
      bool const inside = (f.begin.array() <= p).all() && (p < f.end.array()).all();
      if (inside && (registered_m[i] == 0.0F || f.depth_m < registered_m[i])) {
        registered_m[i] = static_cast<float>(f.depth_m);
      }
    }
  }
  return registered_m;
}

}  // namespace credo::test
