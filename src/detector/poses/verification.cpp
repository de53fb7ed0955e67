#include "detector/poses/verification.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "detector/poses/edge_contacts.hpp"

namespace credo {
namespace {

constexpr float kSameSurface_m = 0.015F;

constexpr float kMostMisfit = 4.0F;

constexpr int kBlock_px = 8;
constexpr float kLeastOfBlock = 12.0F;

/// Residuals of the depths, summed over blocks of a patch.
class BlockResiduals {
public:
  explicit BlockResiduals(DepthPatch const& patch)
      : blocks_(patch.depth_m.width() / kBlock_px + 1, patch.depth_m.height() / kBlock_px + 1) {}

  void add(Pixel pixel, float in_deviations) {
    Block& block = blocks_[Pixel{pixel.u / kBlock_px, pixel.v / kBlock_px}];
    block.sum += in_deviations;
    block.count += 1.0F;
  }
  [[nodiscard]] float misfit() const {
    float sum = 0.0F;
    float count = 0.0F;
    for (Block const& block : blocks_) {
      if (block.count >= kLeastOfBlock) {
        sum += block.count * std::min(kMostMisfit, std::abs(2.0F * block.sum / block.count));
        count += block.count;
      }
    }
    return count > 0.0F ? sum / count : 0.0F;
  }

private:
  struct Block {
    float sum = 0.0F;
    float count = 0.0F;
  };
  Grid<Block> blocks_;
};

/// Inverse depths, in which planes are linear over the image and a sensor of disparity errs alike
/// everywhere: how far they are from the model's, and from the best plane's.
class InverseDepths {
public:
  void add(Pixel pixel, float scene_m, float model_m) {
    double const told = 1.0 / static_cast<double>(scene_m);
    double const off = told - 1.0 / static_cast<double>(model_m);
    Eigen::Vector3d const at(1.0, pixel.u, pixel.v);
    normal_ += at * at.transpose();
    told_ += told * at;
    told_squared_ += told * told;
    off_ += off;
    off_squared_ += off * off;
    variance_ += std::pow(static_cast<double>(depth_deviation_m(model_m)) /
                              (static_cast<double>(model_m) * static_cast<double>(model_m)),
                          2);
  }
  [[nodiscard]] float relief() const {
    double const count = normal_(0, 0);
    if (count < kLeast) {
      return 0.0F;
    }
    double const from_plane = told_squared_ - told_.dot(normal_.ldlt().solve(told_));
    double const from_model = off_squared_ - off_ * off_ / count;
    double const ratio =
        (std::max(0.0, from_plane) + variance_) / (std::max(0.0, from_model) + variance_);
    return static_cast<float>(std::max(0.0, 0.5 * std::log(ratio)));
  }

private:
  static constexpr double kLeast = 12.0;
  Eigen::Matrix3d normal_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d told_ = Eigen::Vector3d::Zero();
  double told_squared_ = 0.0;
  double off_ = 0.0;
  double off_squared_ = 0.0;
  double variance_ = 0.0;
};

/// Pixels of the model behind each plane, and whether it stands before that plane.
using BehindPlanes = std::vector<int>;

/// Of the pixels behind planes, those behind a plane that most of what is in lies before.
int sunk(BehindPlanes const& behind, std::vector<std::uint32_t> const& in,
         SearchScene const& scene) {
  constexpr float kBefore_m = 0.01F;
  int sunk_px = 0;
  for (std::size_t p = 0; p < behind.size(); ++p) {
    if (behind[p] == 0) {
      continue;
    }
    ScenePlane const& plane = scene.planes[p];
    auto const before = std::ranges::count_if(in, [&](std::uint32_t position) {
      auto const at = static_cast<int>(position);
      int const width = scene.pixels.width();
      return plane.normal_camera.dot(scene.point_at({at % width, at / width})) - plane.offset_m >
             kBefore_m;
    });
    if (2 * static_cast<std::size_t>(before) > in.size()) {
      sunk_px += behind[p];
    }
  }
  return sunk_px;
}

/// Pixels in, by segment; few segments at a time.
using SegmentCounts = std::vector<std::pair<std::uint16_t, int>>;

void count(SegmentCounts& counts, std::uint16_t segment) {
  auto const known = std::ranges::find(counts, segment, &SegmentCounts::value_type::first);
  if (known != counts.end()) {
    ++known->second;
  } else {
    counts.emplace_back(segment, 1);
  }
}

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
    return background ? PixelVerdict::kBehindPlane : PixelVerdict::kOccluded;
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

float explained_share(SegmentCounts const& counts, SearchScene const& scene) {
  double weighted = 0.0;
  double weights = 0.0;
  for (auto const& [segment, pixels] : counts) {
    if (segment > 0) {
      double const in = pixels;
      weighted += in * in / scene.segments[segment - 1U].pixels;
      weights += in;
    }
  }
  return weights > 0.0 ? static_cast<float>(std::min(1.0, weighted / weights)) : 0.0F;
}

float edges_found(SearchModel const& model, SearchScene const& scene, CameraPose const& pose) {
  Eigen::Vector3f const centre = pose * model.centre_model;
  ModelView const& view = model.view_from(-(pose.rotation.transpose() * centre));
  float found = 0.0F;
  float open = 0.0F;
  for (OutlinePair const& pair : view.outline) {
    EdgeVerdict const verdict = look_at_edge(model, scene, pose, pair).verdict;
    found += verdict == EdgeVerdict::kFound ? 1.0F : 0.0F;
    open += verdict == EdgeVerdict::kOpen ? 1.0F : 0.0F;
  }
  // Two more, one of each: few say little.
  return (found + 1.0F) / (found + open + 2.0F);
}

/// Logistic regression on made table tops, with signs as they must be; see docs/detection.md.
float log_odds_of(Verification const& v) {
  auto const in = static_cast<float>(v.in_px);
  if (v.in_px == 0) {
    return -20.0F;
  }
  // Models and real sensors agree no better than that.
  constexpr float kSlack = 0.6F;
  // Of a thing that is there no more than 2 % is ever sunk into a plane; a tenth says it all.
  constexpr float kSurelySunk = 0.1F;
  // What would be wholly behind a large plane is taken for seen through: few things hide under
  // tables, and many poses would.
  auto const not_there = static_cast<float>(v.seen_through_px + v.behind_plane_px - v.sunk_px);
  float const all =
      in + static_cast<float>(v.background_px + v.seen_through_px + v.behind_plane_px);
  return -9.0F + 3.2F * v.explained - 0.44F * std::log(0.01F + not_there / all) -
         3.6F * std::min(1.0F, static_cast<float>(v.sunk_px) / (kSurelySunk * all)) -
         0.83F * std::log(0.05F + v.outline_open) - 1.02F * std::log(1.02F - v.edges_found) +
         0.69F * std::log(in / 500.0F) + 0.63F * v.relief - 2.0F * std::max(kSlack, v.block_misfit);
}

}  // namespace

float log_odds_beside(Verification const& verification, int most_net_px) {
  // Silhouettes waver by a hundredth of the picture or two.
  constexpr float kPerShare = 20.0F;
  constexpr float kMost = 3.0F;
  if (most_net_px <= verification.net_px() || most_net_px <= 0) {
    return verification.log_odds;
  }
  float const less =
      1.0F - static_cast<float>(verification.net_px()) / static_cast<float>(most_net_px);
  return verification.log_odds - std::min(kMost, kPerShare * less);
}

Verification verified(SearchModel const& model, SearchScene const& scene, CameraPose const& pose,
                      ClaimedPixels const& claimed) {
  DepthPatch const patch = model.rendered(pose, scene.intrinsics, scene.size());
  Grid<PixelVerdict> verdicts(patch.depth_m.width(), patch.depth_m.height(), PixelVerdict::kNone);
  Verification result;
  SegmentCounts in_segments;
  BlockResiduals blocks(patch);
  InverseDepths inverse;
  BehindPlanes behind(scene.planes.size(), 0);
  std::array<int, 7> counts = {};
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
      if (verdict == PixelVerdict::kBehindPlane) {
        ++behind[seen.plane];
      }
      if (verdict != PixelVerdict::kIn) {
        continue;
      }
      inverse.add(at, seen.depth_m, depth_m);
      result.explained_px.push_back(static_cast<std::uint32_t>(scene.pixels.index(at)));
      count(in_segments, seen.segment);
      blocks.add({u, v}, (seen.depth_m - depth_m) / depth_deviation_m(depth_m));
    }
  }
  result.in_px = counts[static_cast<std::size_t>(PixelVerdict::kIn)];
  result.background_px = counts[static_cast<std::size_t>(PixelVerdict::kBackground)];
  result.seen_through_px = counts[static_cast<std::size_t>(PixelVerdict::kSeenThrough)];
  result.behind_plane_px = counts[static_cast<std::size_t>(PixelVerdict::kBehindPlane)];
  result.occluded_px = counts[static_cast<std::size_t>(PixelVerdict::kOccluded)];
  result.no_depth_px = counts[static_cast<std::size_t>(PixelVerdict::kUnmeasured)];
  if (result.shown_px() > 0) {
    result.visible_fraction = static_cast<float>(result.in_px + result.background_px) /
                              static_cast<float>(result.shown_px());
  }
  result.block_misfit = blocks.misfit();
  result.relief = inverse.relief();
  result.sunk_px = sunk(behind, result.explained_px, scene);
  result.edges_found = edges_found(model, scene, pose);
  result.explained = explained_share(in_segments, scene);
  result.outline_open = open_outline(patch, verdicts, scene);
  result.log_odds = log_odds_of(result);
  return result;
}

}  // namespace credo
