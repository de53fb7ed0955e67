#include "detector/models/pair_table.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <bitset>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "detector/models/surface_sample.hpp"

namespace credo {
namespace {

/// Spacing of the points that are paired, and step of their distances, in diameters: the first, but
/// down to the second for slender things, which would be left with few points, and those coarse
/// beside their thickness.
constexpr float kStep_diameters = 0.05F;
constexpr float kLeastStep_diameters = 0.022F;
constexpr float kPointsWanted = 400.0F;
/// A pair so near to the border of its cell, in steps, counts in the neighbour too.
constexpr float kSpill_steps = 0.3F;
constexpr float kTurn = 2.0F * std::numbers::pi_v<float>;

using ViewSet = std::bitset<162>;

float step_of(SearchModel const& model) {
  return std::clamp(std::sqrt(model.surface_m2 / kPointsWanted),
                    kLeastStep_diameters * model.diameter_m, kStep_diameters * model.diameter_m);
}

std::vector<ViewSet> views_showing(SearchModel const& model) {
  std::vector<ViewSet> showing(model.points_model.size());
  for (std::size_t v = 0; v < model.views.size(); ++v) {
    for (std::uint16_t const i : model.views[v].visible) {
      showing[i].set(v);
    }
  }
  return showing;
}

/// The arc cosine, by a polynomial that is off by less than 0.0001 rad (Abramowitz and Stegun
/// 4.4.45); the library's costs as much as all the rest of a pair.
float arc_cosine(float cosine) {
  float const x = std::min(std::abs(cosine), 1.0F);
  float const root = std::sqrt(1.0F - x);
  float const angle = root * (1.5707288F + x * (-0.2121144F + x * (0.0742610F - 0.0187293F * x)));
  return cosine < 0.0F ? std::numbers::pi_v<float> - angle : angle;
}

float angle_steps(float cosine) {
  constexpr float kPerRadian = PairFeature::kAngleSteps / std::numbers::pi_v<float>;
  return arc_cosine(cosine) * kPerRadian;
}

/// The angle of (x, y), off by less than 0.0003 rad (as arc_cosine, by 4.4.49's like).
float angle_of(float y, float x) {
  float const ax = std::abs(x);
  float const ay = std::abs(y);
  float const most = std::max(ax, ay);
  if (most == 0.0F) {
    return 0.0F;
  }
  float const ratio = std::min(ax, ay) / most;
  float const square = ratio * ratio;
  float angle =
      ratio * (0.9998660F +
               square * (-0.3302995F +
                         square * (0.1801410F + square * (-0.0851330F + square * 0.0208351F))));
  angle = ay > ax ? std::numbers::pi_v<float> / 2.0F - angle : angle;
  angle = x < 0.0F ? std::numbers::pi_v<float> - angle : angle;
  return y < 0.0F ? -angle : angle;
}

std::uint16_t coded(float turn_rad) {
  return static_cast<std::uint16_t>(
      static_cast<std::int32_t>(std::lround(turn_rad / kTurn * 65536.0F)) & 0xFFFF);
}

}  // namespace

Eigen::Vector4f PairFeature::of(Eigen::Vector3f const& from_point,
                                Eigen::Vector3f const& from_normal, Eigen::Vector3f const& to_point,
                                Eigen::Vector3f const& to_normal, float step_m) {
  Eigen::Vector3f const line = to_point - from_point;
  float const length_m = line.norm();
  float const inverse = length_m > 0.0F ? 1.0F / length_m : 0.0F;
  return {length_m / step_m, angle_steps(from_normal.dot(line) * inverse),
          angle_steps(to_normal.dot(line) * inverse), angle_steps(from_normal.dot(to_normal))};
}

NormalFrame::NormalFrame(Eigen::Vector3f const& point, Eigen::Vector3f const& normal) {
  rotation = Eigen::Quaternionf::FromTwoVectors(normal, Eigen::Vector3f::UnitX()).matrix();
  translation_m = -(rotation * point);
}

float NormalFrame::turn_of(Eigen::Vector3f const& other) const {
  Eigen::Vector3f const p = rotation * other + translation_m;
  return angle_of(p.z(), p.y());
}

PairTable::PairTable(SearchModel const& model)
    : step_m_(step_of(model)),
      distance_steps_(static_cast<int>(std::ceil(model.diameter_m / step_m_)) + 1) {
  for (std::uint32_t const i : apart(model.points_model, step_m_)) {
    references_.push_back(static_cast<std::uint16_t>(i));
  }
  std::vector<ViewSet> const showing = views_showing(model);
  std::vector<std::pair<std::uint32_t, Entry>> in_cells;
  for (std::size_t r = 0; r < references_.size(); ++r) {
    std::uint16_t const from = references_[r];
    NormalFrame const frame(model.points_model[from], model.normals_model[from]);
    for (std::uint16_t const to : references_) {
      if (to == from || (showing[from] & showing[to]).none()) {
        continue;
      }
      Eigen::Vector4f const feature =
          PairFeature::of(model.points_model[from], model.normals_model[from],
                          model.points_model[to], model.normals_model[to], step_m_);
      Entry const entry{static_cast<std::uint16_t>(r),
                        coded(frame.turn_of(model.points_model[to]))};
      Eigen::Array4i const low = (feature.array() - kSpill_steps).floor().cast<int>().max(0);
      Eigen::Array4i const high =
          (feature.array() + kSpill_steps)
              .floor()
              .cast<int>()
              .min(Eigen::Array4i(distance_steps_ - 1, PairFeature::kAngleSteps - 1,
                                  PairFeature::kAngleSteps - 1, PairFeature::kAngleSteps - 1));
      for (int d = low[0]; d <= high[0]; ++d) {
        for (int a = low[1]; a <= high[1]; ++a) {
          for (int b = low[2]; b <= high[2]; ++b) {
            for (int c = low[3]; c <= high[3]; ++c) {
              in_cells.emplace_back(static_cast<std::uint32_t>(cell({d, a, b, c})), entry);
            }
          }
        }
      }
    }
  }
  std::ranges::stable_sort(in_cells, {}, [](auto const& in_cell) { return in_cell.first; });
  std::size_t const cells = cell({distance_steps_, 0, 0, 0});
  begins_.assign(cells + 1, 0);
  for (auto const& [place, entry] : in_cells) {
    ++begins_[place + 1];
    entries_.push_back(entry);
  }
  for (std::size_t i = 1; i < begins_.size(); ++i) {
    begins_[i] += begins_[i - 1];
  }
}

std::size_t PairTable::cell(std::array<int, 4> const& steps) const {
  auto place = static_cast<std::size_t>(steps[0]);
  for (std::size_t axis = 1; axis < 4; ++axis) {
    place = place * PairFeature::kAngleSteps + static_cast<std::size_t>(steps[axis]);
  }
  return place;
}

std::span<PairTable::Entry const> PairTable::like(Eigen::Vector4f const& feature) const {
  constexpr int kLast = PairFeature::kAngleSteps - 1;
  auto const distance = static_cast<int>(feature[0]);
  if (distance >= distance_steps_) {
    return {};
  }
  std::size_t const place = cell({distance, std::min(static_cast<int>(feature[1]), kLast),
                                  std::min(static_cast<int>(feature[2]), kLast),
                                  std::min(static_cast<int>(feature[3]), kLast)});
  return {entries_.data() + begins_[place], entries_.data() + begins_[place + 1]};
}

}  // namespace credo
