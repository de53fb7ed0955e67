#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "core/frame_source.hpp"
#include "core/grid.hpp"
#include "graph/pipeline_config.hpp"
#include "graph/run_sink.hpp"

// A recording as other sensors might have taken it.
namespace credo::test {

/// These frames (by number, in this order) of a recording in the layout `frame-NNNNNN.*`, at 30 Hz.
/// `folder` is an empty one for links to its files, and outlives the source.
std::unique_ptr<FrameSource> frames_of(std::filesystem::path const& recording,
                                       std::vector<std::int64_t> const& numbers,
                                       std::filesystem::path const& folder);

/// The source with something painted into each depth image (metres, 0 for no depth).
std::unique_ptr<FrameSource> painted(
    std::unique_ptr<FrameSource> source,
    std::function<void(Grid<float>& depth_m, std::int64_t frame)> paint);

/// Runs the source through the pipeline; what it throws, and the first bad frame, ends in a throw.
void for_each_result(std::unique_ptr<FrameSource> source, PipelineConfig const& config,
                     std::function<void(FrameResult const&)> const& visit);

/// Sets a rectangle of 140 x 160 pixels, which wanders to and fro over the image, to one depth.
void paint_rectangle(Grid<float>& depth_m, std::int64_t frame, float rectangle_m);

}  // namespace credo::test
