#include "run_output.hpp"

#include <spdlog/spdlog.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "graph/process_usage.hpp"
#include "io/belief_json.hpp"
#include "io/image.hpp"
#include "io/pictures.hpp"

namespace credo {
namespace {

/// A minute of a Kinect's. Without, a run of three quarters of an hour held nearly ten times what
/// it used.
constexpr std::size_t kFramesBetweenCleanings = 1800;

/// All that a frame leaves in the folder, ready to be written.
struct Files {
  FrameIndex frame{0};
  EncodedPng labels;
  EncodedPng picture;
  std::string line;
};

Files files_of(FrameResult const& result, BeliefSummary const& belief, Dump const& dump,
               Outlines const& outlines) {
  Files files;
  files.frame = result.frame->index;
  if (dump.labels) {
    files.labels = encode_png16(result.segmentation->labels);
  }
  if (dump.pictures) {
    files.picture =
        encode_png_rgb(draw_picture(*result.frame, *result.segmentation, *result.belief, outlines));
  }
  files.line = belief_json(belief);
  return files;
}

void write(RunFolder& folder, Files const& files, Dump const& dump) {
  if (dump.labels) {
    folder.write_labels(files.frame, files.labels);
  }
  if (dump.pictures) {
    folder.write_picture(files.frame, files.picture);
  }
  folder.write_belief(files.line);
}

}  // namespace

RunSink run_output(RunFolder* folder, BeliefPublisher* publisher, Dump const& dump,
                   Outlines const& outlines, Progress& progress, std::string const& source,
                   LevelWatch* watch) {
  RunSink sink;
  auto const source_lost = std::make_shared<bool>(false);
  auto const frames = std::make_shared<std::size_t>(0);
  sink.encode = [=, &outlines, &progress](FrameResult const& result) -> Delivery {
    auto const belief = std::make_shared<BeliefSummary const>(summary_of(*result.belief));
    auto const files =
        folder != nullptr ? std::make_shared<Files const>(files_of(result, *belief, dump, outlines))
                          : nullptr;
    return [=, &progress] {
      if (folder != nullptr) {
        write(*folder, *files, dump);
      }
      if (publisher != nullptr) {
        publisher->publish(*result.belief, *belief);
        publisher->publish(*result.segmentation, result.frame->intrinsics);
        if (std::exchange(*source_lost, false)) {
          publisher->tell(LifecycleState::kRunning, source);
        }
      }
      if (std::optional<std::string> const note =
              watch != nullptr ? watch->look(*result.frame) : std::nullopt) {
        spdlog::warn(*note);
        if (publisher != nullptr) {
          publisher->tell(LifecycleState::kRunning, *note);
        }
      }
      progress.show(result);
      if (++*frames % kFramesBetweenCleanings == 0) {
        give_back_free_memory();
      }
    };
  };
  sink.lost = [=, &progress](FrameFailure const& failure) {
    progress.lost(failure);
    bool const lost = failure.loss == Loss::kSilence;
    if (publisher != nullptr && std::exchange(*source_lost, lost) != lost) {
      publisher->tell(lost ? LifecycleState::kSourceLost : LifecycleState::kRunning,
                      lost ? failure.message : source);
    }
  };
  if (publisher != nullptr) {
    sink.metrics = [=](RunMetrics const& metrics) { publisher->publish(metrics); };
  }
  return sink;
}

}  // namespace credo
