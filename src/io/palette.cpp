#include "io/palette.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace credo {
namespace {

constexpr Rgb kBlack = {0, 0, 0};

struct NamedColor {
  char const* name;
  Rgb color;
};

/// As many as can be told apart; none is like floor, walls or the cloud.
constexpr std::array<NamedColor, 24> kStuff = {
    {{"purple", {165, 80, 235}},    {"yellow", {245, 220, 40}},     {"green", {70, 205, 70}},
     {"orange", {250, 150, 40}},    {"light blue", {90, 120, 255}}, {"lime", {190, 240, 110}},
     {"brown", {165, 110, 70}},     {"mint", {130, 220, 190}},      {"olive", {150, 145, 30}},
     {"lavender", {205, 185, 255}}, {"teal", {10, 125, 120}},       {"peach", {255, 210, 165}},
     {"slate", {115, 135, 160}},    {"navy", {50, 60, 170}},        {"gold", {205, 165, 20}},
     {"moss", {70, 125, 45}},       {"plum", {120, 45, 140}},       {"cream", {250, 245, 190}},
     {"jade", {20, 180, 130}},      {"rust", {190, 95, 25}},        {"steel blue", {60, 130, 200}},
     {"khaki", {200, 200, 130}},    {"mocha", {110, 75, 60}},       {"silver", {195, 205, 205}}}};

constexpr std::array<Rgb, 6> kObjects = {{{255, 0, 255},
                                          {70, 110, 255},
                                          {0, 220, 130},
                                          {255, 90, 90},
                                          {200, 160, 255},
                                          {120, 200, 255}}};

}  // namespace

Rgb mixed(Rgb a, Rgb b, double share_of_b) {
  Rgb result{};
  for (std::size_t c = 0; c < 3; ++c) {
    result[c] =
        static_cast<std::uint8_t>(std::lround((1.0 - share_of_b) * a[c] + share_of_b * b[c]));
  }
  return result;
}

Rgb depth_grey(float depth_m) {
  if (std::isnan(depth_m)) {
    return kBlack;
  }
  auto const level = static_cast<std::uint8_t>(std::clamp(255.0F - 42.0F * depth_m, 40.0F, 255.0F));
  return {level, level, level};
}

Rgb label_color(LabelCode label) {
  if (label == kNoDepth) {
    return kBlack;
  }
  if (label == kFloor) {
    return kRed;
  }
  if (is_wall(label)) {
    return mixed(kPink, {255, 255, 255}, 0.12 * ((label - kFirstWall) % 4));
  }
  if (is_object(label)) {
    return object_color(static_cast<std::size_t>(label - kFirstObject), 1.0);
  }
  return is_stuff(label) ? stuff_color(static_cast<std::uint32_t>(label - kFirstStuff), 1.0)
                         : kCyan;
}

Rgb object_color(std::size_t object, double probability) {
  return mixed(kBackground, kObjects[object % kObjects.size()], std::clamp(probability, 0.25, 1.0));
}

Rgb stuff_color(std::uint32_t id, double probability) {
  return mixed(kBackground, kStuff[id % kStuff.size()].color, std::clamp(probability, 0.15, 1.0));
}

char const* stuff_color_name(std::uint32_t id) {
  return kStuff[id % kStuff.size()].name;
}

}  // namespace credo
