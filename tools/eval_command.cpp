#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "core/error.hpp"
#include "eval/evaluation.hpp"
#include "eval/plots.hpp"
#include "io/dataset_listing.hpp"
#include "io/image.hpp"
#include "io/intrinsics.hpp"
#include "io/pcd.hpp"
#include "io/scores_json.hpp"
#include "io/trajectory.hpp"
#include "io/truth_json.hpp"
#include "model_files.hpp"
#include "run_beliefs.hpp"
#include "score_table.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;

constexpr char const* kExamples = R"(Examples:
  credo simulate cluttered-table --out data/table
  credo run --source dataset:data/table --out out/table --dump labels
  credo eval out/table --truth data/table
  credo eval out/table --truth data/table --json --plots out/table/plots
  credo eval out/osd --truth recordings/osd        (label fields of organised PCD files)

The truth is truth.jsonl and truth/NNNNNN.png, as `credo simulate` writes them, or a folder of PCD
files with a field `label`. Scores of segments, stuff and change need a run with --dump labels.
Models of known objects are looked for in DIR, DIR/models and among the project's, by type.
docs/eval.md tells what each score is.)";

struct EvalCommand {
  fs::path run;
  fs::path truth;
  fs::path plots;
  bool json = false;
};

/// What a run and a truth make together.
struct Evaluated {
  Scores scores;
  std::vector<FrameScores> trace;
  /// Each one line for people.
  std::vector<std::string> notes;
};

fs::path image_of(fs::path const& folder, std::string const& kind, FrameIndex frame) {
  return folder / kind / fmt::format("{:06}.png", number(frame));
}

std::optional<LabelMap> read_labels(fs::path const& folder, std::string const& kind,
                                    FrameIndex frame) {
  return fs::is_directory(folder / kind) ? std::optional(read_png16(image_of(folder, kind, frame)))
                                         : std::nullopt;
}

void must_have_one_size(LabelMap const& labels, LabelMap const& truth, EvalCommand const& command,
                        FrameIndex frame) {
  if (!labels.same_size(truth)) {
    throw InputError(
        fmt::format("{}: the truth does not fit the run: its frame {} has {} x {} "
                    "pixels, the run's {} x {}",
                    command.truth.string(), number(frame), truth.width(), truth.height(),
                    labels.width(), labels.height()));
  }
}

/// The camera's poses as the simulation's sensor told them, in the world of the truth.
std::optional<Trajectory> told_poses(fs::path const& folder) {
  fs::path const path = folder / "groundtruth.txt";
  return fs::is_regular_file(path) ? std::optional<Trajectory>(path) : std::nullopt;
}

void show_progress(std::size_t done, std::size_t all) {
  if (isatty(STDERR_FILENO) != 0) {
    std::cerr << fmt::format("\rframe {}/{}{}", done, all, done == all ? "\n" : "") << std::flush;
  }
}

Se3 camera_in(BeliefSummary const& belief, fs::path const& run) {
  try {
    return Se3::from_matrix(belief.T_world_camera);
  } catch (std::invalid_argument const& error) {
    throw InputError(fmt::format("{}: frame {}: T_world_camera is no pose: {}",
                                 (run / "belief.jsonl").string(), number(belief.frame),
                                 error.what()));
  }
}

/// Throws where the beliefs cannot be about what the truth is about.
void must_fit(std::vector<BeliefSummary> const& beliefs, std::vector<FrameTruth> const& truth,
              EvalCommand const& command) {
  fs::path const& folder = command.truth;
  std::string const what = folder.string() + ": the truth does not fit the run: ";
  std::size_t t = 0;
  for (BeliefSummary const& belief : beliefs) {
    while (t < truth.size() && number(truth[t].frame) < number(belief.frame)) {
      ++t;
    }
    if (t == truth.size() || truth[t].frame != belief.frame) {
      throw InputError(fmt::format("{}it has no frame {}", what, number(belief.frame)));
    }
    if (truth[t].stamp_ns != belief.stamp_ns) {
      throw InputError(fmt::format("{}frame {} is at {} ns, the run's at {} ns", what,
                                   number(belief.frame), truth[t].stamp_ns, belief.stamp_ns));
    }
    Se3 const camera = camera_in(belief, command.run);
    if (&belief != &beliefs.front()) {
      continue;
    }
    // Later told poses may have drifted.
    Se3 const error = truth[t].T_world_camera.inverse() * camera;
    double const angle_deg =
        error.rotation().angularDistance(Eigen::Quaterniond::Identity()) * 180.0 / std::numbers::pi;
    if (error.translation().norm() > 0.25 || angle_deg > 10.0) {
      throw InputError(
          fmt::format("{}in frame {} the cameras are {:.2f} m and {:.0f} degrees apart: of another "
                      "recording, or a run without recorded poses (pose.source)",
                      what, number(belief.frame), error.translation().norm(), angle_deg));
    }
  }
}

TrueModels models_for(std::vector<FrameTruth> const& truth, fs::path const& folder,
                      std::vector<std::string>& notes) {
  std::set<std::string> types;
  for (FrameTruth const& frame : truth) {
    for (TrueThing const& object : frame.objects) {
      types.insert(object.type);
    }
  }
  TrueModels models;
  for (std::string const& type : types) {
    if (fs::path const file = model_called(type, folder); !file.empty()) {
      models.emplace(type, TrueModel(load_model(file, notes)));
    } else {
      notes.push_back("no model is called " + type +
                      ": its symmetry is not known, ADD-S leaves it out");
    }
  }
  return models;
}

std::optional<CameraIntrinsics> intrinsics_in(fs::path const& folder,
                                              std::vector<std::string>& notes) {
  fs::path const path = folder / "camera-intrinsics.txt";
  if (fs::is_regular_file(path)) {
    return read_intrinsics(path);
  }
  notes.push_back(path.string() + " is missing: no scores of walls and change");
  return std::nullopt;
}

Evaluated against_truth(EvalCommand const& command, std::vector<BeliefSummary> const& beliefs) {
  std::vector<FrameTruth> const truth = read_truth(command.truth / "truth.jsonl");
  must_fit(beliefs, truth, command);
  Evaluated result;
  TrueModels models = models_for(truth, command.truth, result.notes);
  Evaluation evaluation(std::move(models), intrinsics_in(command.truth, result.notes));
  if (!fs::is_directory(command.run / "labels")) {
    result.notes.push_back(
        "the run has no label images (--dump labels): no scores of segments, "
        "stuff and change");
  }
  std::optional<Trajectory> const told = told_poses(command.truth);
  std::size_t next = 0;
  for (FrameTruth const& frame : truth) {
    if (next == beliefs.size()) {
      break;
    }
    bool const has_belief = beliefs[next].frame == frame.frame;
    EvalFrame pair{frame, has_belief ? &beliefs[next] : nullptr};
    auto const true_labels = read_labels(command.truth, "truth", frame.frame);
    std::optional<LabelMap> labels;
    if (has_belief) {
      labels = read_labels(command.run, "labels", frame.frame);
    }
    if (labels && true_labels) {
      must_have_one_size(*labels, *true_labels, command, frame.frame);
    }
    pair.labels = labels ? &*labels : nullptr;
    pair.true_labels = true_labels ? &*true_labels : nullptr;
    pair.T_world_told = told ? told->at(frame.frame, frame.stamp_ns) : std::nullopt;
    evaluation.add(pair);
    next += has_belief ? 1 : 0;
    show_progress(next, beliefs.size());
  }
  result.scores = evaluation.scores();
  result.trace = evaluation.trace();
  return result;
}

/// None where the folder has no such files.
std::optional<Evaluated> against_label_fields(EvalCommand const& command,
                                              std::vector<BeliefSummary> const& beliefs) {
  std::vector<DatasetEntry> const entries = list_dataset(command.truth).entries;
  if (entries.empty() || entries.front().cloud.empty() || !read_pcd_labels(entries.front().cloud)) {
    return std::nullopt;
  }
  if (!fs::is_directory(command.run / "labels")) {
    throw InputError(command.run.string() +
                     ": has no label images, which label fields are held against: run again with "
                     "--dump labels");
  }
  LabelEvaluation evaluation;
  for (std::size_t i = 0; i < beliefs.size(); ++i) {
    auto const index = static_cast<std::size_t>(number(beliefs[i].frame));
    auto const truth =
        index < entries.size() ? read_pcd_labels(entries[index].cloud) : std::nullopt;
    if (!truth) {
      throw InputError(
          fmt::format("{}: the truth does not fit the run: it has no labels for frame "
                      "{}",
                      command.truth.string(), index));
    }
    LabelMap const labels = read_png16(image_of(command.run, "labels", beliefs[i].frame));
    must_have_one_size(labels, *truth, command, beliefs[i].frame);
    evaluation.add(labels, *truth);
    show_progress(i + 1, beliefs.size());
  }
  return Evaluated{evaluation.scores(), {}, {}};
}

Evaluated evaluated(EvalCommand const& command) {
  std::vector<BeliefSummary> const beliefs = beliefs_of_run(command.run);
  if (!fs::is_directory(command.truth)) {
    throw InputError(command.truth.string() + ": no such folder of a truth");
  }
  if (fs::is_regular_file(command.truth / "truth.jsonl")) {
    return against_truth(command, beliefs);
  }
  if (auto result = against_label_fields(command, beliefs)) {
    return *std::move(result);
  }
  throw InputError(command.truth.string() +
                   ": no truth: it has neither a truth.jsonl (credo simulate writes it) nor PCD "
                   "files with a field `label`");
}

void write_text(fs::path const& path, std::string const& text) {
  write_bytes(path, EncodedPng(text.begin(), text.end()));
}

void write_plots(fs::path const& folder, Evaluated const& result) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw InputError(folder.string() + ": cannot be made: " + error.message());
  }
  if (result.scores.existence) {
    write_text(folder / "reliability.svg", reliability_plot(*result.scores.existence));
  }
  if (!result.trace.empty()) {
    write_text(folder / "frames.svg", frames_plot(result.trace));
  }
}

int eval(EvalCommand const& command) {
  Evaluated const result = evaluated(command);
  if (!command.plots.empty()) {
    write_plots(command.plots, result);
  }
  for (std::string const& note : result.notes) {
    std::cerr << "credo: " << note << '\n';
  }
  std::cout << (command.json ? scores_json(result.scores) + "\n" : score_table(result.scores));
  return 0;
}

}  // namespace

void add_eval_command(CLI::App& app, Command& chosen) {
  auto command = std::make_shared<EvalCommand>();
  CLI::App* sub = app.add_subcommand("eval", "Score a run against the truth");
  sub->footer(kExamples);
  sub->add_option("run", command->run, "folder that credo run --out wrote")
      ->required()
      ->type_name("RUN");
  sub->add_option("--truth", command->truth, "folder with what is true")
      ->required()
      ->type_name("DIR");
  sub->add_flag("--json", command->json, "print the scores as JSON");
  sub->add_option("--plots", command->plots,
                  "folder for reliability.svg and frames.svg; made if need be")
      ->type_name("DIR");
  sub->callback([command, &chosen] { chosen = [command] { return eval(*command); }; });
}

}  // namespace credo
