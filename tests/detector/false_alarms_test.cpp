// What is told of objects that are not there, on recorded table tops.
#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "core/cloud.hpp"
#include "detector/bpa_detector.hpp"
#include "io/bop_models.hpp"
#include "stages/segments/recorded_depths.hpp"
#include "support/recordings.hpp"

namespace credo::test {
namespace {

TEST(FalseAlarms, AreRareOnTableTopsWithoutTheObjects) {
  CREDO_REQUIRE_RECORDING("osd");
  CREDO_REQUIRE_RECORDING("objects/lmo");
  ObjectModels models;
  std::vector<DetectionRequest> requests;
  PoseDistribution const anywhere{Se3(Eigen::Quaterniond::Identity(), {0, 0, 1}),
                                  100.0 * Matrix6d::Identity()};
  for (ObjectModel& model : read_bop_models(recordings() / "objects/lmo", "lmo")) {
    requests.push_back({model.name, model.name, anywhere});
    models.emplace(model.name, std::move(model));
  }
  ASSERT_EQ(models.size(), 8U);
  BpaConfig config;
  config.search = ObjectSearch::kGlobal;
  BpaDetector detector(models, config);
  std::vector<std::filesystem::path> const files = table_tops();
  ASSERT_FALSE(files.empty());
  std::size_t alarms = 0;
  for (std::filesystem::path const& file : files) {
    Frame frame;
    frame.intrinsics = {kTableTopFocal_px, kTableTopFocal_px, 319.5, 239.5};
    frame.cloud_camera = cloud_from_depth(table_top_depth_m(file), frame.intrinsics);
    for (Detection const& alarm : detector.detect(frame, requests)) {
      ++alarms;
      std::cout << file.filename() << ": " << alarm.type << ' ' << alarm.score << '\n';
    }
  }
  // One in ten clouds.
  EXPECT_LE(10 * alarms, files.size());
  RecordProperty("alarms", static_cast<int>(alarms));
}

}  // namespace
}  // namespace credo::test
