#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>

#include "core/capture_config.hpp"
#include "core/frame_source.hpp"
#include "stages/capture/level.hpp"

namespace credo {

/// A source whose next frames can be looked at before they are taken.
class ReadAhead : public FrameSource {
public:
  /// Ends after `max_frames` where given, good or bad. `source` is not null.
  explicit ReadAhead(std::unique_ptr<FrameSource> source,
                     std::optional<std::int64_t> max_frames = std::nullopt);

  /// Reads one more frame; `next` gives it again in its turn. Points until the next call of either.
  SourceResult const& peek();
  /// The first good frame that `next` will give, read ahead if need be; none where there is none.
  /// Throws InputError where the source falls silent before it.
  FramePtr first_frame();
  SourceResult next() override;

private:
  SourceResult read();

  std::unique_ptr<FrameSource> source_;
  std::optional<std::int64_t> frames_left_;
  std::deque<SourceResult> ahead_;
};

/// Finds the level by the first frame that shows the floor, among the first `pose.level_frames`;
/// reads no further than that one, or than the first good one where the level is given. Bad frames
/// are passed over; a source that has fallen silent ends the search.
WorldLevel find_level_ahead(ReadAhead& source, PoseConfig const& config);

}  // namespace credo
