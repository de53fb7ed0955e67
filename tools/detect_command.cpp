#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stop_token>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "commands.hpp"
#include "config_arguments.hpp"
#include "core/error.hpp"
#include "detection_output.hpp"
#include "detector/bpa_detector.hpp"
#include "detector/detection_picture.hpp"
#include "io/image.hpp"
#include "model_files.hpp"
#include "source_uri.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;

constexpr char const* kExamples = R"(Examples:
  credo detect --source dataset:recordings/desk --model cat.yaml
  credo detect --source dataset:recordings/desk --frame 12 --model cat.yaml cup.yaml --picture found.png
  credo detect --source sim:thesis-4.4.1 --model table green-box --json
  credo detect --source openni: --model cat.yaml --set detector.bpa.min_probability=0.8

Each model is looked for once, anywhere in the frame, by its shape. A model is a file as docs/known-objects.md
tells, or a mesh (metres), as `credo model` makes them, or the name of one in models/. --json prints a list; poses are in the camera frame, metres,
covariances row by row in the order (delta m, phi rad).)";

struct DetectCommand {
  std::string source;
  ConfigArguments config;
  std::int64_t frame = 0;
  std::vector<std::string> models;
  bool json = false;
  fs::path picture;
};

ObjectModels load_models(DetectCommand const& command) {
  ObjectModels models;
  for (std::string const& name : command.models) {
    std::vector<std::string> warnings;
    fs::path const here = fs::current_path() / "model";
    ObjectModel model = load_model(find_model(name, here, "--model"), warnings);
    for (std::string const& warning : warnings) {
      std::cerr << "warning: " << warning << '\n';
    }
    std::string const called = model.name;
    if (!models.try_emplace(called, std::move(model)).second) {
      throw InputError("--model " + name + ": another model is called " + called +
                       " too; give it another name");
    }
  }
  return models;
}

FramePtr frame_of(FrameSource& source, DetectCommand const& command) {
  while (true) {
    SourceResult const result = source.next();
    if (std::holds_alternative<EndOfSource>(result)) {
      throw InputError(fmt::format("--source {}: has no frame {}", command.source, command.frame));
    }
    if (auto const* failure = std::get_if<FrameFailure>(&result)) {
      if (number(failure->index) == command.frame || failure->loss == Loss::kSilence) {
        throw InputError(fmt::format("--source {}: {}", command.source, failure->message));
      }
      continue;
    }
    FramePtr const& frame = std::get<FramePtr>(result);
    if (number(frame->index) >= command.frame) {
      return frame;
    }
  }
}

/// Nothing is known of where it is.
PoseDistribution anywhere() {
  return {Se3(Eigen::Quaterniond::Identity(), {0, 0, 1}), 100.0 * Matrix6d::Identity()};
}

int run_detection(DetectCommand const& command) {
  PipelineConfig const config = resolved_config(command.config);
  ObjectModels const models = load_models(command);
  auto const note = [](std::string const& text) { std::cerr << "warning: " << text << '\n'; };
  OpenedSource const opened = open_source(command.source, config.capture, config.pose,
                                          config.sensor, config.sim, note, std::stop_token());
  for (std::string const& warning : opened.warnings) {
    note(warning);
  }
  FramePtr const frame = frame_of(*opened.source, command);
  std::vector<DetectionRequest> requests;
  for (auto const& [name, model] : models) {
    requests.push_back({name, name, anywhere()});
  }
  BpaConfig search = config.detector.bpa;
  search.search = ObjectSearch::kGlobal;
  BpaDetector detector(prepare_models(models, model_cache(search.cache_dir)), search);
  std::vector<Detection> const detections = detector.detect(*frame, requests);
  if (!command.picture.empty()) {
    write_png_rgb(command.picture, draw_detections(*frame, detector.models(), detections));
  }
  std::cout << (command.json ? detections_json(detections) : detection_table(models, detections));
  return 0;
}

}  // namespace

void add_detect_command(CLI::App& app, Command& chosen) {
  auto command = std::make_shared<DetectCommand>();
  CLI::App* sub = app.add_subcommand("detect", "Find known objects in one frame");
  sub->footer(kExamples);
  sub->add_option("--source", command->source,
                  "dataset:DIR, oni:FILE, openni:[URI] or sim:NAME-or-FILE")
      ->required()
      ->type_name("URI");
  add_config_arguments(*sub, command->config);
  sub->add_option("--frame", command->frame,
                  "its number in the source, from 0; the first good one from there on")
      ->check(CLI::NonNegativeNumber.description(""))
      ->type_name("N");
  sub->add_option("--model", command->models, "what to look for: files, or names of models/")
      ->required()
      ->type_name("FILE...");
  sub->add_flag("--json", command->json, "a JSON list instead of a table");
  sub->add_option("--picture", command->picture, "PNG of the frame with what was found")
      ->type_name("FILE");
  sub->callback([command, &chosen] { chosen = [command] { return run_detection(*command); }; });
}

}  // namespace credo
