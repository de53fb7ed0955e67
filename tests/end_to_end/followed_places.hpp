#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/frame_source.hpp"
#include "core/grid.hpp"
#include "graph/pipeline_config.hpp"

// How well stuff keeps its name: places on things, marked by hand, followed through a recording.
namespace credo::test {

/// A place on a thing, marked by hand in the depth image of one frame.
struct MarkedPlace {
  std::string thing;
  std::int64_t frame = 0;
  Pixel pixel;
};

/// Lines `thing frame u v`; # begins a comment.
std::vector<MarkedPlace> read_marked_places(std::filesystem::path const& file);

/// What became of a place.
struct FollowedPlace {
  std::string thing;
  /// In the frame that the recording's poses count in, metres.
  Eigen::Vector3d p_source = Eigen::Vector3d::Zero();
  /// Frames that show it, and those of them in which it was no believed thing's.
  int shown = 0;
  int lost = 0;
  /// How often it was another thing's than in the last frame in which it was one's.
  int switches = 0;
  /// Of the things that it was: in how many frames.
  std::map<std::uint32_t, int> frames_of_id = {};
  std::uint32_t last_id = 0;
};

/// The marked places in space, by the pose of the frames they are marked in and the depth around
/// them (median).
std::vector<FollowedPlace> places_of(std::filesystem::path const& recording,
                                     std::vector<MarkedPlace> const& marked);

/// Runs the source through the pipeline and looks in each frame which believed thing has most of
/// the pixels around each place. A place is shown where it projects into the image and what is
/// measured there is no more than 10 cm away from it.
std::vector<FollowedPlace> follow(std::unique_ptr<FrameSource> source, PipelineConfig const& config,
                                  std::vector<FollowedPlace> places);

/// Switches per 1000 frames in which a place was a thing's; of all places together.
double switches_per_1000(std::vector<FollowedPlace> const& places);

/// A line for each place, for whoever reads the test's output.
std::string report_of(std::vector<FollowedPlace> const& places);

}  // namespace credo::test
