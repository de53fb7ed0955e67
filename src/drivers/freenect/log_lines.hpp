#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace credo::freenect {

enum class StreamKind : std::uint8_t { kDepth, kColor };

/// What libfreenect tells of a stream's packets in its log, and nowhere else.
struct PacketNews {
  StreamKind stream = StreamKind::kDepth;
  /// Packets that did not come.
  int lost = 0;
  /// Whether it gave up the frame that they were of.
  bool frame_dropped = false;
};

/// Reads a log line of libfreenect 0.5: "[Stream 70] Lost 3 packets" (70 depth, 80 colour),
/// "... Lost too many packets, resyncing...", "... Inconsistent flag ... resyncing...". Nothing
/// where the line tells of something else.
std::optional<PacketNews> packet_news(std::string_view line);

/// The last lines of a log, for the text of an error. Any thread may call.
class LogTail {
public:
  void add(std::string_view line);
  /// In their order, joined by "; "; empty where there are none.
  [[nodiscard]] std::string text() const;
  void clear();

private:
  mutable std::mutex mutex_;
  std::deque<std::string> lines_;
};

}  // namespace credo::freenect
