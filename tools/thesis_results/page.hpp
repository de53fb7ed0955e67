#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/grid.hpp"
#include "measures.hpp"
#include "scene_run.hpp"

namespace credo {

/// Of one claim in one run: what we got, in numbers, and whether it holds.
struct Finding {
  std::string got;
  bool holds = false;
};

/// Something that the thesis says of a figure.
struct Claim {
  /// In our words.
  std::string says;
  std::function<Finding(SceneRun const&)> check;
  /// Why it does not hold with the thesis' numbers, and with the defaults; told where it does not.
  std::string why_not;
  std::string why_not_by_default;
};

/// A figure of the thesis and the section around it.
struct Figure {
  /// "3-2": also the name of its picture.
  std::string number;
  std::string title;
  /// Without `thesis_numbers`, which both runs are made of.
  Recipe recipe;
  /// What the panels are, and what the thesis shows that needs telling.
  std::string caption;
  std::vector<Claim> claims;
  /// Our own remarks, below the claims.
  std::string remarks;
  /// A paragraph that takes runs of its own; may be empty.
  std::function<std::string()> aside;
  /// How much nearer than from behind the camera the 3-D panels look; less than 1: farther.
  double zoom = 1.0;
  /// Chapter 4: one panel a look, of the belief; else cloud, picture and segmentations.
  bool belief_over_looks = false;
};

/// Both runs of a figure.
struct FigureRuns {
  SceneRun with_thesis_numbers;
  SceneRun with_defaults;
};

/// The page's part about a figure: Markdown.
std::string section_of(Figure const& figure, FigureRuns const& runs);

/// One row of the page's summary.
std::string summary_row(Figure const& figure, FigureRuns const& runs);

/// The figure redrawn.
Grid<Rgb> picture_of(Figure const& figure, FigureRuns const& runs);

/// Figures 3-2 to 3-6.
std::vector<Figure> chapter3();
/// Figures 4-3, 4-5, 4-7 and 4-9.
std::vector<Figure> chapter4();

/// To two digits that count, or to hundreds: "90", "2300". Nothing on the page hangs on less.
std::string about(double count);
/// "0.84"; "> 0.99" where rounding would say 1.
std::string share_text(double share);
/// Three decimals, or "> 0.999".
std::string probability_text(double probability);

}  // namespace credo
