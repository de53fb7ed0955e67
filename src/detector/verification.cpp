#include "detector/verification.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace credo {
namespace {

constexpr float kSameSurface_m = 0.015F;

/// The normal of a rendered surface by its neighbours, facing the camera; zero at its rim.
Eigen::Vector3f patch_normal(DepthPatch const& patch, SearchScene const& scene, Pixel p) {
  auto const depth = [&](int du, int dv) {
    Pixel const q{p.u + du, p.v + dv};
    return patch.depth_m.contains(q) ? patch.depth_m[q] : kNoSurface_m;
  };
  float const left = depth(-1, 0);
  float const right = depth(1, 0);
  float const up = depth(0, -1);
  float const down = depth(0, 1);
  if (std::max({left, right, up, down}) == kNoSurface_m) {
    return Eigen::Vector3f::Zero();
  }
  // In inverse depth w a plane is affine in the image: see estimate_normals.
  auto const fx = static_cast<float>(scene.intrinsics.fx_px);
  auto const fy = static_cast<float>(scene.intrinsics.fy_px);
  float const w_u = (1.0F / right - 1.0F / left) / 2.0F;
  float const w_v = (1.0F / down - 1.0F / up) / 2.0F;
  float const x =
      static_cast<float>(p.u + patch.corner.u) - static_cast<float>(scene.intrinsics.cx_px);
  float const y =
      static_cast<float>(p.v + patch.corner.v) - static_cast<float>(scene.intrinsics.cy_px);
  Eigen::Vector3f const normal(w_u * fx, w_v * fy, 1.0F / patch.depth_m[p] - w_u * x - w_v * y);
  return -normal.normalized();
}

struct Sums {
  float normals = 0.0F;
  int with_normals = 0;
  /// Pixels in, by segment.
  std::vector<std::pair<std::uint16_t, int>> in_segments;

  void add(std::uint16_t segment) {
    // Pixels come row by row, few segments at a time.
    for (auto& [known, count] : in_segments) {
      if (known == segment) {
        ++count;
        return;
      }
    }
    in_segments.emplace_back(segment, 1);
  }
};

PixelVerdict verdict_at(SearchScene const& scene, ScenePixel const& seen, float model_depth_m,
                        float diameter_m, bool claimed) {
  if (claimed) {
    return PixelVerdict::kOccluded;
  }
  if (seen.depth_m <= 0.0F) {
    return PixelVerdict::kUnmeasured;
  }
  float const d_m = seen.depth_m - model_depth_m;
  float const tau_m = depth_tolerance_m(model_depth_m);
  bool const background = scene.is_background(seen, diameter_m);
  if (d_m > tau_m) {
    return PixelVerdict::kSeenThrough;
  }
  if (d_m < -tau_m) {
    // Nothing stands within a plane that is larger than it: a floor before the model means that the
    // model would be under the floor.
    return background ? PixelVerdict::kSeenThrough : PixelVerdict::kOccluded;
  }
  return background ? PixelVerdict::kBackground : PixelVerdict::kIn;
}

/// Share of the silhouette's pixels in the scene's surface that have more of it right outside.
float open_outline(DepthPatch const& patch, Grid<PixelVerdict> const& verdicts,
                   SearchScene const& scene) {
  constexpr std::array<Pixel, 4> kSides = {Pixel{-1, 0}, Pixel{1, 0}, Pixel{0, -1}, Pixel{0, 1}};
  constexpr int kBeyond_px = 3;
  int border = 0;
  int open = 0;
  for (int v = 0; v < verdicts.height(); ++v) {
    for (int u = 0; u < verdicts.width(); ++u) {
      if (verdicts[{u, v}] != PixelVerdict::kIn) {
        continue;
      }
      for (Pixel const& side : kSides) {
        Pixel const next{u + side.u, v + side.v};
        if (patch.depth_m.contains(next) && patch.depth_m[next] < kNoSurface_m) {
          continue;
        }
        Pixel const in{u + patch.corner.u, v + patch.corner.v};
        Pixel const beyond{in.u + kBeyond_px * side.u, in.v + kBeyond_px * side.v};
        if (!scene.pixels.contains(beyond)) {
          continue;
        }
        ++border;
        ScenePixel const& a = scene.pixels[in];
        ScenePixel const& b = scene.pixels[beyond];
        open += b.depth_m > 0.0F && a.segment == b.segment &&
                        std::abs(a.depth_m - b.depth_m) < kSameSurface_m
                    ? 1
                    : 0;
        break;
      }
    }
  }
  return border > 0 ? static_cast<float>(open) / static_cast<float>(border) : 0.0F;
}

float explained_share(Sums const& sums, SearchScene const& scene) {
  double weighted = 0.0;
  double weights = 0.0;
  for (auto const& [segment, count] : sums.in_segments) {
    if (segment > 0) {
      double const in = count;
      weighted += in * in / scene.segments[segment - 1U].pixels;
      weights += in;
    }
  }
  return weights > 0.0 ? static_cast<float>(std::min(1.0, weighted / weights)) : 0.0F;
}

/// Logistic regression on simulated scenes; see docs/detection.md.
float probability_of(Verification const& v) {
  auto const in = static_cast<float>(v.in_px);
  float const seen = in + static_cast<float>(v.background_px + v.seen_through_px);
  if (v.in_px == 0) {
    return 0.0F;
  }
  float const through = static_cast<float>(v.seen_through_px) / seen;
  float const x = -4.0F + 5.0F * v.explained - 14.0F * through + 4.0F * v.normal_agreement -
                  4.0F * v.outline_open + 0.5F * std::log(in / 500.0F) +
                  1.5F * std::min(1.0F, v.visible_fraction / 0.5F);
  return 1.0F / (1.0F + std::exp(-x));
}

}  // namespace

Verification verified(SearchModel const& model, SearchScene const& scene, CameraPose const& pose,
                      ClaimedPixels const& claimed) {
  DepthPatch const patch = model.rendered(pose, scene.intrinsics, scene.size());
  Grid<PixelVerdict> verdicts(patch.depth_m.width(), patch.depth_m.height(), PixelVerdict::kNone);
  Verification result;
  Sums sums;
  std::array<int, 6> counts = {};
  for (int v = 0; v < patch.depth_m.height(); ++v) {
    for (int u = 0; u < patch.depth_m.width(); ++u) {
      float const depth_m = patch.depth_m[{u, v}];
      if (depth_m == kNoSurface_m) {
        continue;
      }
      Pixel const at{u + patch.corner.u, v + patch.corner.v};
      ScenePixel const& seen = scene.pixels[at];
      PixelVerdict const verdict =
          verdict_at(scene, seen, depth_m, model.diameter_m, !claimed.empty() && claimed[at] != 0);
      verdicts[{u, v}] = verdict;
      ++counts[static_cast<std::size_t>(verdict)];
      if (verdict != PixelVerdict::kIn) {
        continue;
      }
      result.explained_px.push_back(static_cast<std::uint32_t>(scene.pixels.index(at)));
      sums.add(seen.segment);
      Eigen::Vector3f const normal = patch_normal(patch, scene, {u, v});
      if (seen.has_normal() && normal != Eigen::Vector3f::Zero()) {
        sums.normals += std::max(0.0F, normal.dot(seen.normal_camera()));
        ++sums.with_normals;
      }
    }
  }
  result.in_px = counts[static_cast<std::size_t>(PixelVerdict::kIn)];
  result.background_px = counts[static_cast<std::size_t>(PixelVerdict::kBackground)];
  result.seen_through_px = counts[static_cast<std::size_t>(PixelVerdict::kSeenThrough)];
  result.occluded_px = counts[static_cast<std::size_t>(PixelVerdict::kOccluded)];
  result.no_depth_px = counts[static_cast<std::size_t>(PixelVerdict::kUnmeasured)];
  if (result.shown_px() > 0) {
    result.visible_fraction = static_cast<float>(result.in_px + result.background_px) /
                              static_cast<float>(result.shown_px());
  }
  if (sums.with_normals > 0) {
    result.normal_agreement = sums.normals / static_cast<float>(sums.with_normals);
  }
  result.explained = explained_share(sums, scene);
  result.outline_open = open_outline(patch, verdicts, scene);
  result.probability = probability_of(result);
  return result;
}

}  // namespace credo
