#include "drivers/freenect/kinect.hpp"

#include <chrono>
#include <utility>

namespace credo::freenect {
namespace {

constexpr auto kPatience = std::chrono::seconds(3);

bool is_ready(std::future<void> const& future) {
  return future.wait_for(kPatience) == std::future_status::ready;
}

}  // namespace

Kinect::Kinect(std::string const& serial, KinectSinks sinks)
    : name_("Kinect " + serial), state_(std::make_shared<KinectThread>(serial, std::move(sinks))) {
  std::future<void> opened = state_->opened();
  std::promise<void> ended;
  ended_ = ended.get_future();
  thread_ = std::thread([state = state_, ended = std::move(ended)]() mutable {
    state->run();
    ended.set_value();
  });
  try {
    wait_for(opened);
  } catch (KinectError const&) {
    // An error is the thread's last act, unless it does not answer.
    state_->lost() ? thread_.detach() : thread_.join();
    throw;
  }
}

Kinect::~Kinect() {
  close();
}

void Kinect::close() {
  if (!thread_.joinable()) {
    return;
  }
  state_->end();
  if (is_ready(ended_)) {
    thread_.join();
  } else {
    state_->abandon();
    thread_.detach();
  }
  state_->set_lost();
}

void Kinect::start(StreamKind kind) {
  ask([state = state_, kind](OpenKinect& kinect) { state->start(kinect, kind); });
}

void Kinect::stop(StreamKind kind) {
  ask([state = state_, kind](OpenKinect& kinect) { state->stop(kinect, kind); });
}

void Kinect::set_registered(bool registered) {
  ask([state = state_, registered](OpenKinect& kinect) {
    state->set_registered(kinect, registered);
  });
}

void Kinect::set_automatic(Automatic which, bool on) {
  ask([state = state_, which, on](OpenKinect& kinect) { state->set_automatic(kinect, which, on); });
}

void Kinect::ask(KinectThread::Command command) {
  std::future<void> done = state_->ask(std::move(command));
  if (!state_->is_this_thread()) {
    wait_for(done);
  }
}

void Kinect::wait_for(std::future<void>& done) {
  std::string why;
  if (is_ready(done)) {
    try {
      done.get();
      return;
    } catch (KinectError const& error) {
      why = error.what();
    }
  } else {
    state_->abandon();
    why = "does not answer: unplug it and plug it in again";
  }
  std::string const words = state_->last_words();
  throw KinectError(name_ + " " + why + (words.empty() ? "" : " (libfreenect: " + words + ")"));
}

}  // namespace credo::freenect
