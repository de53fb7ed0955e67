#include "io/svg.hpp"

#include <cmath>
#include <cstddef>
#include <sstream>

namespace credo {
namespace {

/// XML knows no control characters.
std::string escaped(std::string const& text) {
  std::string safe;
  for (char const c : text) {
    bool const control = static_cast<unsigned char>(c) < 0x20;
    safe += c == '<'   ? "&lt;"
            : c == '>' ? "&gt;"
            : c == '&' ? "&amp;"
                       : std::string(1, control ? ' ' : c);
  }
  return safe;
}

}  // namespace

std::string svg_number(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

std::string svg_picture(double width, double height, std::string const& body) {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + svg_number(width) + "\" height=\"" +
         svg_number(height) + "\" font-family=\"sans-serif\" font-size=\"12\">\n" +
         "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n" + body + "</svg>\n";
}

std::string svg_text(double x, double y, std::string const& anchor, std::string const& text) {
  return "<text x=\"" + svg_number(x) + "\" y=\"" + svg_number(y) + "\" text-anchor=\"" + anchor +
         "\">" + escaped(text) + "</text>\n";
}

std::string svg_line(double x1, double y1, double x2, double y2, std::string const& style) {
  return "<line x1=\"" + svg_number(x1) + "\" y1=\"" + svg_number(y1) + "\" x2=\"" +
         svg_number(x2) + "\" y2=\"" + svg_number(y2) + "\" " + style + "/>\n";
}

std::string svg_box(double x, double y, double width, double height, std::string const& fill) {
  return "<rect x=\"" + svg_number(x) + "\" y=\"" + svg_number(y) + "\" width=\"" +
         svg_number(width) + "\" height=\"" + svg_number(height) + "\" fill=\"" + fill + "\"/>\n";
}

std::string svg_axes(SvgAxes const& axes, std::string const& title) {
  std::string body = svg_text(axes.left, axes.top - 8, "start", title);
  for (int i = 0; i <= 4; ++i) {
    double const value = axes.y_min + (axes.y_max - axes.y_min) * i / 4;
    body += svg_line(axes.left, axes.y(value), axes.left + axes.width, axes.y(value),
                     "stroke=\"#ddd\"");
    body += svg_text(axes.left - 6, axes.y(value) + 4, "end", svg_number(value));
  }
  double const end = axes.x_max + 1e-6 * axes.x_step;
  for (double value = axes.x_min; value <= end; value += axes.x_step) {
    body += svg_text(axes.x(value), axes.top + axes.height + 16, "middle", svg_number(value));
  }
  return body;
}

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

std::string svg_path(SvgAxes const& axes, std::vector<SvgPoint> const& points,
                     std::string const& style) {
  std::string places;
  for (SvgPoint const& p : points) {
    places += (places.empty() ? "" : " ") + svg_number(axes.x(p.x)) + "," + svg_number(axes.y(p.y));
  }
  return "<polyline points=\"" + places + "\" " + style + "/>\n";
}

std::string svg_curve(SvgAxes const& axes, std::vector<SvgPoint> const& points, double max_gap,
                      std::string const& color) {
  std::string body;
  for (std::size_t i = 0; i < points.size(); ++i) {
    SvgPoint const& p = points[i];
    body += "<circle cx=\"" + svg_number(axes.x(p.x)) + "\" cy=\"" + svg_number(axes.y(p.y)) +
            "\" r=\"1.5\" fill=\"" + color + "\"/>\n";
    if (i > 0 && p.x - points[i - 1].x <= max_gap) {
      bool const solid = p.solid && points[i - 1].solid;
      body += svg_line(axes.x(points[i - 1].x), axes.y(points[i - 1].y), axes.x(p.x), axes.y(p.y),
                       "stroke=\"" + color + "\"" + (solid ? "" : " stroke-dasharray=\"3 3\""));
    }
  }
  return body;
}

}  // namespace credo
