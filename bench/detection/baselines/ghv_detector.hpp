#pragma once

#include <memory>
#include <vector>

#include "core/detection.hpp"
#include "core/object_model.hpp"

namespace credo {

/// To be tuned on the tuning sets; what is not here is as in PCL's own example of this
/// verification.
struct GhvSettings {
  /// Of descriptors (SHOT) and between the points that have one.
  double radius_m = 0.04;
  double key_spacing_m = 0.015;
  /// Model views that descriptors are taken from.
  int views = 10;
  /// Cosine between descriptors that match.
  float least_cosine = 0.8F;
  /// Matches are of one pose where their distances agree to so much; so many make a hypothesis.
  double consistency_m = 0.01;
  int least_matches = 4;
  std::size_t hypotheses_per_model = 5;
  /// Share of a hypothesis' visible points that must be at the depth seen before it is verified.
  double least_explained = 0.3;
  // Of the verification.
  float resolution_m = 0.005F;
  float inlier_m = 0.01F;
  float occlusion_m = 0.015F;
  float outlier_weight = 3.0F;
  float clutter_radius_m = 0.03F;
  float clutter_weight = 5.0F;
};

/// Global hypothesis verification (Aldoma et al. 2012): SHOT descriptors of scene and model views
/// matched, grouped by geometric consistency, made better by ICP, and all hypotheses of all models
/// accepted or refused together. All but the matching is PCL's.
class GhvDetector : public Detector {
public:
  explicit GhvDetector(std::vector<ObjectModel> const& models, GhvSettings const& settings = {});
  GhvDetector(GhvDetector const&) = delete;
  GhvDetector& operator=(GhvDetector const&) = delete;
  GhvDetector(GhvDetector&&) = delete;
  GhvDetector& operator=(GhvDetector&&) = delete;
  ~GhvDetector() override;
  std::vector<Detection> detect(Frame const& frame,
                                std::vector<DetectionRequest> const& requests) override;

private:
  struct Model;
  std::vector<Model> models_;
  GhvSettings settings_;
};

}  // namespace credo
