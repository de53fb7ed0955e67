#include "stages/segments/parts/outlines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "stages/segments/segments.hpp"

namespace credo::segments {
namespace {

/// From the other side.
Meeting turned(Meeting meeting) {
  std::swap(meeting.before, meeting.behind);
  return meeting;
}

class OutlineBuilder {
public:
  OutlineBuilder(Segments const& segments, LabelledRows const& rows, Grid<float> const& depth_m,
                 float link_per_m)
      : rows_(rows),
        depth_m_(depth_m),
        link_per_m_(link_per_m),
        outlines_(segments.pixel_counts.size() + 1) {
    for (std::size_t i = 0; i < segments.pixel_counts.size(); ++i) {
      outlines_[i + 1].pixels = segments.pixel_counts[i];
    }
  }

  std::vector<Outline> outlines() && {
    for (int v = 0; v < depth_m_.height(); ++v) {
      look_along(v);
      if (v > 0) {
        look_up(v);
      }
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
  /// Where segments meet, found again without a search: borders go on from row to row.
  struct Recent {
    std::int32_t lower = 0;
    std::int32_t higher = 0;
    Meeting* meeting = nullptr;
  };
  static constexpr std::size_t kRecent = 256;
  static constexpr int kRowsAhead = 3;

  Outline& outline(std::int32_t label) { return outlines_[static_cast<std::size_t>(label)]; }

  /// Seen from the lower label.
  Meeting& meeting_of(std::int32_t lower, std::int32_t higher) {
    auto const place = static_cast<std::size_t>(lower) * 31 + static_cast<std::size_t>(higher);
    Recent& recent = recent_[place % kRecent];
    if (recent.lower != lower || recent.higher != higher) {
      recent = {lower, higher, &outline(lower).meetings[higher]};
    }
    return *recent.meeting;
  }

  /// The runs of a row, and what is between them.
  void look_along(int v) {
    std::span<LabelRun const> const runs = rows_.row(v);
    for (std::size_t i = 0; i < runs.size(); ++i) {
      LabelRun const& run = runs[i];
      if (run.label != 0) {
        outline(run.label).box.add({{run.begin, v}, {run.end - 1, v}});
      }
      if (i + 1 < runs.size()) {
        look({run.end - 1, v}, run.label, {run.end, v}, runs[i + 1].label);
      }
    }
  }

  void look_up(int v) {
    auto above = rows_.row(v - 1).begin();
    for (LabelRun const& run : rows_.row(v)) {
      for (int u = run.begin; u < run.end;) {
        int const end = std::min(run.end, above->end);
        for (; u < end && above->label != run.label; ++u) {
          look({u, v - 1}, above->label, {u, v}, run.label);
        }
        u = end;
        above += above->end == end ? 1 : 0;
      }
    }
  }

  /// At neighbours p of label a and q of label b.
  void look(Pixel p, std::int32_t a, Pixel q, std::int32_t b) {
    if (a == 0 || b == 0) {
      return;
    }
    // Borders go on from row to row: what is fetched by then is not waited for.
    __builtin_prefetch(&depth_m_[{p.u, std::min(p.v + kRowsAhead, depth_m_.height() - 1)}]);
    float const nearer_per_m = 1.0F / depth_m_[p] - 1.0F / depth_m_[q];
    Meeting& meeting = meeting_of(std::min(a, b), std::max(a, b));
    if (std::abs(nearer_per_m) < link_per_m_) {
      ++meeting.touching;
      meeting.touch.add({p, q});
    } else {
      bool const is_before = nearer_per_m > 0.0F;
      ++(is_before == (a < b) ? meeting.before : meeting.behind);
    }
  }

  LabelledRows const& rows_;
  Grid<float> const& depth_m_;
  float link_per_m_;
  std::vector<Outline> outlines_;
  std::array<Recent, kRecent> recent_;
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

PixelBox PixelBox::shared_with(PixelBox const& other) const {
  return {{std::max(first.u, other.first.u), std::max(first.v, other.first.v)},
          {std::min(last.u, other.last.u), std::min(last.v, other.last.v)}};
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

std::vector<Outline> outlines_of(Segments const& segments, LabelledRows const& rows,
                                 Grid<float> const& depth_m, float link_per_m) {
  return OutlineBuilder(segments, rows, depth_m, link_per_m).outlines();
}

std::uint32_t least_touching_pairs(double focal_px) {
  return static_cast<std::uint32_t>(std::max(1L, std::lround(4.0 * focal_px / kReferenceFocal_px)));
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
