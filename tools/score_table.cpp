#include "score_table.hpp"

#include <spdlog/fmt/fmt.h>

#include <optional>

namespace credo {
namespace {

std::string number_text(std::optional<double> value, int decimals, std::string const& unit,
                        double scale = 1.0) {
  return value ? fmt::format("{:.{}f}{}", *value * scale, decimals, unit) : "-";
}

std::string percent(std::optional<double> value) {
  return number_text(value, 1, " %", 100.0);
}

std::string row(std::string const& name, std::string const& text) {
  return fmt::format("{:<16}{}\n", name, text);
}

std::string overlap_row(std::string const& name, OverlapScores const& scores) {
  return row(name, fmt::format("WOv {}, over-segmented {}, under-segmented {}, recall at IoU .5 {}",
                               percent(scores.weighted_overlap), percent(scores.over_segmentation),
                               percent(scores.under_segmentation), percent(scores.recall_50)));
}

std::string iou_row(std::map<std::string, double> const& iou) {
  std::string text;
  for (auto const& [name, value] : iou) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, percent(value));
  }
  return row("  IoU", text);
}

std::string existence_row(ExistenceScores const& scores) {
  std::uint64_t claims = 0;
  for (ReliabilityBin const& bin : scores.reliability) {
    claims += bin.count;
  }
  return row("existence", fmt::format("ECE {:.4f}, Brier {:.4f} over {} claims", scores.ece,
                                      scores.brier, claims));
}

std::string stuff_row(StuffScores const& scores) {
  return row("stuff",
             fmt::format("{} id switches, {} fragmentations in {} things times frames followed",
                         scores.switches.size(), scores.fragmentations, scores.item_frames));
}

std::string camera_row(std::string const& name, std::optional<CameraScores> const& scores) {
  return row(name, scores ? fmt::format("{:.4f} m and {:.2f} degrees off, the way {:.4f} m",
                                        scores->translation_m, scores->rotation_deg, scores->ate_m)
                          : "-");
}

std::string bounds_text(double nees, double low, double high) {
  return fmt::format("{:.2f} to {:.2f}: {}", low, high,
                     nees >= low && nees <= high ? "inside" : "outside");
}

std::string nees_text(ObjectScores const& objects) {
  std::string text = fmt::format("NEES {} (expected {}", number_text(objects.nees, 2, ""),
                                 number_text(objects.nees_expected, 2, ""));
  if (objects.nees && objects.nees_low && objects.nees_high) {
    text += ", 95 % of independent claims within " +
            bounds_text(*objects.nees, *objects.nees_low, *objects.nees_high);
  }
  if (objects.nees && objects.nees_repeated_low && objects.nees_repeated_high) {
    text += ", as these repeat each other within " +
            bounds_text(*objects.nees, *objects.nees_repeated_low, *objects.nees_repeated_high);
  }
  return text + ")";
}

}  // namespace

std::string score_table(Scores const& scores) {
  std::string table = row("frames", std::to_string(scores.frames));
  table += camera_row("camera", scores.camera);
  table += camera_row("  as told", scores.camera_told);
  table += scores.segmentation.instances
               ? overlap_row("segmentation", *scores.segmentation.instances)
               : row("segmentation", "-");
  if (scores.segmentation.merged) {
    table += overlap_row("  parts as one", *scores.segmentation.merged);
  }
  if (!scores.segmentation.iou.empty()) {
    table += iou_row(scores.segmentation.iou);
  }
  table += row("floor", scores.floor ? fmt::format("{:.2f} degrees, {:.4f} m off",
                                                   scores.floor->tilt_deg, scores.floor->height_m)
                                     : "-");
  table += row("walls", fmt::format("precision {}, recall {}, ends {} off",
                                    percent(scores.walls.precision), percent(scores.walls.recall),
                                    number_text(scores.walls.endpoint_m, 3, " m")));
  ObjectScores const& objects = scores.objects;
  table += row("objects",
               fmt::format("precision {}, recall {}, ADD-S recall {}", percent(objects.precision),
                           percent(objects.recall), percent(objects.adds_recall)));
  table += row("  poses",
               fmt::format("{} and {} off, {}", number_text(objects.translation_m, 4, " m"),
                           number_text(objects.rotation_deg, 2, " degrees"), nees_text(objects)));
  table += scores.existence ? existence_row(*scores.existence) : row("existence", "-");
  table += row("change", fmt::format("precision {}, recall {} of {}, noticed after {}",
                                     percent(scores.change.precision),
                                     percent(scores.change.recall), scores.change.events,
                                     number_text(scores.change.delay_frames, 1, " frames")));
  table += scores.stuff ? stuff_row(*scores.stuff) : row("stuff", "-");
  return table;
}

}  // namespace credo
