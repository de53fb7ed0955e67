#include "graph/belief_trail.hpp"

#include <stdexcept>
#include <string>
#include <utility>

namespace credo {

BeliefTrail::BeliefTrail(BeliefPtr prior, std::size_t lag)
    : prior_(std::move(prior)), kept_(lag + 1), beliefs_(1, prior_) {}

void BeliefTrail::count(FrameIndex frame, BeliefPtr belief) {
  std::scoped_lock const lock(mutex_);
  count_locked(frame, std::move(belief));
}

void BeliefTrail::count_lost_until(FrameIndex last) {
  std::scoped_lock const lock(mutex_);
  while (last_ < last) {
    count_locked(FrameIndex{number(last_) + 1}, beliefs_.back());
  }
}

bool BeliefTrail::counted(FrameIndex frame) const {
  std::scoped_lock const lock(mutex_);
  return frame <= last_;
}

BeliefPtr BeliefTrail::after(FrameIndex frame) const {
  std::scoped_lock const lock(mutex_);
  if (number(frame) < 0) {
    return prior_;
  }
  std::int64_t const back = number(last_) - number(frame);
  if (back < 0 || std::cmp_greater_equal(back, beliefs_.size())) {
    throw std::logic_error("BeliefTrail: asked for the belief after frame " +
                           std::to_string(number(frame)) + " at frame " +
                           std::to_string(number(last_)));
  }
  return beliefs_[beliefs_.size() - 1 - static_cast<std::size_t>(back)];
}

BeliefPtr BeliefTrail::newest() const {
  std::scoped_lock const lock(mutex_);
  return beliefs_.back();
}

void BeliefTrail::count_locked(FrameIndex frame, BeliefPtr belief) {
  if (number(frame) != number(last_) + 1) {
    throw std::logic_error("BeliefTrail: frame " + std::to_string(number(frame)) + " after " +
                           std::to_string(number(last_)));
  }
  last_ = frame;
  beliefs_.push_back(std::move(belief));
  if (beliefs_.size() > kept_) {
    beliefs_.pop_front();
  }
}

}  // namespace credo
