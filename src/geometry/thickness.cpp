#include "geometry/thickness.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace credo {
namespace {

struct Extent {
  std::int64_t area = 0;
  /// Of pixels, towards other labels.
  std::int64_t sides = 0;
};

}  // namespace

std::map<LabelCode, double> thickness_px(LabelMap const& labels) {
  LabelCode const last = labels.empty() ? LabelCode{0} : std::ranges::max(labels);
  std::vector<Extent> extents(last + std::size_t{1});
  auto const part = [&](LabelCode one, LabelCode other) {
    if (one != other) {
      ++extents[one].sides;
      ++extents[other].sides;
    }
  };
  for (int v = 0; v < labels.height(); ++v) {
    std::span<LabelCode const> const row = labels.row(v);
    std::span<LabelCode const> const below = labels.row(std::min(v + 1, labels.height() - 1));
    for (std::size_t u = 0; u < row.size(); ++u) {
      ++extents[row[u]].area;
      part(row[u], below[u]);
      part(row[u], row[std::min(u + 1, row.size() - 1)]);
    }
  }
  constexpr double kSidesOfSquare = 4.0;
  std::map<LabelCode, double> thickness;
  for (std::size_t label = kFirstStuff; label <= last; ++label) {
    Extent const& extent = extents[label];
    if (extent.area > 0) {
      thickness[static_cast<LabelCode>(label)] =
          kSidesOfSquare * static_cast<double>(extent.area) /
          static_cast<double>(std::max<std::int64_t>(1, extent.sides));
    }
  }
  return thickness;
}

}  // namespace credo
