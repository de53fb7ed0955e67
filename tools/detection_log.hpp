#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "core/segmentation.hpp"

namespace credo {

/// Tells of detections that the belief did not take: each object's first few in the log, all in the
/// summary. Called by one thread at a time.
class DetectionLog {
public:
  /// Lines to log for a frame; mostly none.
  std::vector<std::string> told(Segmentation const& segmentation);
  /// "objects: 118 detections taken, 3 refused (2 table_1, 1 of no object); nobody looked in 4 of
  /// 41 frames", empty where nobody looked at all.
  [[nodiscard]] std::string summary() const;

private:
  std::uint64_t looked_ = 0;
  std::uint64_t not_looked_ = 0;
  std::uint64_t taken_ = 0;
  /// By object; the empty name for those of no object.
  std::map<std::string, std::uint64_t> refused_;
};

}  // namespace credo
