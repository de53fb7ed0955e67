#include "dds/remote_detector.hpp"

#include <algorithm>
#include <sstream>
#include <thread>
#include <utility>

#include "dds/detection_messages.hpp"
#include "dds/entities.hpp"

namespace credo {
namespace {

constexpr std::uint64_t kTold = 5;
constexpr std::chrono::milliseconds kPoll{1};

/// Deep enough for replies that come late, or from a second detector, not to push out the one that
/// is waited for.
Qos reply_qos() {
  Qos qos = last_state_qos();
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, 16);
  return qos;
}

std::uint64_t ns_since_1970() {
  auto const since = std::chrono::system_clock::now().time_since_epoch();
  return static_cast<std::uint64_t>(
      std::chrono::duration_cast<std::chrono::nanoseconds>(since).count());
}

/// The next sample of a reader, lent for as long as this lives; none where nothing is left.
class TakenReply {
public:
  explicit TakenReply(DdsEntity const& reader)
      : reader_(reader.handle()), count_(dds_take(reader_, &sample_, &info_, 1, 1)) {}
  TakenReply(TakenReply const&) = delete;
  TakenReply& operator=(TakenReply const&) = delete;
  TakenReply(TakenReply&&) = delete;
  TakenReply& operator=(TakenReply&&) = delete;
  ~TakenReply() {
    if (count_ > 0) {
      dds_return_loan(reader_, &sample_, count_);
    }
  }

  [[nodiscard]] bool is_any() const { return count_ > 0; }
  [[nodiscard]] bool is_to(std::string const& source, std::uint64_t session) const {
    return info_.valid_data && message().session == session && source == message().source;
  }
  [[nodiscard]] credo_msg_DetectionReply const& message() const {
    return *static_cast<credo_msg_DetectionReply const*>(sample_);
  }

private:
  dds_entity_t reader_;
  void* sample_ = nullptr;
  dds_sample_info_t info_{};
  dds_return_t count_;
};

}  // namespace

RemoteDetector::RemoteDetector(DdsConfig const& dds, RemoteDetectorConfig const& config, Tell tell,
                               std::uint32_t domain_here)
    : participant_(dds, domain_here),
      requests_(writer_of(participant_, "detection_request", credo_msg_DetectionRequest_desc,
                          last_state_qos())),
      replies_(
          reader_of(participant_, "detection_reply", credo_msg_DetectionReply_desc, reply_qos())),
      waitset_(checked(dds_create_waitset(participant_.handle()), "waitset")),
      timeout_(config.timeout_s),
      tell_(std::move(tell)),
      session_(ns_since_1970()) {
  dds_set_status_mask(replies_.handle(), DDS_DATA_AVAILABLE_STATUS);
  dds_waitset_attach(waitset_.handle(), replies_.handle(), 0);
}

std::vector<Detection> RemoteDetector::detect(Frame const& frame,
                                              std::vector<DetectionRequest> const& requests) {
  try {
    std::vector<Detection> detections = ask(frame, requests);
    tell_answer(frame.index);
    return detections;
  } catch (NobodyLooked const& why) {
    tell_silence(frame.index, why.what());
    throw;
  }
}

std::vector<Detection> RemoteDetector::ask(Frame const& frame,
                                           std::vector<DetectionRequest> const& requests) {
  auto const end = Clock::now() + std::chrono::duration_cast<Clock::duration>(timeout_);
  if (!is_there(end)) {
    throw NobodyLooked("nobody answers on " + participant_.topic("detection_request"));
  }
  DetectionSession const session{participant_.source(), session_};
  DetectionRequestMessage const message(session, frame, requests);
  if (!write_now(requests_, message.sample())) {
    throw NobodyLooked("DDS did not take the request, its buffers are full");
  }
  while (true) {
    if (auto detections = take(frame.index)) {
      return *std::move(detections);
    }
    auto const left = end - Clock::now();
    if (left <= Clock::duration::zero()) {
      std::ostringstream text;
      text << "no reply within " << timeout_.count() << " s (detector.remote.timeout_s)";
      throw NobodyLooked(text.str());
    }
    dds_waitset_wait(waitset_.handle(), nullptr, 0,
                     std::chrono::duration_cast<std::chrono::nanoseconds>(left).count());
  }
}

bool RemoteDetector::is_there(Clock::time_point end) {
  auto const found = [&] { return has_readers(requests_) && has_writers(replies_); };
  // To find each other takes a moment, in which a recording would have gone by.
  while (!has_waited_ && !found() && Clock::now() < end) {
    std::this_thread::sleep_for(kPoll);
  }
  has_waited_ = true;
  return found();
}

std::optional<std::vector<Detection>> RemoteDetector::take(FrameIndex frame) {
  while (true) {
    TakenReply const reply(replies_);
    if (!reply.is_any()) {
      return std::nullopt;
    }
    if (!reply.is_to(participant_.source(), session_)) {
      continue;
    }
    if (reply.message().frame == number(frame)) {
      return detections_in(reply.message());
    }
    ++late_;
  }
}

void RemoteDetector::tell_silence(FrameIndex frame, std::string const& why) {
  if (++silent_frames_ > 1 || ++silences_ > kTold) {
    return;
  }
  tell_("frame " + std::to_string(number(frame)) + ": nobody looks for known objects: " + why +
        "; what is believed of them stays as it is until a detector answers" +
        (silences_ == kTold ? " (more of these are only counted)" : ""));
}

void RemoteDetector::tell_answer(FrameIndex frame) {
  if (silent_frames_ > 0 && silences_ <= kTold) {
    tell_("frame " + std::to_string(number(frame)) +
          ": the detector answers; frames without: " + std::to_string(silent_frames_) +
          ", replies that came late so far: " + std::to_string(late_));
  }
  silent_frames_ = 0;
}

}  // namespace credo
