#include "support/literal_normals.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace credo::test {
namespace {

/// One surface inside a block: its mean inverse depth, and the depth up to which it reaches.
struct Surface {
  float w = 0.0F;
  float limit_m = 0.0F;
};

/// Samples of inverse depth; 0 where there is no surface.
using Samples = Grid<float>;

/// A sample that belongs to a window: columns and rows from its centre, inverse depth relative to
/// it.
struct Member {
  int u = 0;
  int v = 0;
  double w = 0.0;
};

struct Fit {
  bool spans = false;
  Eigen::Vector3d abc = Eigen::Vector3d::Zero();
  double variance = 1e30;
};

class Literal {
public:
  Literal(Grid<float> const& depth_m, CameraIntrinsics const& intrinsics,
          NormalsConfig const& config)
      : depth_m_(depth_m), intrinsics_(intrinsics), config_(config) {
    int const width = (depth_m.width() + 1) / 2;
    int const height = (depth_m.height() + 1) / 2;
    levels_.fill(Samples(width, height));
    for (std::size_t i = 0; i < levels_[0].size(); ++i) {
      auto const surface = nearest_surface(levels_[0].pixel(i), 0.0F);
      if (surface) {
        levels_[0][i] = surface->w;
      }
    }
    for (std::size_t level = 1; level < levels_.size(); ++level) {
      int const right = level == 1 ? 0 : 1;
      for (std::size_t i = 0; i < levels_[level].size(); ++i) {
        levels_[level][i] = merged(levels_[level - 1], levels_[level].pixel(i), right);
      }
    }
  }

  /// The normal of a pixel, none where there is none.
  std::optional<Eigen::Vector3d> normal(Pixel p, bool& undecided) const {
    Pixel const block{p.u / 2, p.v / 2};
    float const depth = depth_m_[p];
    auto surface = nearest_surface(block, 0.0F);
    if (!valid(depth) || !surface) {
      return std::nullopt;
    }
    if (depth > surface->limit_m) {
      surface = nearest_surface(block, surface->limit_m);
      if (!surface || depth > surface->limit_m) {
        return std::nullopt;
      }
    }
    return normal_of(block, surface->w, undecided);
  }

private:
  static bool valid(float depth) { return depth >= 1e-3F && depth < 1e6F; }

  float tolerance(float w) const {
    return config_.max_depth_jump_m * w * w + config_.depth_noise_per_m;
  }

  /// Of the pixels of a block beyond a depth.
  std::optional<Surface> nearest_surface(Pixel block, float beyond_m) const {
    std::array<float, 4> depth{};
    float least = 1e6F;
    for (int i = 0; i < 4; ++i) {
      Pixel const p{2 * block.u + i % 2, 2 * block.v + i / 2};
      float const z = depth_m_.contains(p) ? depth_m_[p] : 0.0F;
      depth[static_cast<std::size_t>(i)] = valid(z) && z > beyond_m ? z : 1e6F;
      least = std::min(least, depth[static_cast<std::size_t>(i)]);
    }
    if (least == 1e6F) {
      return std::nullopt;
    }
    float const limit =
        least + (config_.max_depth_jump_m + config_.depth_noise_per_m * least * least);
    std::array<float, 4> w{};
    for (std::size_t i = 0; i < 4; ++i) {
      if (depth[i] <= limit) {
        w[i] = 1.0F / depth[i];
      }
    }
    return Surface{mean(w), limit};
  }

  /// Of those that are not 0.
  static float mean(std::array<float, 4> const& w) {
    auto const count = std::ranges::count_if(w, [](float x) { return x != 0.0F; });
    return ((w[0] + w[1]) + (w[2] + w[3])) / static_cast<float>(count);
  }

  /// Of the samples at -1 and `right` in both directions, the mean of those near the nearest.
  float merged(Samples const& finer, Pixel p, int right) const {
    std::array<float, 4> w{};
    for (int i = 0; i < 4; ++i) {
      Pixel const q{i % 2 == 0 ? p.u - 1 : p.u + right, i / 2 == 0 ? p.v - 1 : p.v + right};
      w[static_cast<std::size_t>(i)] = finer.contains(q) ? finer[q] : 0.0F;
    }
    float const nearest = std::ranges::max(w);
    if (nearest == 0.0F) {
      return 0.0F;
    }
    for (float& x : w) {
      x = x < nearest - tolerance(nearest) ? 0.0F : x;
    }
    return mean(w);
  }

  static Fit fit(std::vector<Member> const& members, bool& undecided) {
    Fit result;
    auto const n = static_cast<double>(members.size());
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (Member const& m : members) {
      mean += Eigen::Vector3d(m.u, m.v, m.w) / n;
    }
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (Member const& m : members) {
      Eigen::Vector3d const d = Eigen::Vector3d(m.u, m.v, m.w) - mean;
      covariance += d * d.transpose() / n;
    }
    Eigen::Matrix2d const spread = covariance.topLeftCorner<2, 2>();
    // One line of samples has det / trace = 0, two lines have 1/4.
    result.spans = !members.empty() &&
                   exceeds(spread.determinant(), 0.19 * spread.trace(), spread.trace(), undecided);
    if (result.spans) {
      Eigen::Vector2d const uw_vw = covariance.block<2, 1>(0, 2);
      Eigen::Vector2d const ab = spread.inverse() * uw_vw;
      result.abc << ab, mean.z() - ab.dot(mean.head<2>());
      result.variance = std::max(0.0, covariance(2, 2) - ab.dot(uw_vw));
    }
    return result;
  }

  /// left > right; undecided where they are equal to the rounding of float sums of size `scale`.
  static bool exceeds(double left, double right, double scale, bool& undecided) {
    constexpr double kFloatSums = 2e-6;
    undecided |= std::abs(left - right) < kFloatSums * scale;
    return left > right;
  }

  /// Samples of the columns and rows [left, right] x [top, bottom] times `taps`.
  std::vector<Member> members(std::size_t level, Pixel block, float centre_w, int taps, int left,
                              int right, int top, int bottom) const {
    int const step = 1 << level;
    std::vector<Member> result;
    for (int v = top * taps; v <= bottom * taps; ++v) {
      for (int u = left * taps; u <= right * taps; ++u) {
        Pixel const q{block.u + u * step, block.v + v * step};
        if (levels_[level].contains(q) && levels_[level][q] != 0.0F) {
          float const w = levels_[level][q] - centre_w;
          if (std::abs(w) <= tolerance(centre_w)) {
            result.push_back({u, v, w});
          }
        }
      }
    }
    return result;
  }

  /// The whole window where one plane explains it, else its flat quadrants.
  std::vector<Member> best_members(std::size_t level, Pixel block, float centre_w, int taps,
                                   bool& undecided) const {
    double const noise2 = std::pow(0.1 * tolerance(centre_w), 2);
    double const scale = std::pow(tolerance(centre_w), 2);
    std::vector<Member> const whole = members(level, block, centre_w, taps, -1, 1, -1, 1);
    if (!exceeds(fit(whole, undecided).variance, noise2, scale, undecided)) {
      return whole;
    }
    std::array<std::vector<Member>, 4> quadrant;
    std::array<double, 4> variance{};
    for (std::size_t q = 0; q < 4; ++q) {
      int const left = q % 2 == 0 ? -1 : 0;
      int const top = q / 2 == 0 ? -1 : 0;
      quadrant[q] = members(level, block, centre_w, taps, left, left + 1, top, top + 1);
      variance[q] = fit(quadrant[q], undecided).variance;
    }
    double const limit = std::max(3.0 * std::ranges::min(variance), 0.5 * noise2);
    std::vector<Member> flat;
    for (std::size_t q = 0; q < 4; ++q) {
      if (!exceeds(variance[q], limit, scale, undecided)) {
        flat.insert(flat.end(), quadrant[q].begin(), quadrant[q].end());
      }
    }
    return flat;
  }

  std::optional<Eigen::Vector3d> normal_of(Pixel block, float centre_w, bool& undecided) const {
    auto const focal = static_cast<float>(0.5 * (intrinsics_.fx_px + intrinsics_.fy_px));
    float const radius_px =
        std::min(std::max(focal * config_.radius_m * centre_w, config_.min_radius_px),
                 config_.max_radius_px);
    float const radius_blocks = 0.5F * radius_px;
    std::size_t const level = radius_blocks < 5.0F ? 0 : radius_blocks < 10.0F ? 1 : 2;
    auto const step = static_cast<float>(1 << level);
    int const taps = std::min(static_cast<int>(std::floor(radius_blocks / step)), 4);

    std::vector<Member> const samples = best_members(level, block, centre_w, taps, undecided);
    Fit const plane = fit(samples, undecided);
    double const side = 2.0 * taps + 1.0;
    if (!plane.spans || static_cast<double>(samples.size()) <
                            static_cast<double>(config_.min_support) * side * side) {
      return std::nullopt;
    }
    double const a = plane.abc.x() * 0.5 / step;
    double const b = plane.abc.y() * 0.5 / step;
    // Means over an even number of blocks lie half a block, a pixel, up and left.
    double const offset = plane.abc.z() + (level == 0 ? 0.0 : a + b);
    double const w = centre_w + offset;
    double const limit = tolerance(centre_w);
    if (exceeds(std::abs(offset), limit, limit, undecided) ||
        !exceeds(w, 0.5 * (std::abs(a) + std::abs(b)), centre_w, undecided)) {
      return std::nullopt;
    }
    double const u = 2.0 * block.u + 0.5 - intrinsics_.cx_px;
    double const v = 2.0 * block.v + 0.5 - intrinsics_.cy_px;
    Eigen::Vector3d const m(a * intrinsics_.fx_px, b * intrinsics_.fy_px, w - a * u - b * v);
    return -m.normalized();
  }

  Grid<float> const& depth_m_;
  CameraIntrinsics intrinsics_;
  NormalsConfig config_;
  std::array<Samples, 3> levels_;
};

}  // namespace

LiteralNormals literal_normals(Grid<float> const& depth_m, CameraIntrinsics const& intrinsics,
                               NormalsConfig const& config) {
  LiteralNormals result{NormalMap(depth_m.width(), depth_m.height()),
                        Grid<std::uint8_t>(depth_m.width(), depth_m.height(), 0)};
  Literal const literal(depth_m, intrinsics, config);
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    bool undecided = false;
    auto const normal = literal.normal(depth_m.pixel(i), undecided);
    result.undecided[i] = undecided ? 1 : 0;
    if (normal) {
      result.normals.set(i, normal->cast<float>());
    }
  }
  return result;
}

}  // namespace credo::test
