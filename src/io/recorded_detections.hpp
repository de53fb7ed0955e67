#pragma once

#include <filesystem>
#include <map>
#include <vector>

#include "core/detection.hpp"

namespace credo {

/// Finds what a file says was found. Its lines are JSON, one a frame, in any order; a frame without
/// a line has no detections, and empty lines are passed over:
/// {"frame":0,"detections":[{"type":"cat","position":[3],"orientation_xyzw":[4],
///   "covariance":[36, row by row, order (delta m, phi rad)],"score":0.9,"visible_fraction":1}]}
/// Poses are in the camera frame, metres, as boxplus counts errors; visible_fraction may be left
/// out.
class RecordedDetector : public Detector {
public:
  /// Reads and checks the whole file. Throws InputError with the line and the key of what is wrong.
  explicit RecordedDetector(std::filesystem::path const& path);

  /// All of the frame's detections in the order of the file, also of types that nobody asks for:
  /// the gate tells of them, and a mistyped type is not lost in silence. The picture plays no part.
  std::vector<Detection> detect(Frame const& frame,
                                std::vector<DetectionRequest> const& requests) override;

private:
  std::map<FrameIndex, std::vector<Detection>> by_frame_;
};

}  // namespace credo
