#include "page.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "figure.hpp"
#include "io/palette.hpp"

namespace credo {
namespace {

// Smaller pieces of stuff are counted, not told one by one.
constexpr std::size_t kScrapPixels = 100;
// More pieces of one thing are told as one.
constexpr std::ptrdiff_t kPiecesTold = 4;

struct Findings {
  Finding thesis;
  Finding defaults;
};

Findings check(Claim const& claim, FigureRuns const& runs) {
  return {claim.check(runs.with_thesis_numbers), claim.check(runs.with_defaults)};
}

std::string verdict(Findings const& findings) {
  if (findings.thesis.holds == findings.defaults.holds) {
    return findings.thesis.holds ? "same" : "**differs**";
  }
  return findings.thesis.holds ? "same; by default it **differs**"
                               : "**differs**; the same by default";
}

std::string reason(std::string const& text) {
  return text.empty() ? "Not explained yet." : text;
}

std::string claims_of(Figure const& figure, FigureRuns const& runs) {
  std::string table =
      "| the thesis | with its numbers | by default | verdict |\n|---|---|---|---|\n";
  std::string reasons;
  for (Claim const& claim : figure.claims) {
    Findings const found = check(claim, runs);
    table += fmt::format("| {} | {} | {} | {} |\n", claim.says, found.thesis.got,
                         found.defaults.got, verdict(found));
    if (!found.thesis.holds) {
      reasons +=
          fmt::format("- *{}*, with the thesis' numbers: {}\n", claim.says, reason(claim.why_not));
    }
    if (!found.defaults.holds) {
      reasons +=
          fmt::format("- *{}*, by default: {}\n", claim.says, reason(claim.why_not_by_default));
    }
  }
  return table + (reasons.empty() ? "" : "\nWhy it differs:\n\n" + reasons);
}

/// Bold where the look showed the thing.
std::string probability_cell(double probability, bool seen) {
  std::string const text = probability_text(probability);
  return seen ? " **" + text + "** |" : " " + text + " |";
}

/// One piece of stuff; or many that truly are one thing, and how likely the likeliest of them is.
struct StuffRow {
  std::string what;
  std::vector<std::string> colors;
  std::size_t pieces = 0;
  std::size_t most_pixels = 0;
  std::vector<double> probability;
  std::vector<bool> seen;
};

void add(StuffTrack const& track, StuffRow& row) {
  row.what = track.what;
  row.probability.resize(track.probability.size(), 0.0);
  row.seen.resize(track.seen.size(), false);
  std::string const color = stuff_color_name(track.id);
  if (std::ranges::find(row.colors, color) == row.colors.end()) {
    row.colors.push_back(color);
  }
  ++row.pieces;
  row.most_pixels = std::max(row.most_pixels, track.most_pixels);
  for (std::size_t k = 0; k < track.probability.size(); ++k) {
    row.probability[k] = std::max(row.probability[k], track.probability[k].value_or(0.0));
    row.seen[k] = row.seen[k] || track.seen[k];
  }
}

std::string text_of(StuffRow const& row) {
  constexpr std::size_t kColors = 3;
  std::vector<std::string> colors = row.colors;
  if (colors.size() > kColors) {
    colors.resize(kColors);
    colors.emplace_back("...");
  }
  std::string text = fmt::format("| {} | {}, {}{} pixels |", fmt::join(colors, ", "), row.what,
                                 row.pieces > 1 ? fmt::format("{} pieces, up to ", row.pieces) : "",
                                 about(static_cast<double>(row.most_pixels)));
  for (std::size_t k = 0; k < row.probability.size(); ++k) {
    text += row.probability[k] > 0.0 ? probability_cell(row.probability[k], row.seen[k]) : " |";
  }
  return text + "\n";
}

std::string stuff_of(SceneRun const& run) {
  std::vector<StuffTrack> tracks = stuff_tracks(run);
  std::size_t const scraps = std::erase_if(
      tracks, [](StuffTrack const& track) { return track.most_pixels < kScrapPixels; });
  std::vector<StuffRow> rows;
  for (StuffTrack const& track : tracks) {
    bool const many = std::ranges::count(tracks, track.what, &StuffTrack::what) > kPiecesTold;
    auto row = many ? std::ranges::find(rows, track.what, &StuffRow::what) : rows.end();
    row = row == rows.end() ? rows.insert(rows.end(), StuffRow{}) : row;
    add(track, *row);
  }
  std::string text;
  for (StuffRow const& row : rows) {
    text += text_of(row);
  }
  return text + (scraps > 0 ? fmt::format("\nBeside these, {} scrap{} of less than {} pixels.\n",
                                          scraps, scraps == 1 ? "" : "s", kScrapPixels)
                            : "");
}

/// What the belief holds after each look.
std::string history_of(SceneRun const& run, std::string const& title) {
  std::string header = fmt::format("| | {} |", title);
  std::string rule = "|---|---|";
  std::string floor = "| red | floor, points |";
  std::string walls = "| pink | walls |";
  for (std::size_t k = 0; k < run.looks.size(); ++k) {
    BeliefState const& belief = *run.looks[k].belief;
    header += fmt::format(" ({}) |", static_cast<char>('a' + k));
    rule += "---|";
    floor += fmt::format(
        " {} |", belief.floor ? about(static_cast<double>(belief.floor->points->size())) : "");
    walls += fmt::format(" {} |", belief.walls.size());
  }
  std::string text = header + "\n" + rule + "\n" + floor + "\n" + walls + "\n";
  std::vector<ObjectBelief> const& objects = run.looks.front().belief->objects;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    text += fmt::format("| outline | {} |", objects[i].id);
    for (SceneLook const& look : run.looks) {
      ObjectBelief const& object = look.belief->objects[i];
      text += probability_cell(probability_of(object.log_odds), object.evidence == Evidence::kSeen);
    }
    text += "\n";
  }
  return text + stuff_of(run);
}

}  // namespace

std::string about(double count) {
  double const unit = count < 100 ? 10.0 : 100.0;
  return fmt::format("{:.0f}", unit * std::round(count / unit));
}

std::string share_text(double share) {
  return share > 0.995 && share < 1.0 ? "> 0.99" : fmt::format("{:.2f}", share);
}

std::string probability_text(double probability) {
  return probability > 0.9995 ? "> 0.999" : fmt::format("{:.3f}", probability);
}

std::string section_of(Figure const& figure, FigureRuns const& runs) {
  std::string const out = "out/thesis-" + figure.number;
  std::string text = fmt::format(
      "## Figure {0}: {1}\n\n![Figure {0} redrawn](thesis/{0}.png)\n\n{2}\n\n```\n{3}\n```\n\n",
      figure.number, figure.title, figure.caption, command_of(figure.recipe, out));
  text += claims_of(figure, runs);
  if (figure.belief_over_looks) {
    text += "\n" + history_of(runs.with_thesis_numbers, "after look, with the thesis' numbers");
    text += "\n" + history_of(runs.with_defaults, "after look, by default");
  }
  text += figure.remarks.empty() ? "" : "\n" + figure.remarks + "\n";
  return text + (figure.aside ? "\n" + figure.aside() + "\n" : "");
}

std::string summary_row(Figure const& figure, FigureRuns const& runs) {
  std::size_t thesis = 0;
  std::size_t defaults = 0;
  std::string differing;
  for (Claim const& claim : figure.claims) {
    Findings const found = check(claim, runs);
    thesis += found.thesis.holds ? 1U : 0U;
    defaults += found.defaults.holds ? 1U : 0U;
    if (!found.thesis.holds) {
      differing += (differing.empty() ? "" : "; ") + claim.says;
    }
  }
  return fmt::format("| {} {} | {} of {} | {} of {} | {} |\n", figure.number, figure.title, thesis,
                     figure.claims.size(), defaults, figure.claims.size(), differing);
}

Grid<Rgb> picture_of(Figure const& figure, FigureRuns const& runs) {
  SceneRun const& run = runs.with_thesis_numbers;
  std::vector<Grid<Rgb>> panels;
  if (!figure.belief_over_looks) {
    return mounted(
        {cloud_panel(run, figure.zoom), color_panel(run.looks.front()),
         segmentation_panel(run, figure.zoom), segmentation_panel(runs.with_defaults, figure.zoom)},
        2);
  }
  for (std::size_t k = 0; k < run.looks.size(); ++k) {
    panels.push_back(belief_panel(run, k, figure.zoom));
  }
  return mounted(panels, panels.size() == 4 ? 2 : 3);
}

}  // namespace credo
