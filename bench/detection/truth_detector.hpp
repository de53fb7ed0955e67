#pragma once

#include <vector>

#include "core/detection.hpp"
#include "views.hpp"

namespace credo {

/// Knows the truth of a run's frames and says it with an error of 4 mm and 2 degrees, honestly:
/// what the tables show of a perfect detector. Finds what is seen by a tenth and more; the score is
/// the visible fraction.
class TruthDetector : public Detector {
public:
  explicit TruthDetector(std::vector<TableView> const& views) : views_(views) {}
  std::vector<Detection> detect(Frame const& frame,
                                std::vector<DetectionRequest> const& requests) override;

private:
  std::vector<TableView> const& views_;
};

}  // namespace credo
