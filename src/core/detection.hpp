#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "core/frame.hpp"
#include "core/se3.hpp"

namespace credo {

/// One object to look for, and where the belief expects it (camera frame).
struct DetectionRequest {
  std::string object_id;
  std::string type;
  PoseDistribution expected_camera;
};

/// A proposed pose of one known object, in the camera frame.
struct Detection {
  std::string type;
  PoseDistribution pose_camera;
  double score = 0.0;
  double visible_fraction = 1.0;
  /// Whether the pose's error is the last one's over again while the picture stays the same, as it
  /// is of whatever is computed from pictures. False: drawn anew in each frame.
  bool errors_repeat = true;
};

/// Nobody looked at a frame: a detector that is not there, or does not answer. The frame goes on
/// without it, and says nothing about known objects: not that they were not found.
class NobodyLooked : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// The black box that finds known objects (thesis 3.1.1). May be in-process, a file of recorded
/// detections, or another process.
class Detector {
public:
  Detector() = default;
  Detector(Detector const&) = delete;
  Detector& operator=(Detector const&) = delete;
  Detector(Detector&&) = delete;
  Detector& operator=(Detector&&) = delete;
  virtual ~Detector() = default;

  /// Any number of detections per request, none where nothing was found. Called by one thread at a
  /// time, frames in order. A throw costs the frame, NobodyLooked only its detections.
  virtual std::vector<Detection> detect(Frame const& frame,
                                        std::vector<DetectionRequest> const& requests) = 0;
};

}  // namespace credo
