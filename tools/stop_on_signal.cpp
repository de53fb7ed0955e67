#include "stop_on_signal.hpp"

#include <csignal>
#include <cstdlib>
#include <ctime>

namespace credo {
namespace {

constexpr long kPollNs = 50'000'000;
constexpr int kKilled = 130;

sigset_t stop_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  return signals;
}

}  // namespace

StopOnSignal::StopOnSignal() {
  sigset_t const signals = stop_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  waiter_ = std::jthread([signals, stop = stop_](std::stop_token const& no_more) mutable {
    timespec const poll{0, kPollNs};
    while (!no_more.stop_requested()) {
      if (sigtimedwait(&signals, nullptr, &poll) > 0 && !stop.request_stop()) {
        std::_Exit(kKilled);
      }
    }
  });
}

}  // namespace credo
