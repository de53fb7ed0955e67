#include "dds/delivery_check.hpp"

#include <cstdint>
#include <thread>
#include <vector>

#include "dds/entities.hpp"
#include "dds/participant.hpp"
#include "dds/thing_messages.hpp"
#include "segmentation.h"

namespace credo {
namespace {

using Clock = std::chrono::steady_clock;

constexpr char const* kTopic = "doctor";
/// No domain of a user's has these numbers: they end at 230.
constexpr std::uint32_t kWritersDomain = 1001;
constexpr std::uint32_t kReadersDomain = 1002;
constexpr std::chrono::milliseconds kPoll{1};

/// Whether a sample of that source has come.
bool has_come(dds_entity_t reader, std::string const& source) {
  void* sample = nullptr;
  dds_sample_info_t info{};
  bool found = false;
  dds_return_t const count = dds_take(reader, &sample, &info, 1, 1);
  if (count > 0) {
    found = info.valid_data && source == static_cast<credo_msg_Segmentation*>(sample)->source;
    dds_return_loan(reader, &sample, count);
  }
  return found;
}

template <typename Done>
bool wait_until(Clock::time_point end, Done const& done) {
  while (!done()) {
    if (Clock::now() >= end) {
      return false;
    }
    std::this_thread::sleep_for(kPoll);
  }
  return true;
}

}  // namespace

std::optional<std::chrono::nanoseconds> delivery_time(DdsConfig const& config, std::size_t bytes,
                                                      std::chrono::milliseconds most) {
  auto const end = Clock::now() + most;
  Participant const from(config, kWritersDomain);
  Participant const to(config, kReadersDomain);
  DdsEntity const writer = writer_of(from, kTopic, credo_msg_Segmentation_desc, last_state_qos());
  DdsEntity const reader = reader_of(to, kTopic, credo_msg_Segmentation_desc, last_state_qos());
  if (!wait_until(end, [&] { return has_readers(writer); })) {
    return std::nullopt;
  }
  // Another's, on the same topic at the same time, is not ours.
  std::string source = from.source() + "-doctor";
  std::vector<std::uint16_t> labels(bytes / sizeof(std::uint16_t));
  credo_msg_Segmentation sample{};
  sample.source = source.data();
  sample.labels = lent<decltype(sample.labels)>(labels);
  auto const written = Clock::now();
  write_now(writer, sample);
  if (!wait_until(end, [&] { return has_come(reader.handle(), source); })) {
    return std::nullopt;
  }
  return Clock::now() - written;
}

}  // namespace credo
