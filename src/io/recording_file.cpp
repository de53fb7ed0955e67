#include "io/recording_file.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "io/json_value.hpp"

namespace credo {

namespace fs = std::filesystem;

std::optional<RecordingInfo> read_recording_info(fs::path const& folder) {
  fs::path const path = folder / kRecordingFile;
  if (!fs::exists(path)) {
    return std::nullopt;
  }
  RecordingInfo info;
  read_json_file(path, "recording", [&](JsonValue const& value) {
    value.must_be_object({"depth_unit_m", "color_registered"});
    info.depth_unit_m = value.at("depth_unit_m").number();
    if (!(info.depth_unit_m > 0.0 && info.depth_unit_m <= 1.0)) {
      value.at("depth_unit_m").refuse("must be in (0, 1] m");
    }
    info.color_registered = value.at("color_registered").flag();
  });
  return info;
}

void write_recording_info(fs::path const& folder, RecordingInfo const& info) {
  nlohmann::ordered_json const json = {{"depth_unit_m", info.depth_unit_m},
                                       {"color_registered", info.color_registered}};
  fs::path const path = folder / kRecordingFile;
  fs::path const draft = path.string() + ".new";
  std::ofstream file(draft, std::ios::binary);
  file << json.dump() << '\n';
  file.close();
  std::error_code error;
  if (file) {
    fs::rename(draft, path, error);
  }
  if (!file || error) {
    fs::remove(draft, error);
    throw InputError(path.string() + ": cannot be written: is the disk full?");
  }
}

}  // namespace credo
