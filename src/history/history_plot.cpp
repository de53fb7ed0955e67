#include "history/history_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include "io/svg.hpp"

namespace credo {
namespace {

/// Apart for those who do not tell red from green, too.
char const* color_of(Evidence evidence) {
  switch (evidence) {
    case Evidence::kSeen:
      return "#009e73";
    case Evidence::kSeenThrough:
      return "#d55e00";
    case Evidence::kOccluded:
      return "#e6ac00";
    case Evidence::kOutOfView:
      return "#56b4e9";
    case Evidence::kNotSeen:
      break;
  }
  return "#999999";
}

/// From below.
struct PointBand {
  PointState state;
  Evidence color;
  char const* text;
};
constexpr std::array<PointBand, 5> kPointBands = {{
    {PointState::kAgrees, Evidence::kSeen, "agree"},
    {PointState::kOccluded, Evidence::kOccluded, "are hidden"},
    {PointState::kUnmeasured, Evidence::kNotSeen, "have no depth"},
    {PointState::kOutOfView, Evidence::kOutOfView, "are out of view"},
    {PointState::kSeenThrough, Evidence::kSeenThrough, "are seen through"},
}};

/// Moments of successive frames, the first and one past the last.
using Stretch = std::pair<std::size_t, std::size_t>;

std::vector<Stretch> stretches_of(ThingHistory const& history) {
  std::vector<Stretch> stretches;
  for (Span const& span : spans_of(history)) {
    bool const goes_on = span.begin > 0 && history.moments[span.begin].at.position ==
                                               history.moments[span.begin - 1].at.position + 1;
    if (goes_on) {
      stretches.back().second = span.end;
    } else {
      stretches.emplace_back(span.begin, span.end);
    }
  }
  return stretches;
}

SvgAxes time_axes(ThingHistory const& history) {
  constexpr double kLeastTime_s = 0.01;
  double const first_s = history.moments.front().at.time_s;
  double const last_s = history.gone ? history.gone->time_s : history.moments.back().at.time_s;
  SvgAxes axes;
  axes.x_step = rounded_up(std::max(kLeastTime_s, last_s - first_s) / 8.0);
  axes.x_min = axes.x_step * std::floor(first_s / axes.x_step + 1e-9);
  axes.x_max = std::max(last_s, axes.x_min + axes.x_step);
  return axes;
}

/// Each span goes on until the next begins, or the thing is gone.
std::string bands(SvgAxes const& axes, ThingHistory const& history) {
  std::string body;
  for (Span const& span : spans_of(history)) {
    double const begin_s = history.moments[span.begin].at.time_s;
    double end_s = history.moments[span.end - 1].at.time_s;
    if (span.end < history.moments.size()) {
      end_s = history.moments[span.end].at.time_s;
    } else if (history.gone) {
      end_s = history.gone->time_s;
    }
    body += svg_box(axes.x(begin_s), axes.top, std::max(1.0, axes.x(end_s) - axes.x(begin_s)),
                    axes.height, std::string(color_of(span.evidence)) + "\" fill-opacity=\"0.3");
  }
  return body;
}

template <typename Value>
std::string curve(SvgAxes const& axes, ThingHistory const& history, Value const& value) {
  std::string body;
  for (auto const& [begin, end] : stretches_of(history)) {
    std::vector<SvgPoint> points;
    for (std::size_t i = begin; i < end; ++i) {
      points.push_back({history.moments[i].at.time_s, value(history.moments[i])});
    }
    // One point alone draws no line.
    points.push_back(points.back());
    body += svg_path(axes, points,
                     R"(fill="none" stroke="black" stroke-width="2" stroke-linecap="square")");
  }
  return body;
}

std::string level(SvgAxes const& axes, double value, std::string const& text) {
  return svg_line(axes.left, axes.y(value), axes.left + axes.width, axes.y(value),
                  R"(stroke="#444" stroke-dasharray="5 3")") +
         svg_text(axes.left + axes.width + 10, axes.y(value) + 4, "start", text);
}

std::string probability_strip(SvgAxes const& axes, ThingHistory const& history,
                              BeliefLimits const& limits) {
  std::string body = bands(axes, history);
  body += svg_axes(axes, history.name + ": probability that it is there");
  if (limits.min_probability && history.kind == ThingKind::kStuff) {
    body += level(axes, *limits.min_probability, "forgotten below");
  }
  return body + curve(axes, history, [](Moment const& m) { return m.probability; });
}

std::string log_odds_strip(SvgAxes axes, ThingHistory const& history, BeliefLimits const& limits) {
  double largest = limits.max_log_odds.value_or(0.0);
  for (Moment const& moment : history.moments) {
    if (std::isfinite(moment.log_odds)) {
      largest = std::max(largest, std::abs(moment.log_odds));
    }
  }
  axes.y_max = rounded_up(largest);
  axes.y_min = -axes.y_max;
  std::string body = bands(axes, history);
  body += svg_axes(axes, "log-odds of that, ln(p / (1 - p))");
  if (limits.max_log_odds) {
    body += level(axes, *limits.max_log_odds, "bound");
    body += level(axes, -*limits.max_log_odds, "bound");
  }
  return body + curve(axes, history, [&](Moment const& m) {
           return std::clamp(m.log_odds, axes.y_min, axes.y_max);
         });
}

/// Of a moment's points, the parts in the bands up to each, in percent.
std::array<double, 6> sums_of(Account const& why) {
  double all = 0.0;
  std::array<double, 6> sums{};
  for (std::size_t b = 0; b < kPointBands.size(); ++b) {
    all += why.points[kPointBands.at(b).state];
    sums.at(b + 1) = all;
  }
  for (double& sum : sums) {
    sum *= all > 0.0 ? 100.0 / all : 0.0;
  }
  return sums;
}

std::string points_strip(SvgAxes axes, ThingHistory const& history) {
  axes.y_max = 100.0;
  std::string body;
  for (auto const& [begin, end] : stretches_of(history)) {
    for (std::size_t b = 0; b < kPointBands.size(); ++b) {
      std::vector<SvgPoint> outline;
      for (std::size_t i = begin; i < end; ++i) {
        outline.push_back({history.moments[i].at.time_s, sums_of(history.moments[i].why).at(b)});
      }
      for (std::size_t i = end; i > begin; --i) {
        Moment const& moment = history.moments[i - 1];
        outline.push_back({moment.at.time_s, sums_of(moment.why).at(b + 1)});
      }
      body += svg_path(
          axes, outline,
          "fill=\"" + std::string(color_of(kPointBands.at(b).color)) + "\" fill-opacity=\"0.6\"");
    }
  }
  body += svg_axes(axes, "points of its surface that ... [%]");
  for (std::size_t b = 0; b < kPointBands.size(); ++b) {
    double const y = axes.top + axes.height - 12 - 18 * static_cast<double>(b);
    body += svg_box(axes.left + axes.width + 10, y - 10, 12, 12,
                    std::string(color_of(kPointBands.at(b).color)) + "\" fill-opacity=\"0.6");
    body += svg_text(axes.left + axes.width + 28, y, "start", kPointBands.at(b).text);
  }
  return body;
}

std::string legend(SvgAxes const& axes) {
  std::string body;
  double y = axes.top + 10;
  for (Evidence const evidence : {Evidence::kSeen, Evidence::kSeenThrough, Evidence::kOccluded,
                                  Evidence::kOutOfView, Evidence::kNotSeen}) {
    body += svg_box(axes.left + axes.width + 10, y - 10, 12, 12,
                    std::string(color_of(evidence)) + "\" fill-opacity=\"0.3");
    body += svg_text(axes.left + axes.width + 28, y, "start", evidence_text(evidence));
    y += 18;
  }
  return body;
}

/// The frames at the times of the axis, below its numbers.
std::string frame_numbers(SvgAxes const& axes, ThingHistory const& history) {
  std::string body;
  double const end_s = axes.x_max + 1e-6 * axes.x_step;
  for (double time_s = axes.x_min; time_s <= end_s; time_s += axes.x_step) {
    auto const after = std::ranges::upper_bound(history.moments, time_s + 1e-6, {},
                                                [](Moment const& m) { return m.at.time_s; });
    if (after != history.moments.begin()) {
      body += svg_text(axes.x(time_s), axes.top + axes.height + 32, "middle",
                       std::to_string(number(std::prev(after)->at.frame)));
    }
  }
  double const right = axes.left + axes.width + 30;
  return body + svg_text(right, axes.top + axes.height + 16, "start", "time [s]") +
         svg_text(right, axes.top + axes.height + 32, "start", "frame");
}

}  // namespace

std::string history_plot(ThingHistory const& history, BeliefLimits const& limits) {
  SvgAxes axes = time_axes(history);
  std::string body = probability_strip(axes, history, limits) + legend(axes);
  axes.top += axes.height + 50;
  body += log_odds_strip(axes, history, limits);
  axes.top += axes.height + 50;
  body += points_strip(axes, history) + frame_numbers(axes, history);
  return svg_picture(780, axes.top + axes.height + 50, body);
}

}  // namespace credo
