// Each thing of the belief by itself, read with the plain C API in another process than the
// writer's.
#include <dds/dds.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "core/dds_config.hpp"
#include "dds/participant.hpp"
#include "end_to_end/program.hpp"
#include "end_to_end/topic_reader.hpp"
#include "support/paths.hpp"
#include "things.h"

namespace credo::test {
namespace {

using nlohmann::json;
using ::testing::UnorderedElementsAreArray;

/// What a reader holds of a topic: the state of each instance that is alive, and the keys of those
/// that were disposed of.
template <typename State>
struct Topic {
  std::map<std::string, std::vector<float>> points;
  std::map<std::string, std::uint64_t> revisions;
  std::vector<std::string> disposed;
};

template <typename State>
class ThingReader {
public:
  ThingReader(Participant const& participant, char const* name, dds_topic_descriptor_t const& type,
              std::function<std::string(State const&)> key,
              std::function<std::vector<float>(State const&)> points)
      : reader_(participant, name, type), key_(std::move(key)), points_(std::move(points)) {}

  /// Takes what has come.
  void take() {
    reader_.take([&](State const& state, dds_sample_info_t const& info) {
      std::string const key = key_(state);
      if (info.valid_data) {
        topic.points[key] = points_(state);
        topic.revisions[key] = state.revision;
      }
      if (info.instance_state != DDS_IST_ALIVE) {
        topic.points.erase(key);
        topic.revisions.erase(key);
        topic.disposed.push_back(key);
      }
    });
  }

  Topic<State> topic;

private:
  TopicReader<State> reader_;
  std::function<std::string(State const&)> key_;
  std::function<std::vector<float>(State const&)> points_;
};

std::vector<float> values(dds_sequence_float const& sequence) {
  return {sequence._buffer, sequence._buffer + sequence._length};
}

class Topics : public ::testing::Test {
protected:
  Topics() { config_.topic_prefix = "things_" + std::to_string(getpid()); }

  DdsConfig config_;
  TempFolder folder_;
};

// The bottle is moved: what stood at its first place leaves the belief, and so its topic.
TEST_F(Topics, EachThingIsAnInstanceThatGoesWithIt) {
  Participant const participant(config_);
  std::map<std::string, double> log_odds;
  ThingReader<credo_msg_StuffState> stuff(
      participant, "stuff", credo_msg_StuffState_desc,
      [&](auto const& state) {
        log_odds[std::to_string(state.stuff_id)] = state.stuff.log_odds;
        return std::to_string(state.stuff_id);
      },
      [](auto const& state) { return values(state.points_world_m); });
  ThingReader<credo_msg_ObjectState> objects(
      participant, "objects", credo_msg_ObjectState_desc,
      [](auto const& state) { return std::string(state.object_id); },
      [](auto const& /*state*/) { return std::vector<float>(); });
  ThingReader<credo_msg_WallState> walls(
      participant, "walls", credo_msg_WallState_desc,
      [](auto const& state) { return std::to_string(state.wall_id); },
      [](auto const& state) { return values(state.points_world_m); });
  ThingReader<credo_msg_FloorState> floor(
      participant, "floor", credo_msg_FloorState_desc,
      [](auto const& state) { return std::string(state.source); },
      [](auto const& state) { return values(state.points_world_m); });
  Program run(credo_command(
      {"run", "--source", "sim:bottle-moves", "--prior",
       (source_folder() / "scenes/priors/bottle-moves.yaml").string(), "--set", "detector.kind=sim",
       "--set", "detector.sim.sigma_position_m=0", "--set", "detector.sim.sigma_rotation_rad=0",
       // So that the bottle becomes another thing where it is moved to, and the first one goes.
       "--set", "fusion.visibility=false", "--set", "dds.topic_prefix=" + config_.topic_prefix,
       "--set", "dds.source=robot", "--out", (folder_ / "out").string(), "--linger", "60"}));
  auto const take_all = [&] {
    stuff.take();
    objects.take();
    walls.take();
    floor.take();
  };
  constexpr std::uint64_t kLast = 6;
  for (int i = 0; i < 400 && floor.topic.revisions["robot"] < kLast; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    take_all();
  }
  // The floor's goes before the stuff's.
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  take_all();

  json const last = json::parse(read_lines(folder_ / "out/belief.jsonl").back());
  auto const ids = [&](char const* things) {
    std::vector<std::string> found;
    for (json const& thing : last[things]) {
      found.push_back(thing["id"].is_string() ? thing["id"].get<std::string>()
                                              : thing["id"].dump());
    }
    return found;
  };
  auto const expect_alive = [&](auto const& topic, std::vector<std::string> const& expected) {
    std::vector<std::string> alive;
    for (auto const& [id, revision] : topic.revisions) {
      alive.push_back(id);
      EXPECT_EQ(revision, kLast) << id;
    }
    EXPECT_THAT(alive, UnorderedElementsAreArray(expected));
  };
  expect_alive(stuff.topic, ids("stuff"));
  expect_alive(objects.topic, ids("objects"));
  expect_alive(walls.topic, ids("walls"));
  expect_alive(floor.topic, {"robot"});
  EXPECT_THAT(stuff.topic.disposed, ::testing::ElementsAre("1"));
  for (json const& thing : last["stuff"]) {
    EXPECT_EQ(log_odds[thing["id"].dump()], thing["log_odds"].get<double>());
  }
  EXPECT_EQ(floor.topic.points["robot"].size(), 3 * last["floor"]["points"].get<std::size_t>());
  for (json const& wall : last["walls"]) {
    EXPECT_EQ(walls.topic.points[wall["id"].dump()].size(), 3 * wall["points"].get<std::size_t>());
  }
  for (json const& thing : last["stuff"]) {
    std::vector<float> const& points = stuff.topic.points[thing["id"].dump()];
    ASSERT_GE(points.size(), 3U);
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_GE(points[i], thing["min"][i % 3].get<float>() - 1e-6F);
      EXPECT_LE(points[i], thing["max"][i % 3].get<float>() + 1e-6F);
    }
  }
  run.send(SIGINT);
  EXPECT_EQ(run.wait().code, 0);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  take_all();
  EXPECT_TRUE(floor.topic.revisions.empty()) << "a Credo that ends takes its things along";
}

// Frames that have nothing to do with each other, of which the second shows a wall only.
TEST_F(Topics, AFloorThatLeavesTheBeliefLeavesItsTopic) {
  write_text(folder_ / "scene.yaml", R"(things:
  - {name: floor, kind: floor, shape: box, size_m: [8, 8, 0.05], position_m: [0, 0, -0.05]}
  - {name: wall, kind: wall, shape: box, size_m: [0.1, 8, 5], position_m: [3.95, 0, 0]}
camera:
  frames_per_s: 1
  path:
    - {time_s: 0, position_m: [0, 0, 1.4], look_at_m: [2, 0, 0.6]}
    - {time_s: 1, position_m: [1.5, 0, 2.5], look_at_m: [4, 0, 2.5]}
)");
  Participant const participant(config_);
  ThingReader<credo_msg_FloorState> floor(
      participant, "floor", credo_msg_FloorState_desc,
      [](auto const& state) { return std::string(state.source); },
      [](auto const& state) { return values(state.points_world_m); });
  Program run(credo_command({"run", "--source", "sim:" + (folder_ / "scene.yaml").string(), "--set",
                             "capture.independent_frames=true", "--set", "dds.source=robot",
                             "--set", "dds.topic_prefix=" + config_.topic_prefix, "--out",
                             (folder_ / "out").string(), "--linger", "60"}));
  for (int i = 0; i < 200 && floor.topic.disposed.empty(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    floor.take();
  }
  EXPECT_THAT(floor.topic.disposed, ::testing::ElementsAre("robot")) << "while it still lingers";
  std::vector<std::string> const lines = read_lines(folder_ / "out/belief.jsonl");
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_FALSE(json::parse(lines[0])["floor"].is_null());
  EXPECT_TRUE(json::parse(lines[1])["floor"].is_null());
  run.send(SIGINT);
  EXPECT_EQ(run.wait().code, 0);
}

}  // namespace
}  // namespace credo::test
