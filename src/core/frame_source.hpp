#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "core/frame.hpp"

namespace credo {

/// What a lost frame says of its source.
enum class Loss : std::uint8_t {
  /// It came, but was bad: many of these in a row, and there is no use in going on.
  kBad,
  /// It never came, though others did.
  kMissed,
  /// No frame came at all for longer than one takes: the source may be lost, and may come back.
  kSilence,
};

/// A frame that could not be delivered. It keeps its number and is counted under its reason.
struct FrameFailure {
  FrameIndex index{0};
  /// A short stable word for counters, such as "truncated_image".
  std::string reason;
  /// One line for people: what, where, what to do.
  std::string message;
  Loss loss = Loss::kBad;
};

struct EndOfSource {};

using SourceResult = std::variant<FramePtr, FrameFailure, EndOfSource>;

/// Where frames come from. Opening (the constructor of each source) checks what can be checked and
/// throws InputError; afterwards every problem costs one frame and is told as a FrameFailure.
class FrameSource {
public:
  FrameSource() = default;
  FrameSource(FrameSource const&) = delete;
  FrameSource& operator=(FrameSource const&) = delete;
  FrameSource(FrameSource&&) = delete;
  FrameSource& operator=(FrameSource&&) = delete;
  virtual ~FrameSource() = default;

  /// The next frame, in order of index; EndOfSource once there are no more, and from then on.
  /// Called by one thread.
  virtual SourceResult next() = 0;
};

}  // namespace credo
