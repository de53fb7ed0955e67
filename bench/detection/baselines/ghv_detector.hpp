#pragma once

#include <memory>
#include <vector>

#include "core/detection.hpp"
#include "core/object_model.hpp"
#include "model_cloud.hpp"
#include "verification.hpp"

namespace credo {

struct Candidate;
struct SceneCloud;
struct ShotKeys;

/// Tuned on the tuning sets.
struct GhvSettings {
  /// Between the points of models and scene.
  double surface_m = 0.005;
  /// Of descriptors (SHOT), and between the points that have one.
  double radius_m = 0.065;
  double key_spacing_m = 0.015;
  /// Model views that descriptors are taken from.
  int views = 12;
  /// Cosine between descriptors that match.
  float least_cosine = 0.75F;
  /// Matches are of one pose where their distances agree to so much; more than so many make a
  /// hypothesis.
  double consistency_m = 0.015;
  int least_matches = 4;
  std::size_t hypotheses_per_model = 15;
  /// How well a hypothesis must fit the depth image (Agreement), before ICP within this much more,
  /// and after it.
  float slack_m = 0.02F;
  double least_rough_score = 0.2;
  double least_score = 0.7;
  VerificationSettings verification;
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
  [[nodiscard]] std::vector<Candidate> hypotheses_of(Model const& model, ShotKeys const& keys,
                                                     NormalCloud const& surface,
                                                     SceneCloud const& scene) const;

  std::vector<Model> models_;
  GhvSettings settings_;
};

}  // namespace credo
