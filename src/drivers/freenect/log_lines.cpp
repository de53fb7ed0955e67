#include "drivers/freenect/log_lines.hpp"

#include <charconv>

namespace credo::freenect {
namespace {

constexpr std::size_t kLinesKept = 6;

bool take(std::string_view& text, std::string_view expected) {
  bool const begins = text.starts_with(expected);
  text.remove_prefix(begins ? expected.size() : 0);
  return begins;
}

}  // namespace

std::optional<PacketNews> packet_news(std::string_view line) {
  PacketNews news;
  if (take(line, "[Stream 80] ")) {
    news.stream = StreamKind::kColor;
  } else if (!take(line, "[Stream 70] ")) {
    return std::nullopt;
  }
  if (line.starts_with("Lost too many packets") || line.starts_with("Inconsistent flag")) {
    news.frame_dropped = true;
    return news;
  }
  if (!take(line, "Lost ")) {
    return std::nullopt;
  }
  auto const [end, error] = std::from_chars(line.data(), line.data() + line.size(), news.lost);
  line.remove_prefix(static_cast<std::size_t>(end - line.data()));
  bool const counts = error == std::errc() && news.lost > 0 && line.starts_with(" packets");
  return counts ? std::optional(news) : std::nullopt;
}

void LogTail::add(std::string_view line) {
  while (!line.empty() && (line.back() == '\n' || line.back() == '\r')) {
    line.remove_suffix(1);
  }
  std::scoped_lock const lock(mutex_);
  lines_.emplace_back(line);
  if (lines_.size() > kLinesKept) {
    lines_.pop_front();
  }
}

std::string LogTail::text() const {
  std::scoped_lock const lock(mutex_);
  std::string text;
  for (std::string const& line : lines_) {
    text += (text.empty() ? "" : "; ") + line;
  }
  return text;
}

void LogTail::clear() {
  std::scoped_lock const lock(mutex_);
  lines_.clear();
}

}  // namespace credo::freenect
