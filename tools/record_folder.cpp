#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>
#include <tbb/concurrent_queue.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <variant>

#include "core/error.hpp"
#include "io/recording_writer.hpp"
#include "openni/registration_check.hpp"
#include "recording.hpp"
#include "source_uri.hpp"
#include "status_line.hpp"

namespace credo {
namespace {

using Clock = std::chrono::steady_clock;

/// Frames between reading and writing: two seconds of a sensor's, for a disk that takes a while.
constexpr std::ptrdiff_t kWaitingFrames = 60;

double seconds_since(Clock::time_point then) {
  return std::chrono::duration<double>(Clock::now() - then).count();
}

/// What is known of a recording while it is made; two threads tell it.
class Board {
public:
  void lose(FrameFailure const& failure) {
    std::scoped_lock const lock(mutex_);
    losses_.add(failure, line_);
  }
  void lose(Frame const& frame, std::string const& reason, std::string const& message) {
    lose(FrameFailure{frame.index, reason, message});
  }
  void show(RecordingWriter const& writer) {
    std::scoped_lock const lock(mutex_);
    if (line_.is_due()) {
      line_.show(
          fmt::format("{} frames  {:.0f} s  {:.1f} MB  lost{}", writer.frames(),
                      seconds_since(began_), static_cast<double>(writer.bytes()) / 1e6,
                      losses_.by_reason().empty() ? " none" : counts_text(losses_.by_reason())));
    }
  }
  void note(std::string const& text) {
    std::scoped_lock const lock(mutex_);
    line_.finish();
    spdlog::warn(text);
  }
  /// Time counts from here.
  void begin() { began_ = Clock::now(); }
  void finish() { line_.finish(); }
  [[nodiscard]] Clock::time_point began() const { return began_; }
  [[nodiscard]] std::map<std::string, std::uint64_t> const& lost() const {
    return losses_.by_reason();
  }

private:
  std::mutex mutex_;
  Clock::time_point began_ = Clock::now();
  StatusLine line_;
  LossLog losses_;
};

/// Writes frames in a thread of its own.
class Writing {
public:
  Writing(RecordingWriter& writer, Board& board) : writer_(writer), board_(board) {
    queue_.set_capacity(kWaitingFrames);
    thread_ = std::jthread([this] { run(); });
  }
  Writing(Writing const&) = delete;
  Writing& operator=(Writing const&) = delete;
  Writing(Writing&&) = delete;
  Writing& operator=(Writing&&) = delete;
  ~Writing() { end(); }

  [[nodiscard]] bool failed() const { return failed_; }
  bool try_add(FramePtr frame) { return queue_.try_push(std::move(frame)); }
  void wait_and_add(FramePtr frame) { queue_.push(std::move(frame)); }
  /// Returns when all is written, or what hindered it.
  std::exception_ptr end() {
    if (thread_.joinable()) {
      queue_.push(nullptr);
      thread_.join();
    }
    return failure_;
  }

private:
  void run() {
    FramePtr frame;
    for (queue_.pop(frame); frame != nullptr; queue_.pop(frame)) {
      if (!failed_) {
        write(*frame);
      }
    }
  }

  void write(Frame const& frame) {
    try {
      if (std::optional<std::string> const why = writer_.refusal(frame)) {
        board_.lose(frame, "changed", *why);
        return;
      }
      writer_.write(frame);
      board_.show(writer_);
    } catch (std::exception const&) {
      failure_ = std::current_exception();
      failed_ = true;
    }
  }

  RecordingWriter& writer_;
  Board& board_;
  tbb::concurrent_bounded_queue<FramePtr> queue_;
  std::atomic<bool> failed_ = false;
  std::exception_ptr failure_;
  std::jthread thread_;
};

/// A sensor may say that it registers depth, and not do so.
class RegistrationDoubt {
public:
  explicit RegistrationDoubt(bool doubts) : doubts_(doubts) {}

  /// Whether this frame's images settle that they are not registered; once.
  bool confirmed_by(Frame const& frame) {
    if (!doubts_ || frame.color.empty() || !frame.color_registered) {
      return false;
    }
    if (!check_) {
      check_.emplace(scaled(kinect_calibration(), frame.color.width() / 640.0));
    }
    doubts_ = check_->add(frame.cloud_camera.z, frame.color) != Registration::kUnregistered;
    return !doubts_;
  }

private:
  bool doubts_;
  std::optional<RegistrationCheck> check_;
};

class Reading {
public:
  Reading(RecordingOrder const& order, Board& board)
      : order_(order),
        board_(board),
        live_(is_live(order.source)),
        doubt_(live_ && order.config.sensor.registration == RegistrationMode::kSensor &&
               order.config.capture.color_registered == ColorRegistered::kAuto) {}

  /// From the first frame to the last.
  void run(FrameSource& source, Writing& writing) {
    while (!order_.stop.stop_requested() && !writing.failed() && !is_over()) {
      SourceResult result = source.next();
      if (auto const* failure = std::get_if<FrameFailure>(&result)) {
        board_.lose(*failure);
      } else if (auto* frame = std::get_if<FramePtr>(&result)) {
        take(std::move(*frame), writing);
      } else {
        return;
      }
    }
  }

  [[nodiscard]] bool denies_registration() const { return denies_; }
  [[nodiscard]] double seconds() const { return live_ ? seconds_since(board_.began()) : stamps_s_; }

private:
  [[nodiscard]] bool is_over() const {
    return (order_.frames && frames_ >= *order_.frames) ||
           (order_.seconds && seconds() >= *order_.seconds);
  }

  void take(FramePtr frame, Writing& writing) {
    first_stamp_ns_ = first_stamp_ns_.value_or(frame->stamp_ns);
    stamps_s_ = 1e-9 * static_cast<double>(frame->stamp_ns - *first_stamp_ns_);
    if (!live_) {
      if (!is_over()) {
        writing.wait_and_add(std::move(frame));
        ++frames_;
      }
      return;
    }
    // Not only of the first frame: its colour may come later than its depth.
    if (!told_unregistered_ && !frame->color.empty() && !frame->color_registered) {
      told_unregistered_ = true;
      board_.note(order_.source +
                  ": does not register its depth to its colour; recorded as it sees. --set "
                  "sensor.registration=software records it registered");
    }
    if (doubt_.confirmed_by(*frame)) {
      denies_ = true;
      board_.note(order_.source +
                  ": its images show that its depth is not registered, whatever it says; the "
                  "recording says so");
    }
    if (writing.try_add(frame)) {
      ++frames_;
    } else {
      board_.lose(*frame, "slow_disk", "the disk does not keep up: frames are left out");
    }
  }

  RecordingOrder const& order_;
  Board& board_;
  bool live_;
  RegistrationDoubt doubt_;
  bool denies_ = false;
  bool told_unregistered_ = false;
  std::int64_t frames_ = 0;
  std::optional<std::int64_t> first_stamp_ns_;
  double stamps_s_ = 0.0;
};

/// Closes also what could not be written to its end: what is there can then be verified.
void close(RecordingWriter& writer, std::exception_ptr const& failure,
           std::filesystem::path const& folder) {
  if (failure == nullptr) {
    writer.finish();
    return;
  }
  try {
    writer.finish();
  } catch (InputError const&) {
    // The disk is still full; what was told of it stands.
  }
  try {
    std::rethrow_exception(failure);
  } catch (InputError const& error) {
    throw InputError(fmt::format("{} The {} frames before are whole, and in {}", error.what(),
                                 writer.frames(), folder.string()));
  }
}

}  // namespace

Recorded record_folder(RecordingOrder const& order) {
  Board board;
  PipelineConfig const& config = order.config;
  OpenedSource opened = open_source(
      order.source, config.capture, config.pose, config.sensor, config.sim,
      [&](std::string const& note) { board.note(note); }, order.stop);
  for (std::string const& warning : opened.warnings) {
    board.note(warning);
  }
  RecordingWriter writer(order.out, config.capture.depth_unit_m);
  board.begin();
  Reading reading(order, board);
  Recorded recorded;
  {
    Writing writing(writer, board);
    reading.run(*opened.source, writing);
    recorded.seconds = reading.seconds();
    std::exception_ptr const failure = writing.end();
    board.finish();
    if (reading.denies_registration()) {
      writer.deny_color_registered();
    }
    close(writer, failure, order.out);
  }
  recorded.frames = writer.frames();
  recorded.bytes = writer.bytes();
  recorded.lost = board.lost();
  recorded.source = "dataset:" + order.out.string();
  if (writer.rounded_frames() > 0) {
    board.note(fmt::format("the depth of {} frames was rounded: it is not of whole steps of {} mm",
                           writer.rounded_frames(), 1000 * writer.depth_unit_m()));
  }
  return recorded;
}

}  // namespace credo
