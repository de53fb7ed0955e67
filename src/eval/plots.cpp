#include "eval/plots.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>

#include "io/svg.hpp"

namespace credo {
namespace {

constexpr std::array<char const*, 6> kColors = {"#1f77b4", "#d62728", "#2ca02c",
                                                "#9467bd", "#ff7f0e", "#17becf"};

using Lines = std::map<std::string, std::vector<SvgPoint>>;

Lines line_of(std::vector<FrameScores> const& trace, std::string const& name,
              std::function<std::optional<double>(FrameScores const&)> const& value) {
  Lines lines;
  for (FrameScores const& frame : trace) {
    if (auto const y = value(frame)) {
      lines[name].push_back({static_cast<double>(number(frame.frame)), *y});
    }
  }
  return lines;
}

Lines object_lines(std::vector<FrameScores> const& trace) {
  Lines lines;
  for (FrameScores const& frame : trace) {
    for (auto const& object : frame.objects) {
      lines[object.id].push_back(
          {static_cast<double>(number(frame.frame)), object.probability, object.is_there});
    }
  }
  return lines;
}

struct Strip {
  std::string title;
  Lines lines;
  /// 0: as the values need.
  double y_max = 0;
};

std::string drawn(Strip const& strip, SvgAxes axes) {
  double largest = 0.0;
  for (auto const& [name, points] : strip.lines) {
    for (SvgPoint const& point : points) {
      largest = std::max(largest, point.y);
    }
  }
  axes.y_max = strip.y_max > 0.0 ? strip.y_max : rounded_up(largest);
  std::string body = svg_axes(axes, strip.title);
  std::size_t index = 0;
  for (auto const& [name, points] : strip.lines) {
    std::string const color = kColors.at(index % kColors.size());
    body += svg_curve(axes, points, 1.5, color);
    if (strip.lines.size() > 1) {
      body += "<g fill=\"" + color + "\">" +
              svg_text(axes.left + axes.width + 10, axes.top + 12 + 15 * static_cast<double>(index),
                       "start", name) +
              "</g>\n";
    }
    ++index;
  }
  return body;
}

}  // namespace

std::string reliability_plot(ExistenceScores const& scores) {
  SvgAxes axes;
  axes.width = 360;
  axes.height = 360;
  std::uint64_t count = 0;
  for (ReliabilityBin const& bin : scores.reliability) {
    count += bin.count;
  }
  std::string body = svg_axes(axes, "share that was there, over the believed probability");
  body += svg_text(axes.left, axes.top + axes.height + 34, "start",
                   "ECE " + svg_number(scores.ece) + ", Brier " + svg_number(scores.brier));
  body += svg_line(axes.x(0), axes.y(0), axes.x(1), axes.y(1), "stroke=\"#888\"");
  for (ReliabilityBin const& bin : scores.reliability) {
    if (bin.count > 0) {
      double const share = static_cast<double>(bin.count) / static_cast<double>(count);
      double const x = axes.x(bin.mean_probability);
      double const y = axes.y(bin.observed);
      body += svg_line(x, axes.y(bin.mean_probability), x, y, "stroke=\"#d62728\"");
      body += "<circle cx=\"" + svg_number(x) + "\" cy=\"" + svg_number(y) + "\" r=\"" +
              svg_number(3.0 + 15.0 * std::sqrt(share)) +
              "\" fill=\"#1f77b4\" fill-opacity=\"0.6\"/>\n";
      body += svg_text(x, y - 6, "middle", std::to_string(bin.count));
    }
  }
  return svg_picture(480, 440, body);
}

std::string frames_plot(std::vector<FrameScores> const& trace) {
  std::vector<Strip> strips = {
      {"weighted overlap of the segments",
       line_of(trace, "wov", [](FrameScores const& f) { return f.weighted_overlap; }), 1.0},
      {"tilt of the floor [degrees]",
       line_of(trace, "floor", [](FrameScores const& f) { return f.floor_tilt_deg; })},
      {"known objects: mean error of the position [m]",
       line_of(trace, "m", [](FrameScores const& f) { return f.translation_m; })},
      {"known objects: mean error of the rotation [degrees]",
       line_of(trace, "deg", [](FrameScores const& f) { return f.rotation_deg; })},
      {"known objects: probability (dashed: not where it is believed to be)", object_lines(trace),
       1.0}};
  std::erase_if(strips, [](Strip const& strip) { return strip.lines.empty(); });
  SvgAxes axes;
  if (!trace.empty()) {
    axes.x_min = static_cast<double>(number(trace.front().frame));
    axes.x_max = std::max(axes.x_min + 1.0, static_cast<double>(number(trace.back().frame)));
    axes.x_step = std::max(1.0, rounded_up((axes.x_max - axes.x_min) / 10.0));
  }
  std::string body;
  for (Strip const& strip : strips) {
    body += drawn(strip, axes);
    axes.top += axes.height + 60;
  }
  return svg_picture(780, axes.top,
                     body + svg_text(axes.left + axes.width, axes.top - 20, "end", "frame"));
}

}  // namespace credo
