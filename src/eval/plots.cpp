#include "eval/plots.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <sstream>

namespace credo {
namespace {

std::string text_of(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

std::string escaped(std::string const& text) {
  std::string safe;
  for (char const c : text) {
    safe += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
  }
  return safe;
}

std::string svg(double width, double height, std::string const& body) {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + text_of(width) + "\" height=\"" +
         text_of(height) + "\" font-family=\"sans-serif\" font-size=\"12\">\n" +
         "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n" + body + "</svg>\n";
}

/// Where data are drawn, and how it is scaled.
struct Axes {
  double left = 60;
  double top = 30;
  double width = 560;
  double height = 120;
  double x_min = 0;
  double x_max = 1;
  double x_step = 0.25;
  double y_max = 1;

  [[nodiscard]] double x(double value) const {
    return left + width * (value - x_min) / (x_max - x_min);
  }
  [[nodiscard]] double y(double value) const { return top + height * (1.0 - value / y_max); }
};

std::string label(double x, double y, std::string const& anchor, std::string const& text) {
  return "<text x=\"" + text_of(x) + "\" y=\"" + text_of(y) + "\" text-anchor=\"" + anchor + "\">" +
         escaped(text) + "</text>\n";
}

std::string line(double x1, double y1, double x2, double y2, std::string const& style) {
  return "<line x1=\"" + text_of(x1) + "\" y1=\"" + text_of(y1) + "\" x2=\"" + text_of(x2) +
         "\" y2=\"" + text_of(y2) + "\" " + style + "/>\n";
}

std::string drawn(Axes const& axes, std::string const& title) {
  std::string body = label(axes.left, axes.top - 8, "start", title);
  for (int i = 0; i <= 4; ++i) {
    double const value = axes.y_max * i / 4;
    body +=
        line(axes.left, axes.y(value), axes.left + axes.width, axes.y(value), "stroke=\"#ddd\"");
    body += label(axes.left - 6, axes.y(value) + 4, "end", text_of(value));
  }
  for (double value = axes.x_min; value <= axes.x_max; value += axes.x_step) {
    body += label(axes.x(value), axes.top + axes.height + 16, "middle", text_of(value));
  }
  return body;
}

/// The least of 1, 2, 5 times a power of ten that is not below the value.
double rounded_up(double value) {
  if (!(value > 0.0)) {
    return 1.0;
  }
  double const power = std::pow(10.0, std::floor(std::log10(value)));
  for (double const step : {1.0, 2.0, 5.0}) {
    if (value <= step * power) {
      return step * power;
    }
  }
  return 10.0 * power;
}

constexpr std::array<char const*, 6> kColors = {"#1f77b4", "#d62728", "#2ca02c",
                                                "#9467bd", "#ff7f0e", "#17becf"};

struct Point {
  double x = 0;
  double y = 0;
  bool solid = true;
};

std::string drawn(Axes const& axes, std::vector<Point> const& points, double max_gap,
                  std::string const& color) {
  std::string body;
  for (std::size_t i = 0; i < points.size(); ++i) {
    Point const& p = points[i];
    body += "<circle cx=\"" + text_of(axes.x(p.x)) + "\" cy=\"" + text_of(axes.y(p.y)) +
            "\" r=\"1.5\" fill=\"" + color + "\"/>\n";
    if (i > 0 && p.x - points[i - 1].x <= max_gap) {
      bool const solid = p.solid && points[i - 1].solid;
      body += line(axes.x(points[i - 1].x), axes.y(points[i - 1].y), axes.x(p.x), axes.y(p.y),
                   "stroke=\"" + color + "\"" + (solid ? "" : " stroke-dasharray=\"3 3\""));
    }
  }
  return body;
}

using Lines = std::map<std::string, std::vector<Point>>;

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

std::string drawn(Strip const& strip, Axes axes) {
  double largest = 0.0;
  for (auto const& [name, points] : strip.lines) {
    for (Point const& point : points) {
      largest = std::max(largest, point.y);
    }
  }
  axes.y_max = strip.y_max > 0.0 ? strip.y_max : rounded_up(largest);
  std::string body = drawn(axes, strip.title);
  std::size_t index = 0;
  for (auto const& [name, points] : strip.lines) {
    std::string const color = kColors.at(index % kColors.size());
    body += drawn(axes, points, 1.5, color);
    if (strip.lines.size() > 1) {
      body += "<g fill=\"" + color + "\">" +
              label(axes.left + axes.width + 10, axes.top + 12 + 15 * static_cast<double>(index),
                    "start", name) +
              "</g>\n";
    }
    ++index;
  }
  return body;
}

}  // namespace

std::string reliability_plot(ExistenceScores const& scores) {
  Axes axes;
  axes.width = 360;
  axes.height = 360;
  std::uint64_t count = 0;
  for (ReliabilityBin const& bin : scores.reliability) {
    count += bin.count;
  }
  std::string body = drawn(axes, "share that was there, over the believed probability");
  body += label(axes.left, axes.top + axes.height + 34, "start",
                "ECE " + text_of(scores.ece) + ", Brier " + text_of(scores.brier));
  body += line(axes.x(0), axes.y(0), axes.x(1), axes.y(1), "stroke=\"#888\"");
  for (ReliabilityBin const& bin : scores.reliability) {
    if (bin.count > 0) {
      double const share = static_cast<double>(bin.count) / static_cast<double>(count);
      double const x = axes.x(bin.mean_probability);
      double const y = axes.y(bin.observed);
      body += line(x, axes.y(bin.mean_probability), x, y, "stroke=\"#d62728\"");
      body += "<circle cx=\"" + text_of(x) + "\" cy=\"" + text_of(y) + "\" r=\"" +
              text_of(3.0 + 15.0 * std::sqrt(share)) +
              "\" fill=\"#1f77b4\" fill-opacity=\"0.6\"/>\n";
      body += label(x, y - 6, "middle", std::to_string(bin.count));
    }
  }
  return svg(480, 440, body);
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
  Axes axes;
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
  return svg(780, axes.top, body + label(axes.left + axes.width, axes.top - 20, "end", "frame"));
}

}  // namespace credo
