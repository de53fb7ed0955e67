// Runs the thesis' scenes and writes docs/thesis-results.md, and its figures where told to.
#include <exception>
#include <filesystem>
#include <fstream>
#include <future>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "io/image.hpp"
#include "page.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;

constexpr char const* kUsage =
    "usage: credo_thesis_results PAGE [PICTURES]\n"
    "Writes the page, Markdown, and the figures into the folder PICTURES where given.\n";

constexpr char const* kIntroduction = R"(# The thesis' results, redrawn

The figures of the thesis' sections 3.4 and 4.4, each made anew by this program: what the thesis
says of it, what comes out, and whether that is the same. `make thesis-results` writes this page
and its pictures; every number and verdict on it is read from those runs.

**Scenes.** We do not have the thesis' recordings. [scenes/thesis-*](../scenes) are rooms built
after its text: a depth camera of 640x480 with a Kinect's noise (disparity in steps of an eighth
of a pixel), and the truth of every pixel. Sizes and places are ours; so the numbers of points are
not comparable, only what becomes of them.

**Detector.** Known objects come from a simulated black box: the true pose with noise of 5 mm and
0.02 rad (one standard deviation), from a fixed seed; it finds all that shows a fifth of itself.
Figures 3-3 to 3-6 need other detectors, and say so. What the robot is told beforehand is about 4
cm wrong.

**Two presets.** [config/thesis.yaml](../config/thesis.yaml) has the thesis' numbers; *by default*
is what `credo run` does without it: leave out `--config` from the commands.
[thesis-preset.md](thesis-preset.md) tells why they differ.

**Colours.** As in the thesis: the cloud cyan, floor red, walls pink, stuff purple, yellow, green
and others, fading into the ground as its probability falls; the box outlined magenta, the table
blue. A piece of stuff keeps its colour. `--dump pictures` draws in the same colours, four views a
frame; only its outlines are coloured in the prior's order.

**Words.** IoU: of the pixels that truly are something with those that got its label, the shared
over the joint; from 0.8 on they count as the same, a pillar from 0.65 on, of which one side may
be a cluster of its own. Probabilities are the belief's; bold where the look showed the thing.
Pixels and points are rounded; stuff of less than 100 pixels is a scrap and proves nothing. Stuff
is named by what it truly is: "table" among the stuff is what the table's detected pose left over.

| figure | holds with the thesis' numbers | by default | differs with the thesis' numbers |
|---|---|---|---|
)";

void write(fs::path const& page, std::string const& text) {
  std::ofstream file(page, std::ios::binary);
  file << text;
  file.close();
  if (!file) {
    throw InputError(page.string() + ": cannot be written");
  }
}

SceneRun run_with(Recipe recipe, bool thesis_numbers) {
  recipe.thesis_numbers = thesis_numbers;
  return run_recipe(recipe);
}

int run(std::vector<std::string> const& arguments) {
  if (arguments.empty() || arguments.size() > 2) {
    std::cerr << kUsage;
    return 2;
  }
  std::vector<Figure> figures = chapter3();
  std::vector<Figure> const later = chapter4();
  figures.insert(figures.end(), later.begin(), later.end());
  std::string summary;
  std::string sections;
  for (Figure const& figure : figures) {
    // Neither run knows of the other.
    std::future<SceneRun> thesis = std::async(std::launch::async, run_with, figure.recipe, true);
    SceneRun defaults = run_with(figure.recipe, false);
    FigureRuns const runs = {thesis.get(), std::move(defaults)};
    summary += summary_row(figure, runs);
    sections += "\n" + section_of(figure, runs);
    if (arguments.size() == 2) {
      fs::create_directories(arguments[1]);
      write_png_rgb(fs::path(arguments[1]) / (figure.number + ".png"), picture_of(figure, runs));
    }
  }
  write(arguments[0], kIntroduction + summary + sections);
  return 0;
}

}  // namespace
}  // namespace credo

int main(int count, char** values) {
  try {
    return credo::run({values + 1, values + count});
  } catch (std::exception const& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
