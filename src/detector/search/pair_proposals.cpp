#include "detector/search/pair_proposals.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <unordered_map>

namespace credo {
namespace {

constexpr std::size_t kTurns = 32;
constexpr unsigned kTurnShift = 11;  // of 16 bits
constexpr int kLeastSegment_px = 60;
constexpr std::size_t kKeysPerReference = 8;
constexpr std::size_t kFewestReferences = 8;
constexpr std::size_t kMostReferences = 24;
/// Where other objects are known there is less to look at, and it was missed before.
constexpr std::size_t kMoreBesideKnown = 2;
constexpr std::size_t kMostPeaks = 6;
constexpr float kLeastPeak = 0.5F;
/// Pairs that are longer seldom show both ends, and cost most.
constexpr float kReach_diameters = 0.6F;
constexpr std::uint16_t kSameSegmentVotes = 2;

/// A point of the scene that pairs begin and end with.
struct Key {
  Eigen::Vector3f point;
  Eigen::Vector3f normal;
  std::uint16_t segment;
};

using Cell = std::uint64_t;

Cell cell_of(Eigen::Vector3i const& cell) {
  constexpr std::uint64_t kMask = (1ULL << 21U) - 1;
  return ((static_cast<std::uint64_t>(cell.x()) & kMask) << 42U) |
         ((static_cast<std::uint64_t>(cell.y()) & kMask) << 21U) |
         (static_cast<std::uint64_t>(cell.z()) & kMask);
}

Eigen::Vector3i cell_at(Eigen::Vector3f const& point, float size_m) {
  return (point / size_m).array().floor().cast<int>();
}

bool fits(SceneSegment const& segment, SearchModel const& model) {
  float const d_m = model.diameter_m;
  bool const too_large = segment.extent_m > 1.2F * d_m && segment.area_m2 > 1.5F * d_m * d_m;
  return segment.pixels >= kLeastSegment_px && !too_large;
}

/// One point for each cube of the pairs' step: the first in raster order.
std::vector<Key> keys_of(SearchScene const& scene, SearchModel const& model, float step_m,
                         ClaimedPixels const& explained) {
  std::unordered_map<Cell, std::uint32_t> taken;
  std::vector<Key> keys;
  for (int v = 0; v < scene.pixels.height(); v += 2) {
    for (int u = 0; u < scene.pixels.width(); u += 2) {
      ScenePixel const& pixel = scene.pixels[{u, v}];
      if (!pixel.has_normal() || pixel.segment == 0 ||
          scene.is_background(pixel, model.diameter_m) ||
          (!explained.empty() && explained[{u, v}] != 0)) {
        continue;
      }
      Eigen::Vector3f const point = scene.point_at({u, v});
      if (taken.try_emplace(cell_of(cell_at(point, step_m)), 0).second) {
        keys.push_back({point, pixel.normal_camera().normalized(), pixel.segment});
      }
    }
  }
  return keys;
}

/// Votes for a point of the model, in the table's order, and a turn.
class Votes {
public:
  explicit Votes(std::size_t references) : counts_(references * kTurns) {}

  void clear() { std::ranges::fill(counts_, 0); }
  void add(std::uint16_t reference, std::uint16_t turn, std::uint16_t count) {
    std::uint16_t& votes = counts_[reference * kTurns + (turn >> kTurnShift)];
    votes = static_cast<std::uint16_t>(votes + count);
  }

  struct Peak {
    std::size_t reference = 0;
    float turn_rad = 0.0F;
  };
  /// The best, and what comes close to it elsewhere; clears them.
  std::vector<Peak> take_peaks() {
    std::vector<std::uint16_t> tops;  // of each reference
    for (std::size_t row = 0; row < counts_.size(); row += kTurns) {
      tops.push_back(top_from(row));
    }
    std::vector<Peak> peaks;
    float best = 0.0F;
    while (peaks.size() < kMostPeaks) {
      auto const reference =
          static_cast<std::size_t>(std::ranges::max_element(tops) - tops.begin());
      std::uint16_t const top = tops[reference];
      best = std::max(best, static_cast<float>(top));
      if (top == 0 || static_cast<float>(top) < kLeastPeak * best) {
        break;
      }
      auto const row = counts_.begin() + static_cast<std::ptrdiff_t>(reference * kTurns);
      auto const turn = static_cast<std::size_t>(std::find(row, row + kTurns, top) - row);
      peaks.push_back(peak_at(reference, turn));
      tops[reference] = top_from(reference * kTurns);
    }
    return peaks;
  }

private:
  /// A loop that compilers turn into vectors, as they do not std::max_element.
  [[nodiscard]] std::uint16_t top_from(std::size_t row) const {
    std::uint16_t top = 0;
    for (std::size_t turn = 0; turn < kTurns; ++turn) {
      top = std::max(top, counts_[row + turn]);
    }
    return top;
  }
  Peak peak_at(std::size_t reference, std::size_t turn) {
    std::uint16_t* row = counts_.data() + reference * kTurns;
    std::size_t const before = (turn + kTurns - 1) % kTurns;
    std::size_t const after = (turn + 1) % kTurns;
    auto const sum = static_cast<float>(row[before] + row[turn] + row[after]);
    float const shift = (static_cast<float>(row[after]) - static_cast<float>(row[before])) / sum;
    row[before] = row[turn] = row[after] = 0;
    constexpr float kStep_rad = 2.0F * std::numbers::pi_v<float> / static_cast<float>(kTurns);
    return {reference, (static_cast<float>(turn) + 0.5F + shift) * kStep_rad};
  }

  std::vector<std::uint16_t> counts_;
};

std::uint16_t coded_turn(float turn_rad) {
  return static_cast<std::uint16_t>(
      static_cast<std::int32_t>(std::lround(turn_rad * (32768.0F / std::numbers::pi_v<float>))) &
      0xFFFF);
}

/// The keys around each place.
class KeyCells {
public:
  KeyCells(std::vector<Key> const& keys, float reach_m) : keys_(keys), reach_m_(reach_m) {
    for (std::size_t i = 0; i < keys.size(); ++i) {
      cells_[cell_of(cell_at(keys[i].point, reach_m))].push_back(static_cast<std::uint32_t>(i));
    }
  }
  template <typename Visit>
  void near(Eigen::Vector3f const& point, Visit const& visit) const {
    Eigen::Vector3i const centre = cell_at(point, reach_m_);
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= 1; ++y) {
        for (int z = -1; z <= 1; ++z) {
          auto const found = cells_.find(cell_of(centre + Eigen::Vector3i(x, y, z)));
          if (found == cells_.end()) {
            continue;
          }
          for (std::uint32_t const i : found->second) {
            if ((keys_[i].point - point).squaredNorm() <= reach_m_ * reach_m_) {
              visit(keys_[i]);
            }
          }
        }
      }
    }
  }

private:
  std::vector<Key> const& keys_;
  float reach_m_;
  std::unordered_map<Cell, std::vector<std::uint32_t>> cells_;
};

CameraPose pose_of(NormalFrame const& scene_frame, NormalFrame const& model_frame, float turn_rad) {
  Eigen::Matrix3f const turned =
      Eigen::AngleAxisf(turn_rad, Eigen::Vector3f::UnitX()).toRotationMatrix();
  Eigen::Matrix3f const back = scene_frame.rotation.transpose();
  CameraPose pose;
  pose.rotation = back * turned * model_frame.rotation;
  pose.translation_m = back * (turned * model_frame.translation_m - scene_frame.translation_m);
  return pose;
}

/// Of each segment that fits, some of its keys, evenly; `more` times as many as usual.
std::vector<std::uint32_t> references_of(std::vector<Key> const& keys, SearchScene const& scene,
                                         SearchModel const& model, std::size_t more) {
  std::vector<std::vector<std::uint32_t>> of_segment(scene.segments.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    of_segment[keys[i].segment - 1U].push_back(static_cast<std::uint32_t>(i));
  }
  std::vector<std::uint32_t> references;
  for (std::size_t s = 0; s < of_segment.size(); ++s) {
    std::vector<std::uint32_t> const& own = of_segment[s];
    if (!fits(scene.segments[s], model)) {
      continue;
    }
    std::size_t const usual =
        std::clamp(own.size() / kKeysPerReference, kFewestReferences, kMostReferences);
    std::size_t const count = std::min(own.size(), more * usual);
    for (std::size_t i = 0; i < count; ++i) {
      references.push_back(own[(2 * i + 1) * own.size() / (2 * count)]);
    }
  }
  return references;
}

}  // namespace

std::vector<Proposal> propose_by_pairs(SearchModel const& model, PairTable const& pairs,
                                       SearchScene const& scene, ClaimedPixels const& explained) {
  std::vector<Key> const keys = keys_of(scene, model, pairs.step_m(), explained);
  KeyCells const cells(keys, kReach_diameters * model.diameter_m);
  Votes votes(pairs.references().size());
  std::vector<Proposal> proposals;
  bool const something_known =
      std::ranges::any_of(explained, [](std::uint8_t known) { return known != 0; });
  std::size_t const more = something_known ? kMoreBesideKnown : 1;
  for (std::uint32_t const reference : references_of(keys, scene, model, more)) {
    Key const& from = keys[reference];
    NormalFrame const frame(from.point, from.normal);
    votes.clear();
    cells.near(from.point, [&](Key const& to) {
      if (&to == &from) {
        return;
      }
      std::span<PairTable::Entry const> const alike =
          pairs.like(PairFeature::of(from.point, from.normal, to.point, to.normal, pairs.step_m()));
      if (alike.size() > pairs.references().size()) {
        return;  // such pairs are all over the model: they tell no place on it
      }
      std::uint16_t const turn = coded_turn(frame.turn_of(to.point));
      std::uint16_t const count = to.segment == from.segment ? kSameSegmentVotes : 1;
      for (PairTable::Entry const& entry : alike) {
        votes.add(entry.reference, static_cast<std::uint16_t>(turn - entry.turn), count);
      }
    });
    for (Votes::Peak const& peak : votes.take_peaks()) {
      std::uint16_t const of_model = pairs.references()[peak.reference];
      NormalFrame const model_frame(model.points_model[of_model], model.normals_model[of_model]);
      proposals.push_back({pose_of(frame, model_frame, peak.turn_rad), from.segment});
    }
  }
  return proposals;
}

}  // namespace credo
