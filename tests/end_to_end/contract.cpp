#include "end_to_end/contract.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <nlohmann/json.hpp>
#include <set>

#include "end_to_end/program.hpp"
#include "io/image.hpp"

namespace credo::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

bool is_whole(json const& value, std::int64_t least, std::int64_t most = INT64_MAX) {
  return value.is_number_integer() && value.get<std::int64_t>() >= least &&
         value.get<std::int64_t>() <= most;
}

bool are_numbers(json const& value, std::size_t count) {
  return value.is_array() && value.size() == count &&
         std::all_of(value.begin(), value.end(),
                     [](json const& n) { return n.is_number() && std::isfinite(n.get<double>()); });
}

bool is_unit(json const& value, std::size_t count) {
  double squares = 0.0;
  for (std::size_t i = 0; are_numbers(value, count) && i < count; ++i) {
    squares += value[i].get<double>() * value[i].get<double>();
  }
  return std::abs(squares - 1.0) < 1e-5;
}

bool is_probability(json const& value) {
  return value.is_number() && value.get<double>() >= 0.0 && value.get<double>() <= 1.0;
}

bool is_evidence(json const& value) {
  static std::set<std::string> const words = {"seen", "seen_through", "occluded", "out_of_view",
                                              "not_seen"};
  return value.is_string() && words.count(value.get<std::string>()) == 1;
}

bool is_covariance(json const& value) {
  if (!are_numbers(value, 36)) {
    return false;
  }
  for (std::size_t r = 0; r < 6; ++r) {
    for (std::size_t c = 0; c < 6; ++c) {
      if (value[6 * r + c] != value[6 * c + r] || value[7 * r].get<double>() < 0.0) {
        return false;
      }
    }
  }
  return true;
}

bool is_between(json const& low, json const& middle, json const& high) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(low[i] <= middle[i] && middle[i] <= high[i])) {
      return false;
    }
  }
  return true;
}

/// Checks one folder and collects what falls short.
class Contract {
public:
  explicit Contract(fs::path const& out) : out_(out) {}

  void beliefs() {
    std::vector<std::string> const lines = read_lines(out_ / "belief.jsonl");
    std::int64_t last_frame = -1;
    std::int64_t last_stamp = INT64_MIN;
    for (std::string const& text : lines) {
      json const line = json::parse(text);
      where_ = "frame " + line.at("frame").dump();
      belief(line);
      expect(line["frame"] > last_frame, "frames rise");
      expect(line["stamp_ns"] >= last_stamp, "stamps do not fall");
      last_frame = line["frame"];
      last_stamp = line["stamp_ns"];
      lines_.push_back(line);
    }
  }

  void metrics() {
    where_ = "metrics.json";
    json const all = json::parse(read_text(out_ / "metrics.json"));
    for (char const* key : {"frames_in", "frames_out", "failed"}) {
      expect(is_whole(all.at(key), 0), key);
    }
    for (char const* key :
         {"wall_s", "cpu_s", "fps", "peak_rss_mb", "rss_mb_at_100", "rss_mb_end"}) {
      expect(all.at(key).is_number() && all[key] >= 0, key);
    }
    std::int64_t settled =
        all["frames_out"].get<std::int64_t>() + all["failed"].get<std::int64_t>();
    for (json const& count : all.at("dropped")) {
      settled += count.get<std::int64_t>();
    }
    expect(all["frames_in"] == settled, "in = out + failed + dropped");
    expect(all["frames_out"] == lines_.size(), "a line for each frame out");
    for (char const* key : {"p50", "p95", "p99", "max"}) {
      expect(all.at("latency_ms").at(key).is_number(), key);
    }
    expect(all.at("stages").size() >= 6 && all.at("queues").size() >= 6, "stages and queues");
    for (json const& stage : all["stages"]) {
      expect(is_whole(stage.at("count"), 0), "count of a stage");
      expect(stage.at("p50_ms") <= stage.at("p95_ms") && stage["p95_ms"] <= stage.at("p99_ms") &&
                 stage["p99_ms"] <= stage.at("max_ms"),
             "quantiles rise");
    }
    for (json const& queue : all["queues"]) {
      expect(is_whole(queue.at("dropped"), 0) && is_whole(queue.at("peak"), 0) &&
                 is_whole(queue.at("capacity"), 1) && queue["peak"] <= queue["capacity"],
             "capacity, peak and drops of a queue");
    }
  }

  /// Labels that the beliefs speak of are in their frame's image, and no other frame has one.
  void labels() {
    if (!fs::exists(out_ / "labels")) {
      return;
    }
    std::size_t files = 0;
    for ([[maybe_unused]] auto const& entry : fs::directory_iterator(out_ / "labels")) {
      ++files;
    }
    where_ = "labels";
    expect(files == lines_.size(), "an image for each line");
    for (json const& line : lines_) {
      where_ = "labels of frame " + line["frame"].dump();
      char name[32];
      std::snprintf(name, sizeof name, "%06d.png", line["frame"].get<int>());
      Grid<std::uint16_t> const image = read_png16(out_ / "labels" / name);
      std::set<std::uint16_t> codes;
      for (std::size_t i = 0; i < image.size(); ++i) {
        codes.insert(image[i]);
      }
      for (char const* kind : {"walls", "objects", "stuff"}) {
        for (json const& item : line[kind]) {
          expect(item["label"].is_null() || codes.count(item["label"].get<std::uint16_t>()) == 1,
                 "label " + item["label"].dump() + " is in the image");
        }
      }
    }
  }

  void config() {
    where_ = "config.yaml";
    expect(!read_text(out_ / "config.yaml").empty(), "is there");
  }

  std::vector<std::string> faults;

private:
  void expect(bool holds, std::string const& what) {
    if (!holds) {
      faults.push_back(where_ + ": " + what);
    }
  }

  void belief(json const& line) {
    expect(line.at("schema") == 1, "schema");
    expect(is_whole(line.at("frame"), 0) && is_whole(line.at("stamp_ns"), 0), "frame, stamp_ns");
    expect(is_whole(line.at("segmented_with"), -1) && line["segmented_with"] < line["frame"],
           "segmented_with");
    json const& T = line.at("T_world_camera");
    expect(are_numbers(T, 16) && T[12] == 0 && T[13] == 0 && T[14] == 0 && T[15] == 1,
           "T_world_camera");
    json const& floor = line.at("floor");
    expect(floor.is_null() ||
               (is_unit(floor.at("normal"), 3) && floor.at("height_m").is_number() &&
                is_whole(floor.at("points"), 1) && is_probability(floor.at("probability")) &&
                is_evidence(floor.at("evidence"))),
           "floor");
    things(line.at("walls"), 2000, 2999, [&](json const& wall) {
      expect(is_whole(wall.at("id"), 0) && is_unit(wall.at("normal"), 3) &&
                 is_whole(wall.at("points"), 1) && is_probability(wall.at("probability")) &&
                 is_evidence(wall.at("evidence")) && wall.at("segment").size() == 2 &&
                 are_numbers(wall["segment"][0], 2) && are_numbers(wall["segment"][1], 2),
             "wall " + wall.dump());
    });
    things(line.at("objects"), 3000, 3999, [&](json const& object) {
      expect(object.at("id").is_string() && object.at("type").is_string() &&
                 is_probability(object.at("probability")) &&
                 are_numbers(object.at("position"), 3) &&
                 is_unit(object.at("orientation_xyzw"), 4) &&
                 is_covariance(object.at("covariance")) && is_evidence(object.at("evidence")),
             "object " + object.dump());
    });
    things(line.at("stuff"), 4000, 65535, [&](json const& stuff) {
      expect(is_whole(stuff.at("id"), 0) && is_probability(stuff.at("probability")) &&
                 is_whole(stuff.at("history"), 1) && is_whole(stuff.at("points"), 1) &&
                 are_numbers(stuff.at("min"), 3) && are_numbers(stuff.at("centroid"), 3) &&
                 are_numbers(stuff.at("max"), 3) &&
                 is_between(stuff["min"], stuff["centroid"], stuff["max"]) &&
                 is_evidence(stuff.at("evidence")),
             "stuff " + stuff.dump());
    });
  }

  template <typename Check>
  void things(json const& list, int first_label, int last_label, Check const& check) {
    std::set<std::string> ids;
    for (json const& thing : list) {
      check(thing);
      expect(thing.at("label").is_null() || is_whole(thing["label"], first_label, last_label),
             "label " + thing["label"].dump());
      expect(ids.insert(thing["id"].dump()).second, "id " + thing["id"].dump() + " is unique");
    }
  }

  fs::path out_;
  std::string where_;
  std::vector<json> lines_;
};

}  // namespace

std::vector<std::string> contract_faults(fs::path const& out) {
  Contract contract(out);
  try {
    contract.beliefs();
    contract.metrics();
    contract.labels();
    contract.config();
  } catch (std::exception const& error) {
    contract.faults.emplace_back(error.what());  // a file or a key that is missing
  }
  return contract.faults;
}

}  // namespace credo::test
