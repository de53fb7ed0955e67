#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/dds_config.hpp"
#include "core/detection.hpp"
#include "core/detector_config.hpp"
#include "dds/participant.hpp"

namespace credo {

/// A detector in another process: each frame goes out on <prefix>/detection_request and waits for
/// its reply on <prefix>/detection_reply, no longer than the timeout (docs/detectors.md).
///
/// Where nobody answers in time, or the detector says that it could not look, nobody looked: the
/// frame says nothing about known objects. A reply that breaks the protocol costs the frame. The
/// first frame waits for the detector to be found; later ones do not wait for one that is not
/// there, and one that comes back is asked again.
class RemoteDetector : public Detector {
public:
  /// Takes a line for people.
  using Tell = std::function<void(std::string const&)>;

  /// No domain of a user's has this number: they end at 230.
  static constexpr std::uint32_t kDomainHere = 1003;

  /// `domain_here`: two in one process need two (Participant). Throws InputError where DDS refuses.
  RemoteDetector(DdsConfig const& dds, RemoteDetectorConfig const& config, Tell tell,
                 std::uint32_t domain_here = kDomainHere);

  /// Throws NobodyLooked, or std::runtime_error for a reply that breaks the protocol.
  std::vector<Detection> detect(Frame const& frame,
                                std::vector<DetectionRequest> const& requests) override;

  /// Replies to this run that no request waited for.
  [[nodiscard]] std::uint64_t late() const { return late_; }

private:
  using Clock = std::chrono::steady_clock;

  /// Asks and waits. Throws as detect does.
  std::vector<Detection> ask(Frame const& frame, std::vector<DetectionRequest> const& requests);
  /// Whether someone listens and answers; the first time it waits for that.
  bool is_there(Clock::time_point end);
  /// The reply to this frame, if it has come; all others go.
  std::optional<std::vector<Detection>> take(FrameIndex frame);
  void tell_silence(FrameIndex frame, std::string const& why);
  void tell_answer(FrameIndex frame);

  Participant participant_;
  DdsEntity requests_;
  DdsEntity replies_;
  DdsEntity waitset_;
  std::chrono::duration<double> timeout_;
  Tell tell_;
  std::uint64_t session_;
  bool has_waited_ = false;
  std::uint64_t late_ = 0;
  // Frames since the last answer, and how often answers stopped coming.
  std::uint64_t silent_frames_ = 0;
  std::uint64_t silences_ = 0;
};

}  // namespace credo
