#include "openni/registration_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <stdexcept>

namespace credo {
namespace {

constexpr int kFramesPerLook = 5;
/// Lines of pixels that are searched for edges are so far apart.
constexpr int kLineSpacing_px = 4;
/// Depth edges are ragged and colour edges blurred by about this.
constexpr int kBlur_px = 2;
/// How far beside an edge colour is looked at for comparison.
constexpr int kBeside_px = 8;
/// Two places must be so far apart to tell them from each other.
constexpr int kLeastMove_px = 2 * kBlur_px + 2;
/// What a plain surface may change by noise, over three channels.
constexpr float kFaint = 12.0F;
/// Depth that differs by this share belongs to different things...
constexpr float kJump = 0.12F;
/// ... and to the same one by this.
constexpr float kSame = 0.05F;
/// So many pixels within an edge must be of the same thing.
constexpr int kSolid_px = 3;
/// No depth where the projector's light is hidden by what stands in front: so wide, for near
/// things.
constexpr int kShadow_px = 50;

constexpr int kColumns = 10;
constexpr int kRows = 8;
constexpr int kLeastEdges = 6;
constexpr int kLeastParts = 8;
constexpr double kClear = 5.0;
constexpr double kClearMean = 0.15;
constexpr double kLead = 3.0;

/// Where something in front ends: its outermost pixel, and the axis along which depth jumps.
struct DepthEdge {
  Pixel pixel;
  float z_m = 0.0F;
  bool horizontal = true;
};

/// A row or a column of a depth image.
struct Line {
  float const* first_m;
  int step;
  int length;

  [[nodiscard]] float operator[](int i) const { return first_m[i * step]; }
};

bool is_solid(Line const& line, int edge, int inwards) {
  int const innermost = edge + kSolid_px * inwards;
  if (innermost < 0 || innermost >= line.length) {
    return false;
  }
  for (int i = edge; i != innermost; i += inwards) {
    if (!(std::abs(line[i + inwards] - line[edge]) < kSame * line[edge])) {
      return false;
    }
  }
  return true;
}

/// Calls `found` with the position of each edge on a line. A shadow may lie beside it.
template <typename Found>
void find_edges(Line const& line, Found const& found) {
  int last = -1 - kShadow_px;
  for (int i = 0; i < line.length; ++i) {
    float const here = line[i];
    if (!(here > 0.0F)) {
      continue;
    }
    if (last >= 0 && i - last <= kShadow_px) {
      float const before = line[last];
      bool const in_front = here < before;
      int const edge = in_front ? i : last;
      if (std::abs(here - before) > kJump * std::max(here, before) &&
          is_solid(line, edge, in_front ? 1 : -1)) {
        found(edge);
      }
    }
    last = i;
  }
}

std::vector<DepthEdge> depth_edges(Grid<float> const& depth_m) {
  std::vector<DepthEdge> edges;
  auto const add = [&](Pixel pixel, bool horizontal) {
    edges.push_back({.pixel = pixel, .z_m = depth_m[pixel], .horizontal = horizontal});
  };
  for (int v = kLineSpacing_px / 2; v < depth_m.height(); v += kLineSpacing_px) {
    find_edges({depth_m.row(v).data(), 1, depth_m.width()}, [&](int u) { add({u, v}, true); });
  }
  for (int u = kLineSpacing_px / 2; u < depth_m.width(); u += kLineSpacing_px) {
    find_edges({depth_m.data() + u, depth_m.width(), depth_m.height()}, [&](int v) {
      add({u, v}, false);
    });
  }
  return edges;
}

/// How much larger a change is than another, -1 to 1; near 0 where both are faint.
float contrast(float here, float there) {
  return (here - there) / (here + there + kFaint);
}

/// Change of colour across an edge.
struct ColorChange {
  float here;
  /// Compared with both sides.
  float lead;
};

class ColorEdges {
public:
  explicit ColorEdges(Grid<Rgb> const& color) : color_(color) {}

  /// None where a part of what is compared lies outside of the image.
  [[nodiscard]] std::optional<ColorChange> across(Pixel pixel, bool horizontal) const {
    constexpr int kReach_px = kBeside_px + kBlur_px + 1;
    int const position = horizontal ? pixel.u : pixel.v;
    int const length = horizontal ? color_.width() : color_.height();
    if (!color_.contains(pixel) || position < kReach_px || position >= length - kReach_px) {
      return {};
    }
    int const step = horizontal ? 1 : color_.width();
    Rgb const* const at = color_.data() + color_.index(pixel);
    float const here = change(at, step);
    float const beside =
        0.5F * (change(at - kBeside_px * step, step) + change(at + kBeside_px * step, step));
    return ColorChange{.here = here, .lead = contrast(here, beside)};
  }

private:
  /// The largest within the blur, all channels added.
  static float change(Rgb const* at, int step) {
    int most = 0;
    for (int k = -kBlur_px; k <= kBlur_px; ++k) {
      Rgb const& before = at[(k - 1) * step];
      Rgb const& after = at[(k + 1) * step];
      most = std::max(most, std::abs(before[0] - after[0]) + std::abs(before[1] - after[1]) +
                                std::abs(before[2] - after[2]));
    }
    return static_cast<float>(most);
  }

  Grid<Rgb> const& color_;
};

/// Where the colour camera sees an edge, if it is as the depth camera sees it. Like register_depth.
std::optional<Pixel> registered(DepthEdge const& edge, DepthCalibration const& calibration) {
  CameraIntrinsics const& depth = calibration.depth;
  CameraIntrinsics const& color = calibration.color;
  double const z = edge.z_m;
  Eigen::Vector3d const p = calibration.T_color_depth *
                            Eigen::Vector3d((edge.pixel.u - depth.cx_px) / depth.fx_px * z,
                                            (edge.pixel.v - depth.cy_px) / depth.fy_px * z, z);
  double const u_px = p.x() / p.z() * color.fx_px + color.cx_px;
  double const v_px = p.y() / p.z() * color.fy_px + color.cy_px;
  // Far outside of any image, or no place at all: whole numbers could not hold it.
  constexpr double kFar_px = 1e6;
  if (!(p.z() > 0.0) || !(std::abs(u_px) < kFar_px) || !(std::abs(v_px) < kFar_px)) {
    return {};
  }
  return Pixel{static_cast<int>(std::lround(u_px)), static_cast<int>(std::lround(v_px))};
}

}  // namespace

RegistrationCheck::RegistrationCheck(DepthCalibration const& calibration)
    : calibration_(calibration), parts_(static_cast<std::size_t>(kColumns * kRows)) {
  // It refuses calibrations that say nothing.
  (void)register_depth({}, calibration, 0, 0);
}

Registration RegistrationCheck::add(Grid<float> const& depth_m, Grid<Rgb> const& color) {
  bool const comparable = !depth_m.empty() && depth_m.same_size(color);
  if (decision_ == Registration::kUndecided && comparable && frames_++ % kFramesPerLook == 0) {
    look(depth_m, color);
    decision_ = judged();
  }
  return decision_;
}

void RegistrationCheck::look(Grid<float> const& depth_m, Grid<Rgb> const& color) {
  ColorEdges const colors(color);
  for (DepthEdge const& edge : depth_edges(depth_m)) {
    auto const moved = registered(edge, calibration_);
    if (!moved) {
      continue;
    }
    int const move_px = edge.horizontal ? moved->u - edge.pixel.u : moved->v - edge.pixel.v;
    auto const as_delivered = colors.across(edge.pixel, edge.horizontal);
    auto const once_registered = colors.across(*moved, edge.horizontal);
    if (std::abs(move_px) < kLeastMove_px || !as_delivered || !once_registered) {
      continue;
    }
    int const column = edge.pixel.u * kColumns / depth_m.width();
    int const row = edge.pixel.v * kRows / depth_m.height();
    Part& part = parts_[static_cast<std::size_t>(row * kColumns + column)];
    ++part.edges;
    part.delivered += contrast(as_delivered->here, once_registered->here);
    part.as_delivered += as_delivered->lead;
    part.once_registered += once_registered->lead;
  }
}

RegistrationScore RegistrationCheck::score(double Part::*sum) const {
  double count = 0.0;
  double total = 0.0;
  double squares = 0.0;
  for (Part const& part : parts_) {
    if (part.edges >= kLeastEdges) {
      double const mean = part.*sum / part.edges;
      count += 1.0;
      total += mean;
      squares += mean * mean;
    }
  }
  if (count < 2.0) {
    return {};
  }
  double const mean = total / count;
  // Not below rounding: parts that agree to the last bit would be infinitely sure.
  double const variance = std::max((squares - total * mean) / (count - 1.0), 1e-6);
  return {.mean = mean, .significance = mean / std::sqrt(variance / count)};
}

RegistrationEvidence RegistrationCheck::evidence() const {
  auto const counts = [](Part const& part) { return part.edges >= kLeastEdges; };
  return {.parts = static_cast<int>(std::ranges::count_if(parts_, counts)),
          .delivered = score(&Part::delivered),
          .as_delivered = score(&Part::as_delivered),
          .once_registered = score(&Part::once_registered)};
}

Registration RegistrationCheck::judged() const {
  RegistrationEvidence const e = evidence();
  double const clear = std::abs(e.delivered.mean) >= kClearMean ? e.delivered.significance : 0.0;
  if (e.parts < kLeastParts) {
    return Registration::kUndecided;
  }
  if (clear >= kClear && e.as_delivered.significance >= kLead) {
    return Registration::kRegistered;
  }
  if (clear <= -kClear && e.once_registered.significance >= kLead) {
    return Registration::kUnregistered;
  }
  return Registration::kUndecided;
}

}  // namespace credo
