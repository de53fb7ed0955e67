#include "graph/frame_reader.hpp"

#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

namespace credo {

JobPtr FrameReader::next() {
  if (error_ != nullptr) {
    return nullptr;
  }
  try {
    return read();
  } catch (...) {
    error_ = std::current_exception();
    return nullptr;
  }
}

JobPtr FrameReader::read() {
  auto const start = Job::Clock::now();
  SourceResult result = source_.next();
  auto job = std::make_unique<Job>();
  job->captured = Job::Clock::now();
  if (std::holds_alternative<EndOfSource>(result)) {
    return nullptr;
  }
  if (auto* failure = std::get_if<FrameFailure>(&result)) {
    job->index = failure->index;
    job->failure = std::move(*failure);
  } else {
    job->frame = std::get<FramePtr>(std::move(result));
    job->index = job->frame->index;
    std::scoped_lock const lock(mutex_);
    durations_.add(job->captured - start);
  }
  if (number(job->index) != static_cast<std::int64_t>(frames_)) {
    throw std::logic_error("the source gave frame " + std::to_string(number(job->index)) +
                           " where " + std::to_string(frames_) + " was due");
  }
  ++frames_;
  return job;
}

DurationQuantiles FrameReader::durations() const {
  std::scoped_lock const lock(mutex_);
  return durations_.quantiles();
}

}  // namespace credo
