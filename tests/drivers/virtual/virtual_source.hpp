#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "drivers/virtual/plain_dataset.hpp"
#include "io/dataset.hpp"
#include "openni/openni_source.hpp"
#include "support/temp_folder.hpp"

namespace credo::test {

/// What a source gave.
struct Seen {
  std::vector<FramePtr> frames;
  /// Frames that were lost, by reason.
  std::map<std::string, int> lost;

  [[nodiscard]] int lost_by(std::string const& reason) const {
    auto const found = lost.find(reason);
    return found == lost.end() ? 0 : found->second;
  }
  [[nodiscard]] int colored() const {
    return static_cast<int>(
        std::ranges::count_if(frames, [](FramePtr const& f) { return !f->color.empty(); }));
  }
};

/// The sensor's tick that a frame is of, as long as its clock runs true.
inline std::int64_t tick_of(Frame const& frame) {
  return std::lround(static_cast<double>(frame.stamp_ns - 1'000'000'000) * 30e-9);
}

class VirtualSource : public ::testing::Test {
protected:
  /// Without faults where none are given.
  void open(std::string const& fault, SensorConfig const& config = {}) {
    write_dataset(folder_ / "a", 12);
    open_sensor(fault, config);
  }
  /// ... on the dataset that lies in the folder `a` already.
  void open_sensor(std::string const& fault, SensorConfig const& config) {
    write_text(folder_ / "s.json",
               R"({"sensors": [{"name": "a", "dataset": "a", "faults": [)" + fault + "]}]}");
    ::setenv("CREDO_VIRTUAL_SENSOR", (folder_ / "s.json").c_str(), 1);
    opened_ = open_openni("virtual://a", {}, {}, config,
                          [&](std::string const& note) { notes_.push_back(note); }, {});
  }

  /// Reads until a frame of that time of the sensor [s] has come.
  Seen read_until(double time_s) {
    Seen seen;
    std::int64_t const end_ns = 1'000'000'000 + static_cast<std::int64_t>(1e9 * time_s);
    while (seen.frames.empty() || seen.frames.back()->stamp_ns < end_ns) {
      SourceResult result = opened_.source->next();
      if (auto const* failure = std::get_if<FrameFailure>(&result)) {
        EXPECT_EQ(number(failure->index), next_index_++);
        EXPECT_THAT(failure->message, ::testing::HasSubstr("openni:virtual://a: "));
        ++seen.lost[failure->reason];
        continue;
      }
      FramePtr frame = std::get<FramePtr>(std::move(result));
      EXPECT_EQ(number(frame->index), next_index_++);
      if (!seen.frames.empty()) {
        EXPECT_GT(frame->stamp_ns, seen.frames.back()->stamp_ns);
      }
      seen.frames.push_back(std::move(frame));
    }
    return seen;
  }

  /// Every tick is a frame, or counted as one that did not come or was broken.
  static void expect_all_counted(Seen const& seen) {
    std::int64_t const ticks = tick_of(*seen.frames.back()) - tick_of(*seen.frames.front()) + 1;
    EXPECT_EQ(static_cast<std::int64_t>(seen.frames.size()) + seen.lost_by("missed") +
                  seen.lost_by("broken_image"),
              ticks);
  }

  TempFolder folder_;
  OpenedSource opened_;
  std::vector<std::string> notes_;
  std::int64_t next_index_ = 0;
};

}  // namespace credo::test
