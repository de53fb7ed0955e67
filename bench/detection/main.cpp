// Detectors side by side on the same made frames with known truth: precision, recall, errors, time.
// docs/detection.md tells what is measured and how.
#include <sys/resource.h>
#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "core/detector_config.hpp"
#include "core/error.hpp"
#include "geometry/shapes/outline.hpp"
#include "io/image.hpp"
#include "methods.hpp"
#include "pictures.hpp"
#include "report.hpp"
#include "views.hpp"

namespace credo {
namespace {

struct Arguments {
  std::string set = "kinect";
  std::vector<std::string> methods = {"truth"};
  int scenes = 0;
  int threads = 1;
  double told_from = BpaConfig{}.min_probability;
  std::filesystem::path json;
  std::filesystem::path pictures;
  bool freeze = false;
};

double seconds(timeval const& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// Of all threads of this process.
double cpu_s() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double wall_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

ObjectModels by_name(std::vector<ObjectModel> const& models) {
  ObjectModels named;
  for (ObjectModel const& model : models) {
    named.emplace(model.name, model);
  }
  return named;
}

std::filesystem::path recordings() {
  char const* given = std::getenv("CREDO_DATA");  // NOLINT(concurrency-mt-unsafe): before threads
  return given != nullptr ? given : CREDO_DATA_DIR;
}

std::vector<Method> chosen(std::vector<Method> const& all, std::vector<std::string> const& names) {
  std::vector<Method> methods;
  for (std::string const& name : names) {
    auto const found = std::ranges::find(all, name, &Method::name);
    if (found == all.end()) {
      std::string known;
      for (Method const& method : all) {
        known += " " + method.name;
      }
      throw InputError("--method " + name + ": there are" + known);
    }
    methods.push_back(*found);
  }
  return methods;
}

std::vector<TableView> views_of(std::vector<TabletopScene> const& scenes,
                                ObjectModels const& models) {
  std::vector<TableView> views;
  for (TabletopScene const& scene : scenes) {
    views.push_back(view_of(scene, models, static_cast<int>(views.size())));
    std::cerr << "\rrendering " << views.size() << "/" << scenes.size() << std::flush;
  }
  std::cerr << "\n";
  return views;
}

/// What all methods have in common.
struct Bench {
  std::vector<ObjectModel> models;
  std::vector<TableView> views;
  TrueModels true_models;
  Outlines outlines;
  std::filesystem::path pictures;
};

MethodResult run(Bench const& bench, Method const& method) {
  MethodResult result;
  result.method = method.name;
  double const begin_s = wall_s();
  auto const detector = method.make(bench.models);
  result.making_s = wall_s() - begin_s;
  std::vector<DetectionRequest> const requests = requests_for(bench.models);
  DetectionScorer scorer(bench.true_models);
  for (TableView const& view : bench.views) {
    double const wall_before_s = wall_s();
    double const cpu_before_s = cpu_s();
    std::vector<Detection> const detections = detector->detect(*view.frame, requests);
    result.wall_s.push_back(wall_s() - wall_before_s);
    result.cpu_s.push_back(cpu_s() - cpu_before_s);
    scorer.add(detections, view.truths);
    if (!bench.pictures.empty()) {
      write_png_rgb(bench.pictures / (view.scene + "-" + method.name + ".png"),
                    picture_of(view, detections, scorer.last_matches(), bench.outlines));
    }
    std::cerr << "\r" << method.name << " " << result.wall_s.size() << "/" << bench.views.size()
              << ", " << result.wall_s.back() << " s " << std::flush;
  }
  std::cerr << "\n";
  result.scores = scorer.scores();
  return result;
}

void freeze(std::vector<ObjectModel> const& models) {
  for (TabletopSet const& set : kTabletopSets) {
    std::string const text = text_of(make_scenes(set, by_name(models)));
    write_bytes(frozen_file(set), {text.begin(), text.end()});
    std::cerr << frozen_file(set).string() << "\n";
  }
}

void compare(Arguments const& arguments) {
  Bench bench;
  bench.models = all_models(recordings());
  if (arguments.freeze) {
    freeze(bench.models);
    return;
  }
  std::optional<TabletopSet> const set = tabletop_set(arguments.set);
  if (!set) {
    throw InputError("--set " + arguments.set +
                     ": there are kinect, clutter, tuning-kinect and tuning-clutter");
  }
  std::vector<Method> const methods =
      chosen(all_methods(bench.views, arguments.told_from), arguments.methods);
  std::vector<TabletopScene> scenes = frozen_scenes(*set);
  if (arguments.scenes > 0) {
    scenes.resize(std::min(scenes.size(), static_cast<std::size_t>(arguments.scenes)));
  }
  bench.views = views_of(scenes, by_name(bench.models));
  for (ObjectModel const& model : bench.models) {
    bench.true_models.emplace(model.name, TrueModel(model));
  }
  bench.outlines = outlines_of(by_name(bench.models));
  bench.pictures = arguments.pictures;
  if (!bench.pictures.empty()) {
    std::filesystem::create_directories(bench.pictures);
  }
  std::vector<MethodResult> results;
  for (Method const& method : methods) {
    results.push_back(run(bench, method));
  }
  RunFacts const facts{arguments.set, bench.views.size(), bench.models.size(), arguments.threads};
  std::cout << markdown(facts, results);
  if (!arguments.json.empty()) {
    std::string const text = json(facts, results);
    write_bytes(arguments.json, {text.begin(), text.end()});
  }
}

int run_program(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Detectors of known objects side by side; the folder of recordings is $CREDO_DATA");
  app.add_option("--set", arguments.set, "kinect, clutter, tuning-kinect or tuning-clutter");
  app.add_option("--method", arguments.methods, "one or more, in this order");
  app.add_option("--scenes", arguments.scenes, "only the first N")->check(CLI::PositiveNumber);
  app.add_option("--threads", arguments.threads, "worker threads")->check(CLI::PositiveNumber);
  app.add_option("--told-from", arguments.told_from,
                 "least probability that bpa tells; under its default shows what it finds at the "
                 "precision that methods are compared at")
      ->check(CLI::Range(0.0, 1.0));
  app.add_option("--json", arguments.json, "all figures, as a file");
  app.add_option("--pictures", arguments.pictures, "a folder for a picture of each frame");
  app.add_flag("--freeze", arguments.freeze, "make the files of all sets anew, and nothing else");
  try {
    app.parse(argc, argv);
  } catch (CLI::ParseError const& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  tbb::global_control const limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(arguments.threads));
  try {
    compare(arguments);
  } catch (InputError const& error) {
    std::cerr << error.what() << "\n";
    return 2;
  }
  return 0;
}

}  // namespace
}  // namespace credo

int main(int argc, char** argv) {
  return credo::run_program(argc, argv);
}
