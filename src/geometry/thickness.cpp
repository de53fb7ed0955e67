#include "geometry/thickness.hpp"

#include <algorithm>
#include <cstdint>

namespace credo {
namespace {

struct Extent {
  std::int64_t area = 0;
  /// Of pixels, towards other labels.
  std::int64_t sides = 0;
};

}  // namespace

std::map<LabelCode, double> thickness_px(LabelMap const& labels) {
  std::map<LabelCode, Extent> extents;
  auto const differs = [&](Pixel const& beside, LabelCode label) {
    return labels.contains(beside) && labels[beside] != label;
  };
  for (int v = 0; v < labels.height(); ++v) {
    for (int u = 0; u < labels.width(); ++u) {
      LabelCode const label = labels[{u, v}];
      if (!is_stuff(label)) {
        continue;
      }
      Extent& extent = extents[label];
      ++extent.area;
      for (Pixel const& beside :
           {Pixel{u - 1, v}, Pixel{u + 1, v}, Pixel{u, v - 1}, Pixel{u, v + 1}}) {
        extent.sides += differs(beside, label) ? 1 : 0;
      }
    }
  }
  constexpr double kSidesOfSquare = 4.0;
  std::map<LabelCode, double> thickness;
  for (auto const& [label, extent] : extents) {
    thickness[label] = kSidesOfSquare * static_cast<double>(extent.area) /
                       static_cast<double>(std::max<std::int64_t>(1, extent.sides));
  }
  return thickness;
}

}  // namespace credo
