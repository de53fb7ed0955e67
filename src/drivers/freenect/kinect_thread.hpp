#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>

#include "drivers/freenect/clock.hpp"
#include "drivers/freenect/depth_cleaning.hpp"
#include "drivers/freenect/log_lines.hpp"
#include "drivers/freenect/open_kinect.hpp"
#include "drivers/freenect/watchdog.hpp"

namespace credo::freenect {

/// What a Kinect sends to whoever opened it, on its own thread.
struct KinectSinks {
  /// Not cleaned yet: what copies it cleans it on the way. Microseconds of the device's clock.
  std::function<void(std::span<std::uint16_t const> depths_mm, DepthCleaner const&,
                     std::uint64_t stamp_us)>
      depth;
  std::function<void(std::span<std::uint8_t const> rgb, std::uint64_t stamp_us)> color;
  /// A line worth a warning.
  std::function<void(std::string const& line)> warn;
};

/// What went wrong with a stream since the Kinect was opened.
struct StreamCounts {
  /// Packets that did not come. Up to 5 in a row leave pixels of the frame before in a frame.
  int lost_packets = 0;
  /// Frames given up, as more packets were lost.
  int dropped_frames = 0;
  /// How often nothing came for too long (see Watchdog); the stream was then started anew.
  int stalls = 0;
};

/// The thread of one Kinect: opens it, serves its streams, and closes it. It may outlive whoever
/// started it: libfreenect can wait for ever for a Kinect that does not answer.
class KinectThread {
public:
  using Command = std::function<void(OpenKinect&)>;

  KinectThread(std::string serial, KinectSinks sinks);

  /// The thread's body.
  void run();
  /// Ready once the Kinect is open, or with a KinectError.
  std::future<void> opened() { return opened_.get_future(); }
  /// To be done on the thread. The future has a KinectError where it fails, or the Kinect is gone.
  std::future<void> ask(Command command);
  /// Starts a stream, or stops it, on the thread.
  void start(OpenKinect& kinect, StreamKind kind);
  void stop(OpenKinect& kinect, StreamKind kind);
  /// Starts depth anew where it runs.
  void set_registered(OpenKinect& kinect, bool registered);
  void set_automatic(OpenKinect& kinect, Automatic which, bool on);

  /// Asks the thread to close the Kinect and to end; the sinks hear nothing from now on.
  void end();
  /// The thread is no more waited for, and the Kinect counts as lost.
  void abandon();
  /// Returns once no sink is at work that was called before.
  void wait_told();
  void set_lost() { lost_ = true; }
  [[nodiscard]] bool lost() const { return lost_; }
  [[nodiscard]] StreamCounts counts(StreamKind kind) const;
  /// libfreenect's last words.
  [[nodiscard]] std::string last_words() const { return log_.text(); }
  [[nodiscard]] bool is_this_thread() const { return id_ == std::this_thread::get_id(); }

private:
  using Clock = Watchdog::Clock;

  struct Stream {
    Watchdog watchdog;
    std::atomic<int> lost_packets = 0;
    std::atomic<int> dropped_frames = 0;
    std::atomic<int> stalls = 0;
  };
  struct Asked {
    Command command;
    std::promise<void> done;
  };

  KinectEvents events();
  void serve(OpenKinect& kinect);
  void run_commands(OpenKinect& kinect);
  void refuse_commands();
  void watch(OpenKinect& kinect, StreamKind kind);
  void take_log(std::string_view line, bool wrong);
  void warn(std::string const& line);
  std::uint64_t frame_came(StreamKind kind, std::uint32_t stamp);
  void apply_automatic(OpenKinect& kinect);
  Stream& stream(StreamKind kind) { return streams_.at(static_cast<std::size_t>(kind)); }

  std::string serial_;
  std::atomic<std::thread::id> id_;
  std::promise<void> opened_;
  std::atomic<bool> ending_ = false;
  std::atomic<bool> lost_ = false;
  LogTail log_;

  std::mutex asking_;
  std::deque<Asked> asked_;
  bool refuses_ = false;

  // Held while the sinks are called.
  std::timed_mutex telling_;
  KinectSinks sinks_;
  std::atomic<bool> hushed_ = false;

  // The thread's own, but for the counts.
  std::array<Stream, 2> streams_;
  ClockUnwrapper clock_;
  DepthCleaner cleaner_;
  bool registered_ = false;
  std::array<std::optional<bool>, 2> automatic_;
};

}  // namespace credo::freenect
