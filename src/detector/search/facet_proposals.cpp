#include "detector/search/facet_proposals.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>

namespace credo {
namespace {

/// What a side may be longer than the model's and still be of it.
constexpr float kMargin_m = 0.012F;
constexpr float kMarginShare = 1.1F;
/// Sides that match so well lie middle on middle as well.
constexpr float kSameSide = 0.85F;

bool fits(float scene_half_m, float model_half_m) {
  return scene_half_m <= kMarginShare * model_half_m + kMargin_m;
}

/// A facet's own axes as columns: along, across, normal.
Eigen::Matrix3f axes_of(Facet const& facet) {
  Eigen::Matrix3f axes;
  axes << facet.along, facet.across(), facet.normal;
  return axes;
}

/// A model's facet turned in its plane by quarters, and how long it then is along the scene's
/// sides.
struct Turned {
  Eigen::Matrix3f rotation;
  float half_length_m = 0.0F;
  float half_width_m = 0.0F;
};

Turned turned(Facet const& model, Facet const& scene, int quarters) {
  constexpr std::array<std::array<float, 2>, 4> kCosSin = {
      std::array<float, 2>{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  auto const& [cosine, sine] = kCosSin[static_cast<std::size_t>(quarters)];
  Eigen::Matrix3f quarter;
  quarter << cosine, -sine, 0, sine, cosine, 0, 0, 0, 1;
  Turned result;
  result.rotation = axes_of(scene) * quarter * axes_of(model).transpose();
  bool const swapped = quarters % 2 == 1;
  result.half_length_m = swapped ? model.half_width_m : model.half_length_m;
  result.half_width_m = swapped ? model.half_length_m : model.half_width_m;
  return result;
}

void add_poses(Facet const& model, Facet const& scene, int quarters,
               std::vector<Proposal>& proposals) {
  Turned const turn = turned(model, scene, quarters);
  if (!fits(scene.half_length_m, turn.half_length_m) ||
      !fits(scene.half_width_m, turn.half_width_m)) {
    return;
  }
  auto const add = [&](float along_m, float across_m) {
    Eigen::Vector3f const middle =
        scene.centre_m + along_m * scene.along + across_m * scene.across();
    proposals.push_back({{turn.rotation, middle - turn.rotation * model.centre_m}, scene.segment});
  };
  float const spare_length_m = turn.half_length_m - scene.half_length_m;
  float const spare_width_m = turn.half_width_m - scene.half_width_m;
  bool const whole_length = scene.half_length_m > kSameSide * turn.half_length_m;
  bool const whole_width = scene.half_width_m > kSameSide * turn.half_width_m;
  for (float const along : {-1.0F, 0.0F, 1.0F}) {
    for (float const across : {-1.0F, 0.0F, 1.0F}) {
      // A side that is seen whole needs no second try; one that is not may end on either side.
      if ((along == 0.0F) == whole_length && (across == 0.0F) == whole_width) {
        add(along * spare_length_m, across * spare_width_m);
      }
    }
  }
}

/// Of each segment's pixels those that are explained; empty where nothing is.
std::vector<int> explained_of_segments(SearchScene const& scene, ClaimedPixels const& explained) {
  std::vector<int> explained_px(explained.empty() ? 0 : scene.segments.size() + 1, 0);
  for (std::size_t i = 0; i < explained.size(); ++i) {
    explained_px[scene.pixels[i].segment] += explained[i] != 0 ? 1 : 0;
  }
  return explained_px;
}

}  // namespace

std::vector<Proposal> propose_by_facets(SearchModel const& model, SearchScene const& scene,
                                        ClaimedPixels const& explained) {
  std::vector<int> const explained_px = explained_of_segments(scene, explained);
  std::vector<Proposal> proposals;
  for (Facet const& of_scene : scene.facets) {
    std::size_t const segment = of_scene.segment;
    if (!explained_px.empty() && segment > 0 &&
        2 * explained_px[segment] > scene.segments[segment - 1].pixels) {
      continue;
    }
    for (Facet const& of_model : model.facets) {
      for (int quarters = 0; quarters < 4; ++quarters) {
        add_poses(of_model, of_scene, quarters, proposals);
      }
    }
  }
  return proposals;
}

}  // namespace credo
