#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "geometry/reachability/reachability.hpp"
#include "io/dataset.hpp"
#include "stages/clustering/clustering.hpp"
#include "stages/normals/normals.hpp"
#include "support/literal_clustering.hpp"
#include "support/recordings.hpp"

namespace credo {
namespace {

// Every `stride`-th frame of a recording, at most `count`.
std::vector<FramePtr> read_frames(std::filesystem::path const& folder, int stride,
                                  std::size_t count) {
  std::vector<FramePtr> frames;
  OpenedSource const opened = open_dataset(folder, CaptureConfig{}, PoseConfig{});
  for (int i = 0; frames.size() < count; ++i) {
    SourceResult const next = opened.source->next();
    if (std::holds_alternative<EndOfSource>(next)) {
      break;
    }
    if (i % stride == 0 && std::holds_alternative<FramePtr>(next)) {
      frames.push_back(std::get<FramePtr>(next));
    }
  }
  return frames;
}

// Whole frames at full resolution, nothing taken away: same partition, same numbers.
void expect_literal_components(std::vector<FramePtr> const& frames) {
  ASSERT_FALSE(frames.empty());
  for (FramePtr const& frame : frames) {
    OrganizedCloud const& cloud = frame->cloud_camera;
    NormalMap const normals = estimate_normals(cloud, frame->intrinsics, NormalsConfig{});
    Grid<std::uint8_t> const everything(cloud.width(), cloud.height(), 1);
    auto const components = connected_components(cloud, normals, everything, {});
    EXPECT_GE(*std::max_element(components.begin(), components.end()), 0);
    EXPECT_TRUE(components == test::literal_components(cloud, normals, everything, {}))
        << "frame " << number(frame->index);
  }
}

TEST(ClustersOfRecordings, KitchenIsTheLiteralAlgorithm) {
  CREDO_REQUIRE_RECORDING("kitchen");
  expect_literal_components(read_frames(test::recordings() / "kitchen", 60, 3));
}

TEST(ClustersOfRecordings, TableTopsAreTheLiteralAlgorithm) {
  CREDO_REQUIRE_RECORDING("osd");
  expect_literal_components(read_frames(test::recordings() / "osd", 4, 4));
}

TEST(ClustersOfRecordings, OfficeIsTheLiteralAlgorithm) {
  CREDO_REQUIRE_RECORDING("thermos");
  expect_literal_components(read_frames(test::recordings() / "thermos", 7, 2));
}

TEST(ClustersOfRecordings, EveryLabelHasItsCluster) {
  CREDO_REQUIRE_RECORDING("kitchen");
  for (FramePtr const& frame : read_frames(test::recordings() / "kitchen", 50, 3)) {
    NormalMap const normals =
        estimate_normals(frame->cloud_camera, frame->intrinsics, NormalsConfig{});
    Segmentation const result = cluster_stuff(
        *frame, normals, unassigned_segmentation(*frame, frame->T_source_camera, kPriorFrame), {});
    std::vector<std::size_t> pixels(result.stuff.size());
    for (LabelCode const label : result.labels) {
      if (is_stuff(label)) {
        ASSERT_LT(label - kFirstStuff, pixels.size());
        ++pixels[label - kFirstStuff];
      }
    }
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      StuffCluster const& stuff = result.stuff[i];
      EXPECT_EQ(stuff.label, kFirstStuff + i);
      EXPECT_EQ(stuff.pixel_count, pixels[i]);
      EXPECT_GE(stuff.pixel_count, 25U);
      EXPECT_TRUE(stuff.bounds_world.contains(stuff.centroid_world));
      EXPECT_FALSE(stuff.points_world.empty());
    }
  }
}

}  // namespace
}  // namespace credo
