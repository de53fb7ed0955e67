#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/detection.hpp"
#include "core/frame.hpp"
#include "detector.h"

namespace credo {

/// Tells the requests of one run from those of all others.
struct DetectionSession {
  std::string source;
  std::uint64_t number = 0;
};

/// A request as it travels (idl/credo/detector.idl). Lends all that it is made of, images too,
/// which must outlive it. Throws std::logic_error for a colour image of another size than the
/// depth's.
class DetectionRequestMessage {
public:
  DetectionRequestMessage(DetectionSession const& session, Frame const& frame,
                          std::vector<DetectionRequest> const& requests);

  [[nodiscard]] credo_msg_DetectionRequest const& sample() const { return sample_; }

private:
  std::vector<credo_msg_WantedObject> objects_;
  credo_msg_DetectionRequest sample_{};
};

/// What a reply says was found. Throws NobodyLooked where it says that it could not look, and
/// std::runtime_error, which names the frame, the detection and the field, for what cannot be:
/// another schema, a type without a name, a pose that is none (core/told_pose.hpp), a score that is
/// not finite, a visible fraction beyond [0, 1].
[[nodiscard]] std::vector<Detection> detections_in(credo_msg_DetectionReply const& reply);

}  // namespace credo
