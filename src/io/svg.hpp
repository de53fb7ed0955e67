#pragma once

#include <string>
#include <vector>

namespace credo {

// Pieces of SVG pictures that show numbers over an axis. All places are in pixels from the top
// left; texts may hold any characters.

/// A whole picture, on white.
[[nodiscard]] std::string svg_picture(double width, double height, std::string const& body);

/// `anchor`: start, middle or end of the text is at x.
[[nodiscard]] std::string svg_text(double x, double y, std::string const& anchor,
                                   std::string const& text);
/// `style`: attributes such as stroke="#888".
[[nodiscard]] std::string svg_line(double x1, double y1, double x2, double y2,
                                   std::string const& style);
[[nodiscard]] std::string svg_box(double x, double y, double width, double height,
                                  std::string const& fill);

/// A number in six digits at most.
[[nodiscard]] std::string svg_number(double value);

/// Where data are drawn, and how it is scaled.
struct SvgAxes {
  double left = 60;
  double top = 30;
  double width = 560;
  double height = 120;
  double x_min = 0;
  double x_max = 1;
  double x_step = 0.25;
  double y_min = 0;
  double y_max = 1;

  [[nodiscard]] double x(double value) const {
    return left + width * (value - x_min) / (x_max - x_min);
  }
  [[nodiscard]] double y(double value) const {
    return top + height * (1.0 - (value - y_min) / (y_max - y_min));
  }
};

/// A grid of four rows with its numbers, and the title above.
[[nodiscard]] std::string svg_axes(SvgAxes const& axes, std::string const& title);

/// The least of 1, 2, 5 times a power of ten that is not below the value; 1 for what is not above
/// 0.
[[nodiscard]] double rounded_up(double value);

struct SvgPoint {
  double x = 0;
  double y = 0;
  bool solid = true;
};

/// Through all points, or around them where it is filled.
[[nodiscard]] std::string svg_path(SvgAxes const& axes, std::vector<SvgPoint> const& points,
                                   std::string const& style);

/// A dot for each point, and lines between those that are at most `max_gap` apart; dashed to and
/// from points that are not solid.
[[nodiscard]] std::string svg_curve(SvgAxes const& axes, std::vector<SvgPoint> const& points,
                                    double max_gap, std::string const& color);

}  // namespace credo
