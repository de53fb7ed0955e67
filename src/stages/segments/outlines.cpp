#include "stages/segments/outlines.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

namespace credo::segments {
namespace {

/// From the other side.
Meeting turned(Meeting meeting) {
  std::swap(meeting.before, meeting.behind);
  return meeting;
}

class OutlineBuilder {
public:
  OutlineBuilder(Segments const& segments, Grid<float> const& depth_m, float link_per_m)
      : labels_(segments.labels),
        depth_m_(depth_m),
        link_per_m_(link_per_m),
        outlines_(segments.pixel_counts.size() + 1) {
    for (std::size_t i = 0; i < segments.pixel_counts.size(); ++i) {
      outlines_[i + 1].pixels = segments.pixel_counts[i];
    }
  }

  std::vector<Outline> outlines() && {
    for (int v = 0; v < labels_.height(); ++v) {
      look_along(v);
    }
    for (std::size_t i = 1; i < outlines_.size(); ++i) {
      for (auto const& [other, meeting] : outlines_[i].meetings) {
        if (static_cast<std::size_t>(other) > i) {
          outline(other).meetings.emplace(static_cast<std::int32_t>(i), turned(meeting));
        }
      }
    }
    return std::move(outlines_);
  }

private:
  Outline& outline(std::int32_t label) { return outlines_[static_cast<std::size_t>(label)]; }

  /// The runs of a row, and what is right of and below them.
  void look_along(int v) {
    std::span<std::int32_t const> const row = labels_.row(v);
    bool const has_below = v + 1 < labels_.height();
    std::int32_t const* const below = has_below ? labels_.row(v + 1).data() : row.data();
    int const width = labels_.width();
    for (int u = 0; u < width;) {
      int const begin = u;
      std::int32_t const label = row[static_cast<std::size_t>(begin)];
      for (; u < width && row[static_cast<std::size_t>(u)] == label; ++u) {
        if (below[u] != label) {
          look({u, v}, {u, v + 1});
        }
      }
      if (label != 0) {
        outline(label).box.add({{begin, v}, {u - 1, v}});
      }
      if (u < width) {
        look({u - 1, v}, {u, v});
      }
    }
  }

  void look(Pixel p, Pixel q) {
    std::int32_t const a = labels_[p];
    std::int32_t const b = labels_[q];
    if (a == 0 || b == 0) {
      return;
    }
    float const nearer_per_m = 1.0F / depth_m_[p] - 1.0F / depth_m_[q];
    Meeting meeting;
    if (std::abs(nearer_per_m) < link_per_m_) {
      meeting.touching = 1;
      meeting.touch = {p, q};
    } else {
      (nearer_per_m > 0.0F ? meeting.before : meeting.behind) = 1;
    }
    if (a < b) {
      outline(a).meetings[b].add(meeting);
    } else {
      outline(b).meetings[a].add(turned(meeting));
    }
  }

  Grid<std::int32_t> const& labels_;
  Grid<float> const& depth_m_;
  float link_per_m_;
  std::vector<Outline> outlines_;
};

}  // namespace

void PixelBox::add(PixelBox const& other) {
  if (other.empty()) {
    return;
  }
  if (empty()) {
    *this = other;
    return;
  }
  first = {std::min(first.u, other.first.u), std::min(first.v, other.first.v)};
  last = {std::max(last.u, other.last.u), std::max(last.v, other.last.v)};
}

PixelBox PixelBox::grown(int by_px, int width, int height) const {
  return {{std::max(first.u - by_px, 0), std::max(first.v - by_px, 0)},
          {std::min(last.u + by_px, width - 1), std::min(last.v + by_px, height - 1)}};
}

void Meeting::add(Meeting const& other) {
  touching += other.touching;
  before += other.before;
  behind += other.behind;
  touch.add(other.touch);
}

std::vector<Outline> outlines_of(Segments const& segments, Grid<float> const& depth_m,
                                 float link_per_m) {
  return OutlineBuilder(segments, depth_m, link_per_m).outlines();
}

void join_outlines(std::vector<Outline>& outlines, std::int32_t into, std::int32_t from) {
  Outline& whole = outlines[static_cast<std::size_t>(into)];
  Outline part = std::move(outlines[static_cast<std::size_t>(from)]);
  outlines[static_cast<std::size_t>(from)] = {};
  whole.pixels += part.pixels;
  whole.box.add(part.box);
  whole.meetings.erase(from);
  part.meetings.erase(into);
  for (auto const& [other, meeting] : part.meetings) {
    whole.meetings[other].add(meeting);
    std::map<std::int32_t, Meeting>& beyond = outlines[static_cast<std::size_t>(other)].meetings;
    beyond.erase(from);
    beyond[into].add(turned(meeting));
  }
}

}  // namespace credo::segments
