#include "status_line.hpp"

#include <spdlog/fmt/fmt.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cstdio>
#include <utility>

namespace credo {
namespace {

constexpr auto kRedraw = std::chrono::milliseconds(100);
constexpr auto kNewLine = std::chrono::seconds(5);
constexpr std::uint64_t kLostTold = 10;

}  // namespace

StatusLine::StatusLine() : terminal_(isatty(STDERR_FILENO) != 0), last_shown_(Clock::now()) {}

bool StatusLine::is_due() const {
  auto const since = Clock::now() - last_shown_;
  return since >= (terminal_ ? Clock::duration(kRedraw) : Clock::duration(kNewLine));
}

void StatusLine::show(std::string const& line) {
  fmt::print(stderr, "{}{}{}", terminal_ ? "\r" : "", line, terminal_ ? "\033[K" : "\n");
  std::fflush(stderr);
  line_open_ = terminal_;
  last_shown_ = Clock::now();
}

void StatusLine::finish() {
  if (line_open_) {
    fmt::print(stderr, "\r\033[K");
    line_open_ = false;
  }
}

void LossLog::add(FrameFailure const& failure, StatusLine& line) {
  std::uint64_t const told = ++by_reason_[failure.reason];
  if (told > kLostTold) {
    return;
  }
  line.finish();
  spdlog::warn("frame {} lost: {}: {}{}", number(failure.index), failure.reason, failure.message,
               told == kLostTold ? " (more of these are only counted)" : "");
}

std::string counts_text(std::map<std::string, std::uint64_t> const& counts) {
  std::string text;
  for (auto const& [reason, count] : counts) {
    text += fmt::format("{}{} {}", text.empty() ? " (" : ", ", count, reason);
  }
  return text.empty() ? text : text + ")";
}

void log_to_stderr() {
  auto logger = spdlog::stderr_color_mt("credo");
  logger->set_pattern("%^%l%$: %v");
  spdlog::set_default_logger(std::move(logger));
}

}  // namespace credo
