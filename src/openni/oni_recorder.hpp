#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/sensor_config.hpp"
#include "openni/oni_alignment.hpp"
#include "openni/openni_sensor.hpp"

namespace credo {

/// What became of a recording, as found in its file.
struct OniTally {
  /// Depth images.
  std::int64_t frames = 0;
  /// Images that the sensor numbered and that are not in it.
  std::int64_t missed = 0;
  std::uint64_t bytes = 0;
  /// The sensor says that its depth is registered to its colour.
  bool registered = false;
  /// What people should know, a line each.
  std::vector<std::string> notes;
};

/// Records a sensor into an ONI file by OpenNI2's own recorder: depth as 16zT and colour as it
/// comes, both without loss.
class OniRecorder {
public:
  enum class Event : std::uint8_t { kNothing, kDepth, kStalled, kUnplugged };

  /// Opens the sensor and begins. Throws InputError where the file or its checksum is there
  /// already, or cannot be made, and as OpenniSensor does.
  OniRecorder(std::string const& uri, SensorConfig const& config, std::filesystem::path file);

  /// What comes next, within a tenth of a second. Only depth counts. One thread.
  Event next();
  [[nodiscard]] std::string const& uri() const { return uri_; }
  /// What the sensor does not do as asked.
  [[nodiscard]] std::vector<std::string> const& warnings() const { return sensor_->warnings(); }
  /// Depth images that came since it began.
  [[nodiscard]] std::int64_t seen() const { return seen_; }

  /// Ends the recording, sets its stamps right (align_oni), reads all of it again by open_oni, and
  /// writes its checksum. Throws InputError, and leaves the recording as it is, without a checksum,
  /// where it does not hold as many depth images as came, or one that does not read. Of a recording
  /// without any image nothing is left.
  OniTally finish();

private:
  void take(SensorImage image);
  void read_again(OniTally& tally) const;

  SensorConfig config_;
  std::filesystem::path file_;
  OpenniLibrary library_;
  std::optional<OpenniSensor> sensor_;
  std::string uri_;
  FirstImages first_;
  std::int64_t seen_ = 0;
  std::int64_t first_number_ = 0;
  std::int64_t last_number_ = 0;
  std::chrono::steady_clock::time_point quiet_until_;
};

}  // namespace credo
