#include "drivers/freenect/kinect_thread.hpp"

#include <utility>

namespace credo::freenect {
namespace {

/// How long a command may wait for the thread.
constexpr auto kTick = std::chrono::milliseconds(20);
constexpr auto kTellingPatience = std::chrono::seconds(1);

char const* name_of(StreamKind kind) {
  return kind == StreamKind::kDepth ? "depth" : "colour";
}

}  // namespace

KinectThread::KinectThread(std::string serial, KinectSinks sinks)
    : serial_(std::move(serial)), sinks_(std::move(sinks)) {}

void KinectThread::run() {
  id_ = std::this_thread::get_id();
  try {
    OpenKinect kinect(serial_, events());
    cleaner_ = DepthCleaner(kinect.false_depths());
    log_.clear();
    opened_.set_value();
    serve(kinect);
  } catch (KinectError const&) {
    opened_.set_exception(std::current_exception());
  }
  refuse_commands();
}

void KinectThread::serve(OpenKinect& kinect) {
  while (!ending_ && !lost_) {
    run_commands(kinect);
    if (!kinect.process(kTick)) {
      lost_ = true;
      warn("was unplugged");
    }
    watch(kinect, StreamKind::kDepth);
    watch(kinect, StreamKind::kColor);
  }
}

std::future<void> KinectThread::ask(Command command) {
  std::scoped_lock const lock(asking_);
  Asked asked{std::move(command), {}};
  std::future<void> done = asked.done.get_future();
  if (refuses_ || lost_) {
    asked.done.set_exception(std::make_exception_ptr(KinectError("was unplugged, or given up")));
  } else {
    asked_.push_back(std::move(asked));
  }
  return done;
}

void KinectThread::run_commands(OpenKinect& kinect) {
  while (true) {
    std::unique_lock lock(asking_);
    if (asked_.empty()) {
      return;
    }
    Asked asked = std::move(asked_.front());
    asked_.pop_front();
    lock.unlock();
    try {
      asked.command(kinect);
      asked.done.set_value();
    } catch (KinectError const&) {
      asked.done.set_exception(std::current_exception());
    }
  }
}

void KinectThread::refuse_commands() {
  std::scoped_lock const lock(asking_);
  refuses_ = true;
  for (Asked& asked : asked_) {
    asked.done.set_exception(std::make_exception_ptr(KinectError("was unplugged, or given up")));
  }
  asked_.clear();
}

void KinectThread::start(OpenKinect& kinect, StreamKind kind) {
  kinect.start(kind, registered_);
  stream(kind).watchdog.start(Clock::now());
  if (kind == StreamKind::kColor) {
    apply_automatic(kinect);
  }
}

void KinectThread::stop(OpenKinect& kinect, StreamKind kind) {
  stream(kind).watchdog.stop();
  kinect.stop(kind);
}

void KinectThread::set_registered(OpenKinect& kinect, bool registered) {
  bool const changes = registered != registered_;
  registered_ = registered;
  if (changes && stream(StreamKind::kDepth).watchdog.runs()) {
    stop(kinect, StreamKind::kDepth);
    start(kinect, StreamKind::kDepth);
  }
}

void KinectThread::set_automatic(OpenKinect& kinect, Automatic which, bool on) {
  automatic_.at(static_cast<std::size_t>(which)) = on;
  apply_automatic(kinect);
}

void KinectThread::apply_automatic(OpenKinect& kinect) {
  for (Automatic const which : {Automatic::kExposure, Automatic::kWhiteBalance}) {
    std::optional<bool> const on = automatic_.at(static_cast<std::size_t>(which));
    if (on && stream(StreamKind::kColor).watchdog.runs()) {
      kinect.set_automatic(which, *on);
    }
  }
}

void KinectThread::watch(OpenKinect& kinect, StreamKind kind) {
  Stream& silent = stream(kind);
  std::optional<std::chrono::seconds> const waited = silent.watchdog.bark(Clock::now());
  if (!waited) {
    return;
  }
  ++silent.stalls;
  std::string const words = log_.text();
  warn(std::string("sent no ") + name_of(kind) + " for " + std::to_string(waited->count()) +
       " s: starts it anew" + (words.empty() ? "" : " (libfreenect: " + words + ")"));
  try {
    // The watchdog stays as it is: it waits longer each time.
    kinect.stop(kind);
    kinect.start(kind, registered_);
    if (kind == StreamKind::kColor) {
      apply_automatic(kinect);
    }
  } catch (KinectError const& error) {
    warn(error.what());
  }
}

KinectEvents KinectThread::events() {
  return {[this](std::span<std::uint16_t const> depths_mm, std::uint32_t stamp) {
            std::uint64_t const stamp_us = frame_came(StreamKind::kDepth, stamp);
            std::scoped_lock const lock(telling_);
            if (!hushed_) {
              sinks_.depth(depths_mm, cleaner_, stamp_us);
            }
          },
          [this](std::span<std::uint8_t const> rgb, std::uint32_t stamp) {
            std::uint64_t const stamp_us = frame_came(StreamKind::kColor, stamp);
            std::scoped_lock const lock(telling_);
            if (!hushed_) {
              sinks_.color(rgb, stamp_us);
            }
          },
          [this](std::string_view line, bool wrong) { take_log(line, wrong); }};
}

std::uint64_t KinectThread::frame_came(StreamKind kind, std::uint32_t stamp) {
  auto const now = Clock::now();
  stream(kind).watchdog.frame_came(now);
  return clock_.unwrap_us(
      stamp, std::chrono::duration_cast<std::chrono::microseconds>(now.time_since_epoch()).count());
}

void KinectThread::take_log(std::string_view line, bool wrong) {
  if (wrong) {
    log_.add(line);
  }
  std::optional<PacketNews> const news = packet_news(line);
  if (!news) {
    return;
  }
  Stream& one = stream(news->stream);
  one.lost_packets += news->lost;
  one.dropped_frames += news->frame_dropped ? 1 : 0;
  warn(news->frame_dropped
           ? std::string("a frame of ") + name_of(news->stream) + " dropped"
           : std::to_string(news->lost) + " packets of " + name_of(news->stream) + " lost");
}

void KinectThread::warn(std::string const& line) {
  std::scoped_lock const lock(telling_);
  if (!hushed_) {
    sinks_.warn(line);
  }
}

void KinectThread::end() {
  hushed_ = true;
  wait_told();
  ending_ = true;
}

void KinectThread::abandon() {
  end();
  lost_ = true;
}

void KinectThread::wait_told() {
  if (!is_this_thread()) {
    // Whoever is told at this moment may take his time, but not for ever.
    std::unique_lock const lock(telling_, kTellingPatience);
  }
}

StreamCounts KinectThread::counts(StreamKind kind) const {
  Stream const& one = streams_.at(static_cast<std::size_t>(kind));
  return {one.lost_packets, one.dropped_frames, one.stalls};
}

}  // namespace credo::freenect
