#include "history_text.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/belief.hpp"
#include "history/history_columns.hpp"
#include "rounding.hpp"

namespace credo {
namespace {

constexpr std::size_t kPlotColumns = 72;
constexpr int kPlotRows = 8;

struct Mark {
  Evidence evidence;
  char const* letter;
  /// Of the terminal.
  int color;
};
constexpr std::array<Mark, 5> kMarks = {{
    {Evidence::kSeen, "s", 32},
    {Evidence::kSeenThrough, "T", 31},
    {Evidence::kOccluded, "o", 33},
    {Evidence::kOutOfView, ".", 34},
    {Evidence::kNotSeen, "-", 37},
}};

Mark const& mark_of(Evidence evidence) {
  return *std::ranges::find(kMarks, evidence, &Mark::evidence);
}

std::string colored(std::string const& text, Evidence evidence, bool in_color) {
  return in_color ? fmt::format("\033[{}m{}\033[0m", mark_of(evidence).color, text) : text;
}

std::string kind_text(ThingHistory const& history) {
  switch (history.kind) {
    case ThingKind::kFloorPlane:
      return "the floor";
    case ThingKind::kWallPlane:
      return "a wall";
    case ThingKind::kObject:
      return "a known object, " + history.type;
    case ThingKind::kStuff:
      break;
  }
  return "a thing that nobody told of";
}

/// How a history ends, where it does so before the run.
std::string gone_text(ThingHistory const& history) {
  if (!history.gone) {
    return "";
  }
  auto const frame = number(history.gone->frame);
  if (history.kind != ThingKind::kStuff) {
    return fmt::format("not believed from frame {} on", frame);
  }
  if (!history.joined.empty()) {
    return fmt::format("one with {} from frame {} on", history.joined, frame);
  }
  return history.moments.back().log_odds < 0.0
             ? fmt::format("forgotten in frame {}", frame)
             : fmt::format("gone from frame {} on: seen through, or one with something else",
                           frame);
}

std::string share_text(std::optional<std::array<double, 5>> const& shares, PointState state) {
  return shares ? fmt::format("{:.0f}", 100.0 * shares->at(static_cast<std::size_t>(state))) : "-";
}

std::string frames_text(Moment const& first, Moment const& last) {
  auto const a = number(first.at.frame);
  auto const b = number(last.at.frame);
  return a == b ? std::to_string(a) : fmt::format("{}-{}", a, b);
}

std::string span_row(ThingHistory const& history, Span const& span, bool in_color) {
  Moment const& first = history.moments[span.begin];
  Moment const& last = history.moments[span.end - 1];
  std::string const word = fmt::format("{:<13}", evidence_text(span.evidence));
  return fmt::format(
      "  {:<12}{:>8.2f} {:>8.2f}  {}{:>6}{:>8}{:>9}{:>8}{:>7}{:>8.2f}  {:>6.2f} to {:>5.2f}{} "
      "{:>7.3f} "
      "to {:.3f}\n",
      frames_text(first, last), rounded(first.at.time_s, 2), rounded(last.at.time_s, 2),
      colored(word, span.evidence, in_color), share_text(span.point_shares, PointState::kAgrees),
      share_text(span.point_shares, PointState::kOccluded),
      share_text(span.point_shares, PointState::kSeenThrough),
      share_text(span.point_shares, PointState::kUnmeasured),
      share_text(span.point_shares, PointState::kOutOfView), rounded(span.news, 2),
      rounded(span.log_odds_before, 2), rounded(span.log_odds_after, 2),
      span.bounded > 0 ? "*" : " ", probability_of(span.log_odds_before), last.probability);
}

std::string spans_text(ThingHistory const& history, std::vector<Span> const& spans, bool in_color) {
  std::string text = fmt::format(
      "  {:<12}{:^17}  {:<13}{:^38}{:>8}\n"
      "  {:<12}{:>8} {:>8}  {:<13}{:>6}{:>8}{:>9}{:>8}{:>7}{:>8}  {:>12}{:>20}\n",
      "", "time [s]", "", "of its points [%]", "news", "frames", "from", "to", "evidence", "agree",
      "hidden", "through", "blind", "out", "[looks]", "log-odds", "probability");
  bool bounded = false;
  for (Span const& span : spans) {
    text += span_row(history, span, in_color);
    bounded = bounded || span.bounded > 0;
  }
  return text + (bounded ? "  * at the bound of log-odds: more of the same adds nothing\n" : "");
}

/// What fills a cell `level` eighths of the way up.
char const* block(int eighths) {
  static constexpr std::array<char const*, 9> kBlocks = {" ", "▁", "▂", "▃", "▄",
                                                         "▅", "▆", "▇", "█"};
  return kBlocks.at(static_cast<std::size_t>(std::clamp(eighths, 0, 8)));
}

std::string plot_text(ThingHistory const& history, bool in_color) {
  auto const columns = columns_of(history, kPlotColumns);
  std::string text;
  for (int row = kPlotRows; row > 0; --row) {
    std::string const scale = row == kPlotRows ? "1.0" : row == kPlotRows / 2 ? "0.5" : "";
    text += fmt::format("{:>6} |", scale);
    for (auto const& column : columns) {
      int const height =
          column ? static_cast<int>(std::lround(8.0 * kPlotRows * column->probability)) : 0;
      std::string const cell = block(height - 8 * (row - 1));
      text += cell == " " ? cell : colored(cell, column->evidence, in_color);
    }
    text += "\n";
  }
  text += fmt::format("{:>6} +", "0.0");
  for (auto const& column : columns) {
    text += column ? colored(mark_of(column->evidence).letter, column->evidence, in_color) : " ";
  }
  text += fmt::format("\n        {:<{}}{}\n        ", number(history.moments.front().at.frame),
                      columns.size() > 8 ? columns.size() - 4 : columns.size() + 4,
                      number(history.moments.back().at.frame));
  for (Mark const& mark : kMarks) {
    text += colored(mark.letter, mark.evidence, in_color) + " " + evidence_text(mark.evidence) +
            (mark.evidence == kMarks.back().evidence ? "\n" : "   ");
  }
  return text;
}

/// Of a belief of unrelated frames, or a file that was changed.
std::string unaccounted_text(ThingHistory const& history) {
  auto const first = first_unaccounted(history);
  return first ? fmt::format(
                     "  From frame {} on its log-odds are not what the frames before and "
                     "`moved` make.\n",
                     number(history.moments[*first].at.frame))
               : "";
}

}  // namespace

std::string history_text(ThingHistory const& history, bool in_color) {
  Moment const& first = history.moments.front();
  Moment const& last = history.moments.back();
  std::string text = fmt::format(
      "{}: {}\n  first in frame {}, at {:.2f} s, with probability {:.3f}\n", history.name,
      kind_text(history), number(first.at.frame), first.at.time_s, first.probability);
  text += history.gone ? fmt::format("  last in frame {}, with {:.3f}; {}\n", number(last.at.frame),
                                     last.probability, gone_text(history))
                       : fmt::format("  in the run's last frame, {}, with {:.3f}\n",
                                     number(last.at.frame), last.probability);
  text += unaccounted_text(history);
  text += "\n" + spans_text(history, spans_of(history), in_color);
  return text + "\n  probability over frames\n" + plot_text(history, in_color);
}

std::string histories_table(std::vector<ThingHistory> const& histories) {
  std::string table = fmt::format("  {:<20}{:>7}{:>7}{:>8}{:>10}  {}\n", "id", "first", "last", "p",
                                  "moved by", "what happened last");
  for (ThingHistory const& history : histories) {
    std::vector<Span> const spans = spans_of(history);
    Span const& span = spans.back();
    Moment const& last = history.moments.back();
    std::string what = fmt::format("{} since frame {}", evidence_text(span.evidence),
                                   number(history.moments[span.begin].at.frame));
    what += history.gone ? ", " + gone_text(history) : "";
    table += fmt::format("  {:<20}{:>7}{:>7}{:>8.3f}{:>10.2f}  {}\n", history.name,
                         number(history.moments.front().at.frame), number(last.at.frame),
                         last.probability, rounded(travelled(history), 2), what);
  }
  return table;
}

}  // namespace credo
