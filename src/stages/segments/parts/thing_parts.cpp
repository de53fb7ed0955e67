#include "stages/segments/parts/thing_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/plane.hpp"
#include "core/runs.hpp"
#include "geometry/ray_plane_fit.hpp"
#include "stages/segments/labelled_rows.hpp"
#include "stages/segments/numbering.hpp"
#include "stages/segments/parts/outlines.hpp"
#include "stages/segments/parts/quadratic_fit.hpp"

namespace credo {
namespace {

using segments::LabelledRows;
using segments::LabelRun;
using segments::Meeting;
using segments::Outline;
using segments::PixelBox;
using segments::QuadraticFit;

using Labels = std::vector<std::int32_t>;

/// Shares of the pairs of an outline. Seen on vessels: behind their front 0.4 to 0.5 of it, before
/// the background 0.27 to 0.5.
constexpr double kRim = 0.15;
constexpr double kHardly = 0.1;
/// What sticks out may be behind what it sticks out of by so much.
constexpr double kPartlyHidden = 0.25;
/// Of the pairs with what it sticks out of, those that touch: what is only before it touches it in
/// places.
constexpr double kContact = 0.6;
/// A vessel's inside is at most so many times what is seen of its outside.
constexpr double kLargestInside = 4.0;
/// What sticks out is at most this part of what it sticks out of.
constexpr double kLargestAttachment = 0.25;
/// Quanta that a surface rises from its middle's tangent to its ends, twice: hollow beyond the one,
/// a thing inside beyond the other.
constexpr double kHollow_quanta = 10.0;
constexpr double kBulging_quanta = -20.0;
/// The same where it also goes on in the outside: twice what the noise of 300 pixels bends.
constexpr double kSeamHollow_quanta = 4.0;
/// Level within 11 degrees is what things stand on, and no vessel's outside. Seen: table tops 0.998
/// and more, mugs from above up to 0.95.
constexpr double kTableTopCosine = 0.98;

/// What stands on a level surface is so high above it, but for a tenth of it.
constexpr double kOnIt_quanta = 2.0;
/// Of what is larger, not all pixels are looked at for its bend and its place.
constexpr std::uint32_t kEnoughPixels = 4096;

class PartJoiner {
public:
  PartJoiner(Segments const& segments, LabelledRows const& rows, Grid<float> const& depth_m,
             CameraIntrinsics const& intrinsics, std::optional<Eigen::Vector3d> const& up_camera,
             SegmentsConfig const& config)
      : segments_(segments),
        depth_m_(depth_m),
        intrinsics_(intrinsics),
        up_camera_(up_camera),
        quantum_per_m_(config.quantum_per_m),
        disc_px_(static_cast<int>(std::lround(scaled(config.disc_radius_px)))),
        least_pairs_(segments::least_touching_pairs(intrinsics.fx_px)),
        outlines_(
            segments::outlines_of(segments, rows, depth_m,
                                  static_cast<float>(config.link_quanta * config.quantum_per_m))),
        root_(outlines_.size()) {
    std::iota(root_.begin(), root_.end(), 0);
  }

  /// What each label has gone into.
  Labels joined() && {
    auto const end = static_cast<std::int32_t>(outlines_.size());
    for (std::int32_t label = 1; label < end; ++label) {
      join_inside(label);
    }
    if (up_camera_) {
      for (std::int32_t label = 1; label < end; ++label) {
        join_attachment(label);
      }
    }
    return std::move(root_);
  }

private:
  [[nodiscard]] double scaled(double at_reference_px) const {
    return at_reference_px * intrinsics_.fx_px / kReferenceFocal_px;
  }
  [[nodiscard]] Outline const& outline(std::int32_t label) const {
    return outlines_[static_cast<std::size_t>(label)];
  }
  [[nodiscard]] bool touches(Meeting const& meeting) const {
    return meeting.touching >= least_pairs_;
  }

  /// If a segment is a vessel's inside, or a part of it, joins all of that to the outside.
  void join_inside(std::int32_t label) {
    auto const& meetings = outline(label).meetings;
    auto const front = std::ranges::max_element(
        meetings, {}, [](auto const& meeting) { return meeting.second.behind; });
    if (front == meetings.end() || front->second.behind < least_pairs_) {
      return;
    }
    std::int32_t const outside = front->first;
    Labels const inside = is_seamed(label, outside) ? Labels{label} : hollow_within(label, outside);
    if (!inside.empty() && !is_far_behind(inside, outside) &&
        !(up_camera_ && is_table_top(outside))) {
      for (std::int32_t const part : inside) {
        join(outside, part);
      }
    }
  }

  /// Whether a segment goes on in `outside` beside where that hides it, as a vessel's inside does
  /// at the ends of its rim.
  [[nodiscard]] bool is_seamed(std::int32_t label, std::int32_t outside) const {
    auto const [with_outside, with_others] = meetings_of({label}, {label}, outside);
    double const pairs = with_outside.pairs() + with_others.pairs();
    return outline(label).pixels <= kLargestInside * outline(outside).pixels &&
           is_between(with_outside, with_others) && with_outside.touching > kRim * pairs &&
           with_others.touching <= kRim * pairs && !is_cut_off_beside({label}, outside) &&
           bend_quanta({label}) > kSeamHollow_quanta;
  }

  /// What is with a segment behind `outside`, if that is a hollow that touches nothing else.
  [[nodiscard]] Labels hollow_within(std::int32_t label, std::int32_t outside) const {
    Labels const found = island(label, outside);
    if (!lies_within(found, found, outside) || is_cut_off_beside(found, outside)) {
      return {};
    }
    // Things in it stay apart.
    Labels inside = found;
    std::erase_if(inside, [&](std::int32_t part) { return bend_quanta({part}) < kBulging_quanta; });
    bool const hollow = lies_within(inside, found, outside) && bend_quanta(inside) > kHollow_quanta;
    return hollow ? inside : Labels{};
  }

  /// What a segment is connected with by touch, not counting what is through `without`. Empty where
  /// that is more than the inside of `without` may be.
  [[nodiscard]] Labels island(std::int32_t label, std::int32_t without) const {
    double const most_px = kLargestInside * outline(without).pixels;
    double pixels = outline(label).pixels;
    Labels members = {label};
    for (std::size_t i = 0; i < members.size() && pixels <= most_px; ++i) {
      for (auto const& [other, meeting] : outline(members[i]).meetings) {
        if (touches(meeting) && other != without &&
            std::ranges::find(members, other) == members.end()) {
          members.push_back(other);
          pixels += outline(other).pixels;
        }
      }
    }
    return pixels <= most_px ? members : Labels{};
  }

  /// Whether `outside` is in front of some segments, nothing else is, and they are themselves in
  /// front of what is beyond; but for what else is on their island.
  [[nodiscard]] bool lies_within(Labels const& inside, Labels const& island,
                                 std::int32_t outside) const {
    auto const [with_outside, with_others] = meetings_of(inside, island, outside);
    return is_between(with_outside, with_others);
  }

  [[nodiscard]] static bool is_between(Meeting const& with_outside, Meeting const& with_others) {
    double const pairs = with_outside.pairs() + with_others.pairs();
    return with_outside.behind > kRim * pairs && with_others.before > kRim * pairs &&
           with_others.behind <= kHardly * with_outside.behind;
  }

  /// Where some segments meet `outside`, and what else there is but their island.
  [[nodiscard]] std::pair<Meeting, Meeting> meetings_of(Labels const& parts, Labels const& island,
                                                        std::int32_t outside) const {
    std::pair<Meeting, Meeting> found;
    for (std::int32_t const part : parts) {
      for (auto const& [other, meeting] : outline(part).meetings) {
        if (other == outside) {
          found.first.add(meeting);
        } else if (std::ranges::find(island, other) == island.end()) {
          found.second.add(meeting);
        }
      }
    }
    return found;
  }

  /// Whether the image's border cuts some segments off where it does not cut off `outside`: a
  /// vessel's front is before and beneath all of its inside, so that the border cuts both, but at
  /// the top. Beneath a table the floor goes on.
  [[nodiscard]] bool is_cut_off_beside(Labels const& inside, std::int32_t outside) const {
    int const last_u = depth_m_.width() - 1;
    int const last_v = depth_m_.height() - 1;
    PixelBox const& front = outline(outside).box;
    return std::ranges::any_of(inside, [&](std::int32_t part) {
      PixelBox const& box = outline(part).box;
      return (box.first.u == 0 && front.first.u > 0) ||
             (box.last.u == last_u && front.last.u < last_u) ||
             (box.last.v == last_v && front.last.v < last_v);
    });
  }

  /// Whether some segments are farther behind `outside` than all of them together are large: a
  /// vessel is as deep as it is wide, and what something else hides the foot of is not its inside.
  [[nodiscard]] bool is_far_behind(Labels const& inside, std::int32_t outside) const {
    double pixels = outline(outside).pixels;
    for (std::int32_t const part : inside) {
      pixels += outline(part).pixels;
    }
    double const front_m = mean_depth_m({outside});
    double const size_m = std::sqrt(pixels) / intrinsics_.fx_px * front_m;
    return mean_depth_m(inside) - front_m > size_m;
  }

  [[nodiscard]] double mean_depth_m(Labels const& parts) const {
    double sum_m = 0.0;
    double pixels = 0.0;
    for (std::int32_t const part : parts) {
      for_runs(part, outline(part).box, rows_apart(part), [&](int v, int begin, int end) {
        for (int u = begin; u < end; ++u) {
          sum_m += static_cast<double>(depth_m_[Pixel{u, v}]);
        }
        pixels += end - begin;
      });
    }
    return sum_m / std::max(1.0, pixels);
  }

  /// How a surface bends over its size: of the quadratic that fits its inverse depth, the second
  /// differences over the square root of its pixels, both axes together. Positive where hollow.
  [[nodiscard]] double bend_quanta(Labels const& parts) const {
    double pixels = 0.0;
    for (std::int32_t const part : parts) {
      pixels += outline(part).pixels;
    }
    if (pixels < 1.0) {
      return 0.0;
    }
    Pixel const origin = outline(parts.front()).box.first;
    QuadraticFit fit;
    std::vector<double> quanta;
    for (std::int32_t const part : parts) {
      for_runs(part, outline(part).box, rows_apart(part), [&](int v, int begin, int end) {
        quanta.clear();
        for (int u = begin; u < end; ++u) {
          quanta.push_back(quanta_at({u, v}));
        }
        fit.add(begin - origin.u, v - origin.v, quanta);
      });
    }
    return fit.bend(std::sqrt(pixels));
  }

  /// Joins a segment to the only one that it touches, if it is small and does not rest on it.
  void join_attachment(std::int32_t label) {
    Outline const& part = outline(label);
    std::int32_t holder = 0;
    Meeting with_holder;
    Meeting with_others;
    for (auto const& [other, meeting] : part.meetings) {
      if (!touches(meeting)) {
        with_others.add(meeting);
      } else if (holder == 0) {
        holder = other;
        with_holder = meeting;
      } else {
        return;
      }
    }
    double const pairs = with_holder.pairs() + with_others.pairs();
    bool const sticks_out = with_others.before > kRim * pairs &&
                            with_holder.touching >= kContact * with_holder.pairs() &&
                            with_holder.behind <= kPartlyHidden * pairs &&
                            with_others.behind <= kHardly * pairs;
    if (holder == 0 || !sticks_out || is_cut_off(part.box) ||
        part.pixels > kLargestAttachment * outline(holder).pixels) {
      return;
    }
    if (!stands_on(label, holder, with_holder.touch)) {
      join(holder, label);
    }
  }

  [[nodiscard]] bool is_cut_off(PixelBox const& box) const {
    return box.first.u == 0 || box.first.v == 0 || box.last.u == depth_m_.width() - 1 ||
           box.last.v == depth_m_.height() - 1;
  }

  /// Whether another segment is level around where a segment touches it, and that one rises above
  /// it. What does not is its rim, or hangs from it.
  [[nodiscard]] bool stands_on(std::int32_t label, std::int32_t holder,
                               PixelBox const& touch) const {
    PixelBox const around = touch.grown(disc_px_, depth_m_.width(), depth_m_.height());
    std::optional<Plane> const plane = plane_of(holder, around, 1);
    if (!plane || plane->normal.dot(*up_camera_) <= segments::kLevelCosine) {
      return false;
    }
    std::uint32_t above = 0;
    for_runs(label, outline(label).box, 1, [&](int v, int begin, int end) {
      for (int u = begin; u < end; ++u) {
        double const above_per_m = inverse_depth_error_per_m(*plane, point_m({u, v}));
        above += above_per_m > kOnIt_quanta * quantum_per_m_ ? 1U : 0U;
      }
    });
    return above > kHardly * outline(label).pixels;
  }

  [[nodiscard]] bool is_table_top(std::int32_t label) const {
    std::optional<Plane> const plane = plane_of(label, outline(label).box, rows_apart(label));
    return plane && plane->normal.dot(*up_camera_) > kTableTopCosine;
  }

  /// Of what of a segment is in a box, the plane, if it has one.
  [[nodiscard]] std::optional<Plane> plane_of(std::int32_t label, PixelBox const& box,
                                              int rows_apart) const {
    RayPlaneFit fit;
    for_runs(label, box, rows_apart, [&](int v, int begin, int end) {
      for (int u = begin; u < end; ++u) {
        fit.add(point_m({u, v}));
      }
    });
    return fit.plane();
  }

  /// Rows that tell enough of a segment: some thousand pixels.
  [[nodiscard]] int rows_apart(std::int32_t label) const {
    return 1 + static_cast<int>(outline(label).pixels / kEnoughPixels);
  }

  /// Calls `visit(v, begin, end)` for the runs of a label and of what has gone into it, in rows so
  /// far apart.
  template <typename Visit>
  void for_runs(std::int32_t label, PixelBox const& box, int rows_apart, Visit const& visit) const {
    for (int v = box.first.v; v <= box.last.v; v += rows_apart) {
      auto const row = segments_.labels.row(v).first(static_cast<std::size_t>(box.last.u + 1));
      std::size_t end = 0;
      for (auto begin = static_cast<std::size_t>(box.first.u); begin < row.size(); begin = end) {
        end = run_end(row, begin);
        if (root_[static_cast<std::size_t>(row[begin])] == label) {
          visit(v, static_cast<int>(begin), static_cast<int>(end));
        }
      }
    }
  }

  /// Camera frame.
  [[nodiscard]] Eigen::Vector3d point_m(Pixel p) const {
    auto const z_m = static_cast<double>(depth_m_[p]);
    return {(p.u - intrinsics_.cx_px) / intrinsics_.fx_px * z_m,
            (p.v - intrinsics_.cy_px) / intrinsics_.fy_px * z_m, z_m};
  }
  [[nodiscard]] double quanta_at(Pixel p) const {
    return 1.0 / (static_cast<double>(depth_m_[p]) * quantum_per_m_);
  }

  void join(std::int32_t into, std::int32_t from) {
    segments::join_outlines(outlines_, into, from);
    std::ranges::replace(root_, from, into);
  }

  Segments const& segments_;
  Grid<float> const& depth_m_;
  CameraIntrinsics const& intrinsics_;
  std::optional<Eigen::Vector3d> const& up_camera_;
  double quantum_per_m_;
  int disc_px_;
  std::uint32_t least_pairs_;
  std::vector<Outline> outlines_;
  Labels root_;
};

}  // namespace

Segments join_parts(Segments segments, Grid<float> const& depth_m,
                    CameraIntrinsics const& intrinsics,
                    std::optional<Eigen::Vector3d> const& up_camera, SegmentsConfig const& config) {
  LabelledRows const rows(segments.labels);
  segments::Numbering numbering(
      PartJoiner(segments, rows, depth_m, intrinsics, up_camera, config).joined());
  for (int v = 0; v < segments.labels.height(); ++v) {
    std::span<std::int32_t> const row = segments.labels.row(v);
    for (auto const [begin, end, label] : rows.row(v)) {
      std::int32_t const number = numbering.number(label, static_cast<std::size_t>(end - begin));
      if (label != number) {
        std::fill(row.begin() + begin, row.begin() + end, number);
      }
    }
  }
  segments.pixel_counts = std::move(numbering).pixel_counts();
  return segments;
}

}  // namespace credo
