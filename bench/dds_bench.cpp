// The belief on DDS: a publisher at 30 Hz and ten subscribers, each a process of its own that takes
// the snapshot and every thing with its points, on the loopback. How old is a belief when it has
// arrived whole, and does everyone get every revision?
//
// The peer is Cyclone DDS itself: one sample that is as large as a frame's topics together, from
// the same writer to the same readers, in the same run.
#include <dds/dds.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "belief.h"
#include "dds/belief_publisher.hpp"
#include "dds/entities.hpp"
#include "support/room_belief.hpp"
#include "things.h"

namespace credo {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

constexpr int kSubscribers = 10;
constexpr int kFrames = 300;
/// Of a room_belief.
constexpr int kThings = 205;
constexpr auto kPeriod = std::chrono::nanoseconds(1'000'000'000 / 30);

/// The same clock in every process.
std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// One belief, or one sample of the peer, as a subscriber got it.
struct Arrival {
  std::uint64_t revision = 0;
  double age_ms = 0.0;
};

/// What one subscriber got.
struct Received {
  std::vector<Arrival> arrivals;
  /// With their last thing.
  std::vector<Arrival> whole;
  std::size_t points = 0;
};

dds_entity_t reader_of(Participant const& participant, char const* name,
                       dds_topic_descriptor_t const& type) {
  Qos const qos = last_state_qos();
  // A reader that wants every revision keeps a few, so that it may be late once.
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, 8);
  dds_entity_t const topic = dds_create_topic(participant.handle(), &type,
                                              participant.topic(name).c_str(), nullptr, nullptr);
  dds_entity_t const reader = dds_create_reader(participant.handle(), topic, qos.get(), nullptr);
  dds_set_status_mask(reader, DDS_DATA_AVAILABLE_STATUS);
  return reader;
}

/// Takes all that has come; `on` is called with each.
template <typename State, typename On>
void take(dds_entity_t reader, On const& on) {
  constexpr std::size_t kMost = 512;
  static std::array<void*, kMost> samples{};
  static std::array<dds_sample_info_t, kMost> infos{};
  dds_return_t count = 0;
  while ((count = dds_take(reader, samples.data(), infos.data(), kMost, kMost)) > 0) {
    for (dds_return_t i = 0; i < count; ++i) {
      if (infos.at(static_cast<std::size_t>(i)).valid_data) {
        on(*static_cast<State const*>(samples.at(static_cast<std::size_t>(i))));
      }
    }
    dds_return_loan(reader, samples.data(), count);
    samples.fill(nullptr);
  }
}

double age_ms(std::int64_t since_ns) {
  return static_cast<double>(now_ns() - since_ns) * 1e-6;
}

/// Until the last frame, or nothing has come for a while. `take_all` tells whether it is content.
template <typename Take>
void listen(dds_entity_t waitset, Received const& received, Take const& take_all) {
  std::int64_t const give_up_after_ns = 10'000'000'000;
  std::int64_t last_ns = now_ns();
  bool content = true;
  while (now_ns() < last_ns + give_up_after_ns &&
         (!content || received.arrivals.empty() || received.arrivals.back().revision < kFrames)) {
    dds_waitset_wait(waitset, nullptr, 0, content ? DDS_MSECS(100) : DDS_USECS(200));
    std::size_t const before = received.arrivals.size();
    content = take_all();
    last_ns = received.arrivals.size() > before ? now_ns() : last_ns;
  }
}

Received subscribe(Participant const& participant) {
  dds_entity_t const waitset = dds_create_waitset(participant.handle());
  dds_entity_t const beliefs = reader_of(participant, "belief", credo_msg_Belief_desc);
  dds_entity_t const floor = reader_of(participant, "floor", credo_msg_FloorState_desc);
  dds_entity_t const walls = reader_of(participant, "walls", credo_msg_WallState_desc);
  dds_entity_t const stuff = reader_of(participant, "stuff", credo_msg_StuffState_desc);
  // One wake-up a frame, then the things that it names.
  dds_waitset_attach(waitset, beliefs, 0);
  Received received;
  std::map<std::uint64_t, int> things;
  auto const take_things = [&] {
    auto const take_state = [&](auto const& state) {
      received.points += state.points_world_m._length / 3;
      ++things[state.revision];
    };
    take<credo_msg_FloorState>(floor, take_state);
    take<credo_msg_WallState>(walls, take_state);
    take<credo_msg_StuffState>(stuff, take_state);
  };
  std::vector<std::pair<std::uint64_t, std::int64_t>> incomplete;
  listen(waitset, received, [&] {
    take<credo_msg_Belief>(beliefs, [&](credo_msg_Belief const& belief) {
      received.arrivals.push_back({belief.revision, age_ms(belief.stamp_ns)});
      incomplete.emplace_back(belief.revision, belief.stamp_ns);
    });
    take_things();
    std::erase_if(incomplete, [&](auto const& belief) {
      bool const whole = things[belief.first] == kThings;
      if (whole) {
        received.whole.push_back({belief.first, age_ms(belief.second)});
      }
      return whole;
    });
    return incomplete.empty();
  });
  return received;
}

/// The peer: the points of a frame in one sample, its time in a number.
Received subscribe_raw(Participant const& participant) {
  dds_entity_t const waitset = dds_create_waitset(participant.handle());
  dds_entity_t const raw = reader_of(participant, "raw", credo_msg_FloorState_desc);
  dds_waitset_attach(waitset, raw, 0);
  Received received;
  listen(waitset, received, [&] {
    take<credo_msg_FloorState>(raw, [&](credo_msg_FloorState const& state) {
      received.arrivals.push_back(
          {state.revision, age_ms(static_cast<std::int64_t>(state.floor.point_count))});
      received.points += state.points_world_m._length / 3;
    });
    return true;
  });
  return received;
}

void write_file(fs::path const& path, Received const& received) {
  std::ofstream out(path);
  out << received.points << ' ' << received.arrivals.size() << '\n';
  for (auto const* list : {&received.arrivals, &received.whole}) {
    for (Arrival const& arrival : *list) {
      out << arrival.revision << ' ' << arrival.age_ms << '\n';
    }
  }
}

double quantile(std::vector<double> values, double q) {
  if (values.empty()) {
    return 0.0;
  }
  auto const at = static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, values.begin() + at);
  return values[static_cast<std::size_t>(at)];
}

/// Of all subscribers.
struct Summary {
  std::vector<double> ages_ms;
  std::vector<double> whole_ages_ms;
  std::size_t least_revisions = kFrames;
  std::size_t points = 0;
};

Summary summary_of_files(fs::path const& folder) {
  Summary summary;
  for (int i = 0; i < kSubscribers; ++i) {
    std::ifstream file(folder / std::to_string(i));
    std::size_t points = 0;
    std::size_t count = 0;
    file >> points >> count;
    summary.points += points;
    std::set<std::uint64_t> revisions;
    for (Arrival a; file >> a.revision >> a.age_ms;) {
      if (count > 0) {
        --count;
        revisions.insert(a.revision);
        summary.ages_ms.push_back(a.age_ms);
      } else {
        summary.whole_ages_ms.push_back(a.age_ms);
      }
    }
    summary.least_revisions = std::min(summary.least_revisions, revisions.size());
  }
  return summary;
}

void print(char const* what, std::vector<double> const& times_ms) {
  std::printf("  %-28s %7.2f ms median, %7.2f ms p99\n", what, quantile(times_ms, 0.5),
              quantile(times_ms, 0.99));
}

/// Runs ten subscribers and a publisher beside them, which writes frame i by `write(i)`.
template <typename MakeWriter>
Summary run_phase(DdsConfig const& config, char const* kind, MakeWriter const& make_writer) {
  fs::path const folder = fs::temp_directory_path() / config.topic_prefix;
  fs::create_directories(folder);
  std::vector<pid_t> children;
  for (int i = 0; i < kSubscribers; ++i) {
    // A program of its own: DDS does not outlive a fork.
    std::string const file = (folder / std::to_string(i)).string();
    pid_t const child = fork();
    if (child == 0) {
      execl("/proc/self/exe", "credo_dds_bench", kind, config.topic_prefix.c_str(), file.c_str(),
            nullptr);
      std::_Exit(127);
    }
    children.push_back(child);
  }
  {
    auto const write = make_writer();
    std::this_thread::sleep_for(3s);  // until all have found each other
    std::vector<double> write_ms;
    auto next = std::chrono::steady_clock::now();
    for (int i = 0; i < kFrames; ++i) {
      write_ms.push_back(write(i));
      next += kPeriod;
      std::this_thread::sleep_until(next);
    }
    print("writing", write_ms);
    for (pid_t const child : children) {
      waitpid(child, nullptr, 0);
    }
  }
  Summary summary = summary_of_files(folder);
  fs::remove_all(folder);
  return summary;
}

void print(Summary const& summary) {
  print("arrives", summary.ages_ms);
  if (!summary.whole_ages_ms.empty()) {
    print("whole, with its points", summary.whole_ages_ms);
  }
  std::printf("  revisions received           %zu of %d by whoever got least, %zu points a frame\n",
              summary.least_revisions, kFrames,
              summary.points / (static_cast<std::size_t>(kSubscribers) * kFrames));
}

int run_subscriber(std::string const& kind, DdsConfig const& config, fs::path const& file) {
  Participant const participant(config);
  write_file(file, kind == "raw" ? subscribe_raw(participant) : subscribe(participant));
  return 0;
}

int run(DdsConfig const& config) {
  std::printf("%d subscribers, %d frames at 30 Hz, loopback\n", kSubscribers, kFrames);

  std::printf("belief: the snapshot, then 205 things with 41000 points\n");
  Summary const belief = run_phase(config, "things", [&] {
    auto publisher = std::make_shared<BeliefPublisher>(config);
    return [publisher](int i) {
      BeliefState state = test::room_belief(i);
      BeliefSummary summary = summary_of(state);
      summary.stamp_ns = now_ns();
      publisher->publish(state, summary);
      return age_ms(summary.stamp_ns);
    };
  });
  print(belief);

  std::printf("peer: Cyclone DDS alone, one sample with 41000 points\n");
  Summary const raw = run_phase(config, "raw", [&] {
    auto participant = std::make_shared<Participant>(config);
    auto writer = std::make_shared<DdsEntity>(
        writer_of(*participant, "raw", credo_msg_FloorState_desc, last_state_qos()));
    return [participant, writer](int i) {
      std::vector<float> points(std::size_t{3} * 41000, static_cast<float>(i));
      std::string source = "raw";
      credo_msg_FloorState state{};
      state.source = source.data();
      state.revision = static_cast<std::uint64_t>(i) + 1;
      state.points_world_m._buffer = points.data();
      state.points_world_m._length = state.points_world_m._maximum =
          static_cast<std::uint32_t>(points.size());
      std::int64_t const start_ns = now_ns();
      state.floor.point_count = static_cast<std::uint64_t>(start_ns);
      write_now(*writer, state);
      return age_ms(start_ns);
    };
  });
  print(raw);
  return 0;
}

}  // namespace
}  // namespace credo

int main(int argc, char** argv) {
  credo::DdsConfig config;
  config.source = "bench";
  config.topic_prefix = argc > 2 ? argv[2] : "bench_" + std::to_string(getpid());
  return argc > 3 ? credo::run_subscriber(argv[1], config, argv[3]) : credo::run(config);
}
