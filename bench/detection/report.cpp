#include "report.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "../cpu_time.hpp"

namespace credo {
namespace {

std::string text(char const* format, double value) {
  std::array<char, 40> chars{};
  std::snprintf(chars.data(), chars.size(), format, value);
  return chars.data();
}

std::string percent(double share) {
  return std::isnan(share) ? "-" : text("%.1f", 100.0 * share);
}

std::string cell(ScoredShare const& share) {
  return percent(share.value) + " (" + percent(share.low) + " to " + percent(share.high) + ")";
}

std::string tier_name(PoseTier const& tier) {
  return text("%g cm, ", 100.0 * tier.translation_m) + text("%g deg", tier.rotation_deg);
}

std::string nees_cell(NeesScores const& nees) {
  if (nees.count == 0) {
    return "-";
  }
  return text("%.2f", nees.mean) + " [" + text("%.2f", nees.low_bound) + ", " +
         text("%.2f", nees.high_bound) + "], median " + text("%.2f", nees.median) + ", " +
         percent(nees.coverage) + " % within, n = " + std::to_string(nees.count);
}

nlohmann::json json_of(ScoredShare const& share) {
  auto const number = [](double value) {
    return std::isnan(value) ? nlohmann::json() : nlohmann::json(value);
  };
  return {number(share.value), number(share.low), number(share.high)};
}

nlohmann::json json_of(NeesScores const& nees) {
  return {{"count", nees.count},
          {"mean", nees.mean},
          {"median", nees.median},
          {"bounds", {nees.low_bound, nees.high_bound}},
          {"coverage_95", nees.coverage}};
}

nlohmann::json json_of(TierScores const& tier) {
  nlohmann::json bands = nlohmann::json::array();
  for (std::size_t b = 0; b < kVisibilityBands.size(); ++b) {
    bands.push_back({{"visible", {kVisibilityBands[b].low, kVisibilityBands[b].high}},
                     {"truths", tier.band_truths[b]},
                     {"recall", json_of(tier.band_recall[b])}});
  }
  return {{"right", tier.right},
          {"detections", tier.detections},
          {"truths", tier.truths},
          {"precision", json_of(tier.precision)},
          {"recall", json_of(tier.recall)},
          {"f1", json_of(tier.f1)},
          {"bands", bands}};
}

nlohmann::json json_of(MethodResult const& result) {
  nlohmann::json tiers = nlohmann::json::array();
  for (std::size_t i = 0; i < kPoseTiers.size(); ++i) {
    nlohmann::json tier = json_of(result.scores.tiers[i]);
    tier["translation_m"] = kPoseTiers[i].translation_m;
    tier["rotation_deg"] = kPoseTiers[i].rotation_deg;
    if (auto const& at = result.scores.at_precision[i]) {
      tier["at_precision"] = json_of(at->scores);
      tier["at_precision"]["from_score"] = at->from_score;
    }
    tiers.push_back(tier);
  }
  return {{"method", result.method},
          {"tiers", tiers},
          {"add_recall", result.scores.add_recall},
          {"add_s_recall", result.scores.add_s_recall},
          {"nees_6", json_of(result.scores.nees_6)},
          {"nees_5", json_of(result.scores.nees_5)},
          {"making_s", result.making_s},
          {"wall_s", result.wall_s},
          {"cpu_s", result.cpu_s}};
}

std::string row(std::string const& method, std::string const& which, TierScores const& tier) {
  std::string row = "| " + method + " | " + which + " | " + cell(tier.precision) + " | " +
                    cell(tier.recall) + " | " + cell(tier.f1) + " |";
  for (std::size_t b = 0; b < kVisibilityBands.size(); ++b) {
    row += " " + percent(tier.band_recall[b].value) + " of " + std::to_string(tier.band_truths[b]) +
           " |";
  }
  return row + "\n";
}

}  // namespace

std::string markdown(RunFacts const& facts, std::vector<MethodResult> const& results) {
  std::string page = "Set " + facts.set + ", " + std::to_string(facts.scenes) + " scenes, " +
                     std::to_string(facts.models) + " models asked for in each, " +
                     std::to_string(facts.threads) +
                     " threads. Percent, with 95 % intervals over scenes.\n\n"
                     "| method | right within | precision | recall | F1 | recall, > 70 % seen | 40 "
                     "to 70 % | 15 to 40 % |\n|---|---|---|---|---|---|---|---|\n";
  for (MethodResult const& result : results) {
    for (std::size_t i = 0; i < kPoseTiers.size(); ++i) {
      page += row(result.method, tier_name(kPoseTiers[i]), result.scores.tiers[i]);
      if (auto const& at = result.scores.at_precision[i]) {
        page += row(result.method,
                    tier_name(kPoseTiers[i]) + text(", scores from %.3f", at->from_score) +
                        text(" (precision %g)", kComparedAtPrecision),
                    at->scores);
      }
    }
  }
  page +=
      "\n| method | ADD(-S) | ADD-S | NEES, 6 | NEES, 5 | s a frame (wall) | s a model and frame "
      "(CPU) | s to make ready |\n|---|---|---|---|---|---|---|---|\n";
  for (MethodResult const& result : results) {
    double const cpu_s = result.cpu_s.empty() ? 0.0 : median(result.cpu_s);
    page += "| " + result.method + " | " + percent(result.scores.add_recall) + " | " +
            percent(result.scores.add_s_recall) + " | " + nees_cell(result.scores.nees_6) + " | " +
            nees_cell(result.scores.nees_5) + " | " +
            text("%.3f", result.wall_s.empty() ? 0.0 : median(result.wall_s)) + " | " +
            text("%.4f", cpu_s / static_cast<double>(facts.models)) + " | " +
            text("%.1f", result.making_s) + " |\n";
  }
  return page;
}

std::string json(RunFacts const& facts, std::vector<MethodResult> const& results) {
  nlohmann::json page = {{"set", facts.set},
                         {"scenes", facts.scenes},
                         {"models", facts.models},
                         {"threads", facts.threads},
                         {"methods", nlohmann::json::array()}};
  for (MethodResult const& result : results) {
    page["methods"].push_back(json_of(result));
  }
  return page.dump(1) + "\n";
}

}  // namespace credo
