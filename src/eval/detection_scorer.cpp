#include "eval/detection_scorer.hpp"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <stdexcept>
#include <utility>

#include "eval/nees_bounds.hpp"
#include "geometry/pose_fusion.hpp"

namespace credo {
namespace {

constexpr int kResamples = 2000;
constexpr std::uint64_t kSeed = 1;
constexpr double kOuterShare = 0.025;
constexpr double kNoShare = std::numeric_limits<double>::quiet_NaN();

double share(std::size_t part, std::size_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : kNoShare;
}

bool in_band(double visible_fraction, VisibilityBand const& band) {
  return visible_fraction > band.low && visible_fraction <= band.high;
}

/// Of values in order.
double quantile(std::vector<double> const& sorted, double at) {
  return sorted[static_cast<std::size_t>(at * static_cast<double>(sorted.size() - 1) + 0.5)];
}

/// The measure of all scenes, and its spread where scenes are drawn anew with replacement.
template <typename Counts, typename Measure>
ScoredShare resampled(std::vector<Counts> const& scenes, Measure const& measure) {
  std::vector<std::size_t> drawn(scenes.size());
  std::iota(drawn.begin(), drawn.end(), std::size_t{0});
  ScoredShare result{measure(drawn), kNoShare, kNoShare};
  if (scenes.empty()) {
    return result;
  }
  std::mt19937_64 random(kSeed);
  std::uniform_int_distribution<std::size_t> any(0, scenes.size() - 1);
  std::vector<double> values;
  for (int i = 0; i < kResamples; ++i) {
    std::ranges::generate(drawn, [&] { return any(random); });
    double const value = measure(drawn);
    if (!std::isnan(value)) {
      values.push_back(value);
    }
  }
  if (!values.empty()) {
    std::ranges::sort(values);
    result.low = quantile(values, kOuterShare);
    result.high = quantile(values, 1.0 - kOuterShare);
  }
  return result;
}

NeesScores nees_scores(std::vector<double> values, double degrees_of_freedom) {
  NeesScores scores;
  scores.count = values.size();
  if (values.empty()) {
    return scores;
  }
  using boost::math::chi_squared;
  auto const count = static_cast<double>(values.size());
  std::ranges::sort(values);
  scores.mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
  scores.median = quantile(values, 0.5);
  NeesBounds const bounds = nees_bounds(count * degrees_of_freedom, values.size());
  scores.low_bound = bounds.low;
  scores.high_bound = bounds.high;
  double const limit = boost::math::quantile(chi_squared(degrees_of_freedom), 0.95);
  scores.coverage =
      static_cast<double>(std::ranges::count_if(values, [&](double v) { return v <= limit; })) /
      count;
  return scores;
}

}  // namespace

TrueModel const& DetectionScorer::model(std::string const& name) const {
  auto const found = models_.find(name);
  if (found == models_.end()) {
    throw std::logic_error("DetectionScorer: there is no model '" + name + "'");
  }
  return found->second;
}

void DetectionScorer::match(std::vector<Detection> const& detections,
                            std::vector<TrueInstance> const& truths) {
  std::vector<std::size_t> order(detections.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    return detections[a].score > detections[b].score;
  });
  matches_.assign(detections.size(), {});
  std::vector<std::array<bool, kPoseTiers.size()>> taken(truths.size());
  for (std::size_t const d : order) {
    Detection const& detection = detections[d];
    std::array<double, kPoseTiers.size()> nearest_m{};
    nearest_m.fill(std::numeric_limits<double>::infinity());
    for (std::size_t t = 0; t < truths.size(); ++t) {
      if (truths[t].model != detection.type) {
        continue;
      }
      auto const error =
          model(detection.type).error(detection.pose_camera.mean, truths[t].pose_camera);
      double const angle_deg = error.rotation_rad * 180.0 / std::numbers::pi;
      for (std::size_t tier = 0; tier < kPoseTiers.size(); ++tier) {
        if (!taken[t][tier] && error.translation_m < kPoseTiers[tier].translation_m &&
            angle_deg < kPoseTiers[tier].rotation_deg && error.translation_m < nearest_m[tier]) {
          nearest_m[tier] = error.translation_m;
          matches_[d][tier] = t;
        }
      }
    }
    for (std::size_t tier = 0; tier < kPoseTiers.size(); ++tier) {
      if (auto const t = matches_[d][tier]) {
        taken[*t][tier] = true;
      }
    }
  }
}

void DetectionScorer::add_distances(std::vector<Detection> const& detections,
                                    std::vector<TrueInstance> const& truths) {
  for (TrueInstance const& truth : truths) {
    if (truth.visible_fraction < kLeastVisible) {
      continue;
    }
    TrueModel const& known = model(truth.model);
    Symmetry const& symmetry = known.symmetry();
    bool const symmetric = symmetry.axis.has_value() || !symmetry.rotations.empty();
    double const limit_m = 0.1 * known.diameter_m();
    bool add = false;
    bool add_s = false;
    for (Detection const& detection : detections) {
      if (detection.type == truth.model) {
        Se3 const& pose = detection.pose_camera.mean;
        bool const surfaces_meet = known.add_s_m(pose, truth.pose_camera) < limit_m;
        add_s = add_s || surfaces_meet;
        add = add || (symmetric ? surfaces_meet : known.add_m(pose, truth.pose_camera) < limit_m);
      }
    }
    add_right_ += add ? 1 : 0;
    add_s_right_ += add_s ? 1 : 0;
  }
}

void DetectionScorer::add(std::vector<Detection> const& detections,
                          std::vector<TrueInstance> const& truths) {
  for (Detection const& detection : detections) {
    static_cast<void>(model(detection.type));
  }
  match(detections, truths);
  Scene scene;
  for (TrueInstance const& truth : truths) {
    scene.truths_visible_fraction.push_back(truth.visible_fraction);
  }
  for (std::size_t d = 0; d < detections.size(); ++d) {
    Judged judged{detections[d].score, {}};
    for (std::size_t tier = 0; tier < kPoseTiers.size(); ++tier) {
      if (auto const t = matches_[d][tier]) {
        judged.visible_fraction[tier] = truths[*t].visible_fraction;
      }
    }
    scene.detections.push_back(judged);
  }
  scenes_.push_back(std::move(scene));
  add_distances(detections, truths);
  for (std::size_t d = 0; d < detections.size(); ++d) {
    if (auto const t = matches_[d].front()) {
      PoseMatch const nees =
          match_pose({truths[*t].pose_camera, Matrix6d::Zero()}, detections[d].pose_camera,
                     model(detections[d].type).symmetry());
      (nees.degrees_of_freedom == 6 ? nees_6_ : nees_5_).push_back(nees.squared_distance);
    }
  }
}

DetectionScorer::Counts DetectionScorer::counts_of(Scene const& scene, std::size_t tier,
                                                   double from_score) {
  Counts counts;
  auto const count_bands = [](double visible, auto& bands) {
    for (std::size_t b = 0; b < kVisibilityBands.size(); ++b) {
      bands[b] += in_band(visible, kVisibilityBands[b]) ? 1 : 0;
    }
  };
  for (double const visible : scene.truths_visible_fraction) {
    counts.truths += visible >= kLeastVisible ? 1 : 0;
    count_bands(visible, counts.band_truths);
  }
  for (Judged const& detection : scene.detections) {
    if (detection.score < from_score) {
      continue;
    }
    auto const& visible = detection.visible_fraction[tier];
    if (!visible) {
      ++counts.detections;
      continue;
    }
    counts.detections += *visible >= kLeastVisible ? 1 : 0;
    counts.right += *visible >= kLeastVisible ? 1 : 0;
    count_bands(*visible, counts.band_right);
  }
  return counts;
}

TierScores DetectionScorer::tier_scores(std::size_t tier, double from_score) const {
  using Drawn = std::vector<std::size_t>;
  std::vector<Counts> scenes;
  scenes.reserve(scenes_.size());
  for (Scene const& scene : scenes_) {
    scenes.push_back(counts_of(scene, tier, from_score));
  }
  auto const sum = [&scenes](Drawn const& drawn, auto const& field) {
    std::size_t total = 0;
    for (std::size_t const scene : drawn) {
      total += field(scenes[scene]);
    }
    return total;
  };
  auto const right = [](Counts const& c) { return c.right; };
  auto const detected = [](Counts const& c) { return c.detections; };
  auto const truths = [](Counts const& c) { return c.truths; };
  Drawn all(scenes.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  TierScores scores;
  scores.right = sum(all, right);
  scores.detections = sum(all, detected);
  scores.truths = sum(all, truths);
  scores.precision = resampled(
      scenes, [&](Drawn const& drawn) { return share(sum(drawn, right), sum(drawn, detected)); });
  scores.recall = resampled(
      scenes, [&](Drawn const& drawn) { return share(sum(drawn, right), sum(drawn, truths)); });
  // Twice the product over the sum of both shares, also where nothing was detected.
  scores.f1 = resampled(scenes, [&](Drawn const& drawn) {
    return share(2 * sum(drawn, right), sum(drawn, detected) + sum(drawn, truths));
  });
  for (std::size_t b = 0; b < kVisibilityBands.size(); ++b) {
    auto const band_right = [b](Counts const& c) { return c.band_right[b]; };
    auto const band_truths = [b](Counts const& c) { return c.band_truths[b]; };
    scores.band_truths[b] = sum(all, band_truths);
    scores.band_recall[b] = resampled(scenes, [&](Drawn const& drawn) {
      return share(sum(drawn, band_right), sum(drawn, band_truths));
    });
  }
  return scores;
}

std::optional<ScoresFrom> DetectionScorer::scores_at_precision(std::size_t tier) const {
  std::vector<Judged> detections;
  for (Scene const& scene : scenes_) {
    detections.insert(detections.end(), scene.detections.begin(), scene.detections.end());
  }
  std::ranges::stable_sort(detections, std::greater{}, &Judged::score);
  std::optional<double> from_score;
  std::size_t right = 0;
  std::size_t counted = 0;
  for (std::size_t d = 0; d < detections.size(); ++d) {
    auto const& visible = detections[d].visible_fraction[tier];
    counted += !visible || *visible >= kLeastVisible ? 1 : 0;
    right += visible && *visible >= kLeastVisible ? 1 : 0;
    bool const score_ends =
        d + 1 == detections.size() || detections[d + 1].score < detections[d].score;
    if (score_ends && counted > 0 && share(right, counted) >= kComparedAtPrecision) {
      from_score = detections[d].score;
    }
  }
  if (!from_score) {
    return std::nullopt;
  }
  return ScoresFrom{*from_score, tier_scores(tier, *from_score)};
}

DetectionScores DetectionScorer::scores() const {
  DetectionScores scores;
  for (std::size_t tier = 0; tier < kPoseTiers.size(); ++tier) {
    scores.tiers[tier] = tier_scores(tier, -std::numeric_limits<double>::infinity());
    scores.at_precision[tier] = scores_at_precision(tier);
  }
  scores.add_recall = share(add_right_, scores.tiers.front().truths);
  scores.add_s_recall = share(add_s_right_, scores.tiers.front().truths);
  scores.nees_6 = nees_scores(nees_6_, 6.0);
  scores.nees_5 = nees_scores(nees_5_, 5.0);
  return scores;
}

}  // namespace credo
