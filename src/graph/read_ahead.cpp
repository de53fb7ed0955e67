#include "graph/read_ahead.hpp"

#include <utility>
#include <variant>

#include "core/error.hpp"

namespace credo {

ReadAhead::ReadAhead(std::unique_ptr<FrameSource> source, std::optional<std::int64_t> max_frames)
    : source_(std::move(source)), frames_left_(max_frames) {}

SourceResult const& ReadAhead::peek() {
  return ahead_.emplace_back(read());
}

FramePtr ReadAhead::first_frame() {
  for (SourceResult const& result : ahead_) {
    if (auto const* frame = std::get_if<FramePtr>(&result)) {
      return *frame;
    }
  }
  while (true) {
    SourceResult const& result = peek();
    if (auto const* frame = std::get_if<FramePtr>(&result)) {
      return *frame;
    }
    if (std::holds_alternative<EndOfSource>(result)) {
      return nullptr;
    }
    if (auto const& failure = std::get<FrameFailure>(result); failure.loss == Loss::kSilence) {
      throw InputError("no first frame, which a prior in the camera's frame needs: " +
                       failure.message);
    }
  }
}

SourceResult ReadAhead::next() {
  if (ahead_.empty()) {
    return read();
  }
  SourceResult result = std::move(ahead_.front());
  ahead_.pop_front();
  return result;
}

SourceResult ReadAhead::read() {
  if (frames_left_.has_value() && (*frames_left_)-- <= 0) {
    frames_left_ = 0;
    return EndOfSource{};
  }
  return source_->next();
}

WorldLevel find_level_ahead(ReadAhead& source, PoseConfig const& config) {
  FramePtr first;
  // Each frame by itself: those before it are known to show no floor, and need not be kept for it.
  for (int i = 0; config.level != LevelMode::kOff && i < config.level_frames; ++i) {
    SourceResult const& result = source.peek();
    if (std::holds_alternative<EndOfSource>(result)) {
      break;
    }
    if (auto const* frame = std::get_if<FramePtr>(&result)) {
      if (WorldLevel level = find_level({frame, 1}, config); level.floor_found) {
        return level;
      }
      first = first == nullptr ? *frame : first;
    } else if (std::get<FrameFailure>(result).loss == Loss::kSilence) {
      break;
    }
  }
  return first == nullptr ? find_level({}, config) : find_level({&first, 1}, config);
}

}  // namespace credo
