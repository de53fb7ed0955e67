#pragma once

#include <vector>

#include "core/detection.hpp"
#include "core/object_model.hpp"
#include "model_cloud.hpp"
#include "refinement.hpp"

namespace credo {

struct SceneCloud;
struct SegmentCloud;
struct Candidate;

/// Tuned on the tuning sets.
struct IcpSettings {
  double model_spacing_m = 0.006;
  /// Between the turns that are tried of a model at a segment's middle.
  double turns_apart_deg = 50.0;
  /// Each gets a rough ICP,
  std::size_t coarse_points = 40;
  IcpLimits coarse = {6, 0.05};
  /// and so many that fit best a fine one.
  std::size_t finalists = 3;
  std::size_t fine_points = 200;
  IcpLimits fine = {12, 0.015};
  double least_score = 0.65;
};

/// Iterative closest points from many turns at each segment's middle: every model against every
/// segment of its size (Credo's segments; PCL's ICP), judged by how it fits the depth image.
class IcpDetector : public Detector {
public:
  explicit IcpDetector(std::vector<ObjectModel> const& models, IcpSettings const& settings = {});
  std::vector<Detection> detect(Frame const& frame,
                                std::vector<DetectionRequest> const& requests) override;

private:
  struct Model {
    ModelCloud cloud;
    SearchedCloud searched;
    std::vector<Eigen::Quaternionf> turns;
    NormalCloud::Ptr coarse;
    NormalCloud::Ptr fine;
  };
  [[nodiscard]] std::vector<Candidate> fits_of(Model const& model, SegmentCloud const& segment,
                                               SceneCloud const& scene) const;

  std::vector<Model> models_;
  IcpSettings settings_;
};

}  // namespace credo
