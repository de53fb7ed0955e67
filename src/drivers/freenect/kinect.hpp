#pragma once

#include <functional>
#include <future>
#include <memory>
#include <string>
#include <thread>

#include "drivers/freenect/kinect_thread.hpp"

namespace credo::freenect {

/// An open Kinect, for callers on any thread. Each call is done on the Kinect's own thread, and is
/// waited for 3 s; a Kinect that does not answer by then is given up, and counts as lost. Calls out
/// of a sink are not waited for. Errors: KinectError, with libfreenect's last words.
class Kinect {
public:
  Kinect(std::string const& serial, KinectSinks sinks);
  Kinect(Kinect const&) = delete;
  Kinect& operator=(Kinect const&) = delete;
  Kinect(Kinect&&) = delete;
  Kinect& operator=(Kinect&&) = delete;
  ~Kinect();

  /// No sink is called any more, both streams are stopped, and it counts as lost.
  void close();
  void start(StreamKind kind);
  void stop(StreamKind kind);
  void set_registered(bool registered);
  /// Kept for when colour starts.
  void set_automatic(Automatic which, bool on);

  /// Whether it was unplugged, given up, or closed.
  [[nodiscard]] bool lost() const { return state_->lost(); }
  /// Others have seen that it is unplugged.
  void set_lost() { state_->set_lost(); }
  /// Returns once no sink is at work that was called before.
  void wait_told() { state_->wait_told(); }
  [[nodiscard]] StreamCounts counts(StreamKind kind) const { return state_->counts(kind); }

private:
  void ask(KinectThread::Command command);
  void wait_for(std::future<void>& done);

  std::string name_;
  /// The thread's own, too.
  std::shared_ptr<KinectThread> state_;
  std::future<void> ended_;
  std::thread thread_;
};

}  // namespace credo::freenect
