#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/frame_source.hpp"
#include "graph/run_report.hpp"
#include "graph/run_sink.hpp"
#include "graph/stages.hpp"

namespace credo::test {

inline FramePtr tiny_frame(std::int64_t index) {
  auto frame = std::make_shared<Frame>();
  frame->index = FrameIndex{index};
  frame->cloud_camera = OrganizedCloud(1, 1);
  return frame;
}

/// `count` frames of one pixel; `at` may turn any of them into something else.
class FakeSource : public FrameSource {
public:
  using At = std::function<SourceResult(std::int64_t)>;
  explicit FakeSource(std::int64_t count, At at = tiny_frame) : count_(count), at_(std::move(at)) {}

  SourceResult next() override {
    if (next_ == count_) {
      return EndOfSource{};
    }
    return at_(next_++);
  }

  [[nodiscard]] std::int64_t given() const { return next_; }

private:
  std::int64_t count_;
  At at_;
  std::int64_t next_ = 0;
};

/// Sleeps between 0 and `max_us` by frame and stage, without a random generator: neighbouring
/// frames take very different times, so that they overtake each other wherever they can.
inline void dawdle(Frame const& frame, unsigned stage, unsigned max_us) {
  auto const hash = static_cast<std::uint32_t>(number(frame.index) * 7 + stage) * 2654435761U;
  if (max_us > 0) {
    std::this_thread::sleep_for(std::chrono::microseconds((hash >> 16U) % max_us));
  }
}

/// Stages whose belief is a chain: what each frame saw and was fused into can be read off it.
/// `next_stuff_id` counts the fused frames, and `next_wall_id` hashes the whole history, what each
/// frame saw included.
inline Stages fake_stages(unsigned max_us = 0) {
  Stages stages;
  stages.normals = [=](Frame const& frame) {
    dawdle(frame, 0, max_us);
    NormalMap normals(1, 1);
    normals.set(0, {static_cast<float>(number(frame.index)), 0, 0});
    return normals;
  };
  stages.detection = [=](Frame const& frame, NormalMap const&, BeliefState const& seen) {
    dawdle(frame, 1, max_us);
    Segmentation segmentation = unassigned_segmentation(frame, frame.T_source_camera, seen.frame);
    segmentation.stuff.resize(1);
    segmentation.stuff[0].pixel_count = seen.next_wall_id;
    return segmentation;
  };
  stages.planes = [=](Frame const& frame, NormalMap const&, Segmentation segmentation) {
    dawdle(frame, 2, max_us);
    return segmentation;
  };
  stages.clustering = [=](Frame const& frame, NormalMap const& normals, Segmentation segmentation) {
    dawdle(frame, 3, max_us);
    segmentation.stuff[0].pixel_count += static_cast<std::size_t>(normals.x[0]);
    return segmentation;
  };
  stages.fusion = [](BeliefState belief, Segmentation const& segmentation) {
    belief.frame = segmentation.frame;
    belief.segmented_with = segmentation.segmented_with;
    ++belief.next_stuff_id;
    auto const seen = static_cast<std::uint32_t>(segmentation.stuff[0].pixel_count);
    belief.next_wall_id = (belief.next_wall_id * 31U + seen) * 2654435761U + 1U;
    return belief;
  };
  return stages;
}

inline BeliefPtr empty_prior() {
  return std::make_shared<BeliefState const>();
}

/// Everything that a run handed out, in order, one line a frame.
class Recorder {
public:
  RunSink sink(unsigned max_us = 0) {
    return {[this, max_us](FrameResult const& result) -> Delivery {
              dawdle(*result.frame, 5, max_us);
              return [this, max_us, result] {
                dawdle(*result.frame, 6, max_us);
                BeliefState const& belief = *result.belief;
                indices_.push_back(number(result.frame->index));
                segmented_with_.push_back(number(belief.segmented_with));
                lines_.push_back(std::to_string(number(belief.frame)) + " saw " +
                                 std::to_string(number(belief.segmented_with)) + " fused " +
                                 std::to_string(belief.next_stuff_id - 1) + " hash " +
                                 std::to_string(belief.next_wall_id));
              };
            },
            [this](FrameFailure const& failure) {
              indices_.push_back(number(failure.index));
              lost_.push_back(failure);
              lines_.push_back(std::to_string(number(failure.index)) + " lost");
            }};
  }

  [[nodiscard]] std::vector<std::int64_t> const& indices() const { return indices_; }
  [[nodiscard]] std::vector<std::int64_t> const& segmented_with() const { return segmented_with_; }
  [[nodiscard]] std::vector<std::string> const& lines() const { return lines_; }
  [[nodiscard]] std::vector<FrameFailure> const& lost() const { return lost_; }

private:
  std::vector<std::int64_t> indices_;
  std::vector<std::int64_t> segmented_with_;
  std::vector<std::string> lines_;
  std::vector<FrameFailure> lost_;
};

/// 0, 1, ... count - 1.
inline std::vector<std::int64_t> first(std::int64_t count) {
  std::vector<std::int64_t> indices;
  for (std::int64_t i = 0; i < count; ++i) {
    indices.push_back(i);
  }
  return indices;
}

inline std::uint64_t total_dropped(RunReport const& report) {
  std::uint64_t total = 0;
  for (auto const& [reason, count] : report.metrics.dropped) {
    total += count;
  }
  return total;
}

/// The text of what ended a run; empty where nothing did, "?" for what is no Error.
template <typename Error>
std::string error_text(RunReport const& report) {
  if (report.error == nullptr) {
    return "";
  }
  try {
    std::rethrow_exception(report.error);
  } catch (Error const& error) {
    return error.what();
  } catch (...) {
    return "?";
  }
}

/// Sets every edge alike.
inline void set_edges(GraphConfig& config, int capacity, Overflow overflow = Overflow::kWait) {
  EdgesConfig& edges = config.edges;
  for (EdgeConfig* edge :
       {&edges.capture_normals, &edges.normals_detection, &edges.detection_planes,
        &edges.planes_clustering, &edges.clustering_fusion, &edges.fusion_encoding,
        &edges.encoding_sink}) {
    *edge = {capacity, overflow};
  }
}

}  // namespace credo::test
