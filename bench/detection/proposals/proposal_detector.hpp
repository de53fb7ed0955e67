#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/detection.hpp"
#include "described_points.hpp"
#include "detector/models/prepared_model.hpp"
#include "detector/search/joint_detection.hpp"

namespace credo {

/// What proposes poses.
struct Proposers {
  bool pairs = false;
  bool facets = false;
  bool fpfh = false;
};

/// BpaDetector's search of the whole frame with other proposals: what follows them, to the joint
/// choice and the second look, is its own. With pairs and facets it finds the same to the bit.
class ProposalDetector : public Detector {
public:
  ProposalDetector(std::vector<ObjectModel> const& models, Proposers proposers,
                   double min_probability, FpfhSettings const& settings = {});
  std::vector<Detection> detect(Frame const& frame,
                                std::vector<DetectionRequest> const& requests) override;

private:
  [[nodiscard]] std::vector<Proposal> proposals_of(std::string const& type,
                                                   SearchScene const& scene,
                                                   DescribedPoints const& of_scene,
                                                   ClaimedPixels const& explained) const;

  PreparedModels models_;
  Proposers proposers_;
  float min_probability_;
  FpfhSettings settings_;
  /// By the name of their model; empty where FPFH proposes nothing.
  std::map<std::string, DescribedPoints> described_;
};

}  // namespace credo
