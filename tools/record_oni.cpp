#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <filesystem>

#include "core/error.hpp"
#include "openni/oni_recorder.hpp"
#include "recording.hpp"
#include "status_line.hpp"

namespace credo {
namespace {

using Clock = std::chrono::steady_clock;

/// The recorder needs some room to write its end, and says nothing where there is none.
constexpr std::uintmax_t kLeastRoom_bytes = 64'000'000;

std::uintmax_t room_bytes(std::filesystem::path const& file) {
  std::error_code error;
  auto const space = std::filesystem::space(file, error);
  return error ? kLeastRoom_bytes : space.available;
}

std::uint64_t size_bytes(std::filesystem::path const& file) {
  std::error_code error;
  auto const size = std::filesystem::file_size(file, error);
  return error ? 0 : size;
}

class OniRecording {
public:
  OniRecording(RecordingOrder const& order, OniRecorder& recorder)
      : order_(order), recorder_(recorder) {}

  void run() {
    for (std::string const& warning : recorder_.warnings()) {
      spdlog::warn(warning);
    }
    while (!order_.stop.stop_requested() && !is_over() && !gone_) {
      listen();
      if (line_.is_due()) {
        line_.show(
            fmt::format("{} frames  {:.0f} s  {:.1f} MB  lost{}", recorder_.seen(), seconds(),
                        static_cast<double>(size_bytes(order_.out)) / 1e6,
                        losses_.by_reason().empty() ? " none" : counts_text(losses_.by_reason())));
      }
    }
    line_.finish();
  }

  /// The sensor or the room on the disk has gone.
  [[nodiscard]] std::string const& why_gone() const { return why_gone_; }
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(Clock::now() - began_).count();
  }
  [[nodiscard]] std::map<std::string, std::uint64_t> const& lost() const {
    return losses_.by_reason();
  }

private:
  [[nodiscard]] bool is_over() const {
    return (order_.frames && recorder_.seen() >= *order_.frames) ||
           (order_.seconds && seconds() >= *order_.seconds);
  }

  void listen() {
    switch (recorder_.next()) {
      case OniRecorder::Event::kNothing:
        break;
      case OniRecorder::Event::kDepth:
        if (room_bytes(order_.out) < kLeastRoom_bytes) {
          end("the disk is almost full");
        }
        break;
      case OniRecorder::Event::kStalled:
        losses_.add({FrameIndex{recorder_.seen()}, "stalled",
                     "openni:" + recorder_.uri() + ": sends no depth", Loss::kSilence},
                    line_);
        break;
      case OniRecorder::Event::kUnplugged:
        end("openni:" + recorder_.uri() + " was unplugged");
        break;
    }
  }

  void end(std::string why) {
    gone_ = true;
    why_gone_ = std::move(why);
  }

  RecordingOrder const& order_;
  OniRecorder& recorder_;
  Clock::time_point began_ = Clock::now();
  StatusLine line_;
  LossLog losses_;
  bool gone_ = false;
  std::string why_gone_;
};

}  // namespace

Recorded record_oni(RecordingOrder const& order) {
  constexpr std::size_t kScheme = std::char_traits<char>::length("openni:");
  OniRecorder recorder(order.source.substr(kScheme), order.config.sensor, order.out);
  OniRecording recording(order, recorder);
  recording.run();
  Recorded recorded;
  recorded.seconds = recording.seconds();
  OniTally const tally = recorder.finish();
  for (std::string const& note : tally.notes) {
    spdlog::warn(note);
  }
  if (!recording.why_gone().empty()) {
    spdlog::warn("{}: the recording ends there", recording.why_gone());
  }
  recorded.frames = tally.frames;
  recorded.bytes = tally.bytes;
  recorded.lost = recording.lost();
  if (tally.missed > 0) {
    recorded.lost["missed"] = static_cast<std::uint64_t>(tally.missed);
  }
  recorded.source = "oni:" + order.out.string();
  recorded.settings = tally.registered ? " --set capture.color_registered=yes" : "";
  return recorded;
}

}  // namespace credo
