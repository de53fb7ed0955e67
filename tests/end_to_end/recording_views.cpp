#include "end_to_end/recording_views.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/capture_config.hpp"
#include "graph/pipeline.hpp"
#include "graph/read_ahead.hpp"
#include "io/dataset.hpp"

namespace credo::test {
namespace {

namespace fs = std::filesystem;

std::string name_of(std::int64_t frame, char const* what) {
  std::array<char, 64> name{};
  std::snprintf(name.data(), name.size(), "frame-%06d.%s", static_cast<int>(frame), what);
  return name.data();
}

class PaintedSource : public FrameSource {
public:
  PaintedSource(std::unique_ptr<FrameSource> source,
                std::function<void(Grid<float>&, std::int64_t)> paint)
      : source_(std::move(source)), paint_(std::move(paint)) {}

  SourceResult next() override {
    SourceResult result = source_->next();
    if (FramePtr const* frame = std::get_if<FramePtr>(&result)) {
      Frame copy = **frame;
      Grid<float> depth_m = std::move(copy.cloud_camera.z);
      paint_(depth_m, number(copy.index));
      copy.cloud_camera = cloud_from_depth(std::move(depth_m), copy.intrinsics);
      result = std::make_shared<Frame const>(std::move(copy));
    }
    return result;
  }

private:
  std::unique_ptr<FrameSource> source_;
  std::function<void(Grid<float>&, std::int64_t)> paint_;
};

}  // namespace

std::unique_ptr<FrameSource> frames_of(fs::path const& recording,
                                       std::vector<std::int64_t> const& numbers,
                                       fs::path const& folder) {
  fs::create_symlink(recording / "camera-intrinsics.txt", folder / "camera-intrinsics.txt");
  std::int64_t place = 0;
  for (std::int64_t const frame : numbers) {
    for (char const* what : {"depth.png", "color.jpg", "pose.txt"}) {
      fs::create_symlink(recording / name_of(frame, what), folder / name_of(place, what));
    }
    ++place;
  }
  return open_dataset(folder, {}, {}).source;
}

std::unique_ptr<FrameSource> painted(std::unique_ptr<FrameSource> source,
                                     std::function<void(Grid<float>&, std::int64_t)> paint) {
  return std::make_unique<PaintedSource>(std::move(source), std::move(paint));
}

void for_each_result(std::unique_ptr<FrameSource> source, PipelineConfig const& config,
                     std::function<void(FrameResult const&)> const& visit) {
  ReadAhead frames(std::move(source));
  Workers workers(config.graph.threads);
  WorldLevel const level = workers.execute([&] { return find_level_ahead(frames, config.pose); });
  RunSink const sink = {[&visit](FrameResult const& result) -> Delivery {
                          return [&visit, result] { visit(result); };
                        },
                        [](FrameFailure const& failure) {
                          throw std::runtime_error("a frame failed: " + failure.message);
                        }};
  RunReport const report =
      run_pipeline(frames, make_stages(config, level, {}, std::make_shared<KnownObjects>()), sink,
                   config.graph, std::make_shared<BeliefState const>(), workers, {});
  if (report.error != nullptr) {
    std::rethrow_exception(report.error);
  }
}

void paint_rectangle(Grid<float>& depth_m, std::int64_t frame, float rectangle_m) {
  constexpr int kHalfWidth_px = 70;
  constexpr int kHalfHeight_px = 80;
  auto const wave = [&](double frames_to_and_fro) {
    return std::sin(2.0 * std::numbers::pi * static_cast<double>(frame) / frames_to_and_fro);
  };
  int const middle_u = static_cast<int>((0.5 + 0.375 * wave(97.0)) * depth_m.width());
  int const middle_v = static_cast<int>((0.5 + 0.29 * wave(61.0)) * depth_m.height());
  for (int v = std::max(0, middle_v - kHalfHeight_px);
       v < std::min(depth_m.height(), middle_v + kHalfHeight_px); ++v) {
    for (int u = std::max(0, middle_u - kHalfWidth_px);
         u < std::min(depth_m.width(), middle_u + kHalfWidth_px); ++u) {
      depth_m[{u, v}] = rectangle_m;
    }
  }
}

}  // namespace credo::test
