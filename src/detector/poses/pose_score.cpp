#include "detector/poses/pose_score.hpp"

#include <algorithm>
#include <cmath>

#include "detector/scenes/scene_projection.hpp"

namespace credo {
namespace {

/// What a point counts whose normal lies to the scene's like that.
float normal_worth(float cosine) {
  return cosine > 0.8F ? 1.0F : cosine > 0.5F ? 0.6F : 0.1F;
}

/// A view may show so much less than the segment's area before its points count less.
constexpr float kAreaMargin = 1.3F;
constexpr float kViolationWeight = 1.5F;
constexpr float kOccludedWeight = 0.6F;
constexpr float kOutlineWeight = 0.125F;
constexpr float kSameSurface_m = 0.015F;

struct Counts {
  float in = 0.0F;
  float violated = 0.0F;
  float occluded = 0.0F;
};

}  // namespace

PoseScore::PoseScore(SearchModel const& model, SearchScene const& scene)
    : model_(model), scene_(scene) {
  for (ScenePlane const& plane : scene.planes) {
    large_plane_.push_back(plane.extent_m > 1.2F * model.diameter_m);
  }
}

PoseScore::PoseScore(SearchModel const& model, SearchScene const& scene,
                     ClaimedPixels const& explained)
    : PoseScore(model, scene) {
  explained_ = explained.empty() ? nullptr : &explained;
}

float PoseScore::operator()(CameraPose const& pose, std::size_t points) const {
  ModelView const* view = view_of(pose);
  return view != nullptr ? fit(*view, pose, points) - outline_loss(*view, pose) : kWorst;
}

float PoseScore::rough(CameraPose const& pose, std::size_t points) const {
  ModelView const* view = view_of(pose);
  return view != nullptr ? fit(*view, pose, points) : kWorst;
}

ModelView const* PoseScore::view_of(CameraPose const& pose) const {
  Eigen::Vector3f const centre = pose * model_.centre_model;
  if (centre.z() <= model_.radius_m * 0.5F) {
    return nullptr;
  }
  ModelView const& view = model_.view_from(-(pose.rotation.transpose() * centre));
  return view.visible.empty() ? nullptr : &view;
}

float PoseScore::fit(ModelView const& view, CameraPose const& pose, std::size_t points) const {
  std::size_t const count = std::min(points, view.visible.size());
  SceneProjection const project(scene_);
  Counts sum;
  for (std::size_t k = 0; k < count; ++k) {
    std::uint16_t const i = view.visible[k];
    Eigen::Vector3f const p = pose * model_.points_model[i];
    Pixel at;
    ScenePixel const* pixel = project.at(p, at) ? &scene_.pixels[at] : nullptr;
    if (pixel == nullptr || pixel->depth_m <= 0.0F) {
      sum.occluded += 0.5F;
      continue;
    }
    float const d_m = pixel->depth_m - p.z();
    float const tau_m = depth_tolerance_m(p.z());
    bool const on_background = background(*pixel);
    if (d_m > tau_m) {
      sum.violated += d_m < 2.0F * tau_m ? 0.5F : 1.0F;
    } else if (d_m < -tau_m) {
      (on_background ? sum.violated : sum.occluded) += 1.0F;
    } else if (is_explained(at)) {
      // Another thing is there: not even its surface may be shared.
      sum.violated += 1.0F;
    } else if (on_background) {
      sum.occluded += 0.5F;
      sum.violated += 0.2F;
    } else {
      float const cosine = pixel->has_normal()
                               ? pixel->normal_camera().dot(pose.rotation * model_.normals_model[i])
                               : 0.6F;
      float const segment_m2 =
          pixel->segment > 0 ? scene_.segments[pixel->segment - 1U].area_m2 : 0.0F;
      float const share = kAreaMargin * view.area_m2 / std::max(segment_m2, 1e-6F);
      sum.in += normal_worth(cosine) * std::min(1.0F, share);
    }
  }
  return (sum.in - kViolationWeight * sum.violated) /
         (static_cast<float>(count) - kOccludedWeight * sum.occluded + 1.0F);
}

float PoseScore::outline_loss(ModelView const& view, CameraPose const& pose) const {
  SceneProjection const project(scene_);
  float bad = 0.0F;
  float tested = 0.0F;
  for (OutlinePair const& pair : view.outline) {
    Eigen::Vector3f const p_in = pose * pair.inside_model;
    Eigen::Vector3f const p_out = pose * pair.outside_model;
    ScenePixel const* in = project(p_in);
    ScenePixel const* out = project(p_out);
    if (in == nullptr || out == nullptr || in->depth_m <= 0.0F ||
        std::abs(in->depth_m - p_in.z()) > depth_tolerance_m(p_in.z())) {
      continue;
    }
    tested += 1.0F;
    bool const goes_on = out->depth_m > 0.0F && out->segment == in->segment &&
                         std::abs(out->depth_m - p_out.z()) < kSameSurface_m;
    if (!goes_on) {
      continue;
    }
    ScenePixel const* middle = project((p_in + p_out) / 2.0F);
    float const bend_m =
        middle != nullptr ? middle->depth_m - (in->depth_m + out->depth_m) / 2.0F : 0.0F;
    bad += std::abs(bend_m) > 0.002F + 0.002F * p_in.z() * p_in.z() ? 1.0F : 4.0F;
  }
  return kOutlineWeight * bad / (tested + 3.0F);
}

}  // namespace credo
