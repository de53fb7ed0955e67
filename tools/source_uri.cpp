#include "source_uri.hpp"

#include <cstddef>
#include <memory>
#include <utility>

#include "core/error.hpp"
#include "openni/oni_source.hpp"
#include "scene_file.hpp"
#include "sim/sim_source.hpp"

namespace credo {
namespace {

OpenedSource open_sim(std::string const& name_or_file, PoseConfig const& pose,
                      SimConfig const& sim) {
  auto source = std::make_unique<SimSource>(load_scene(name_or_file), pose, sim);
  std::size_t const frame_count = source->frame_count();
  return {std::move(source), {}, frame_count};
}

}  // namespace

OpenedSource open_source(std::string const& uri, CaptureConfig const& capture,
                         PoseConfig const& pose, SensorConfig const& sensor, SimConfig const& sim,
                         LiveNotes const& notes, std::stop_token const& stop) {
  std::size_t const colon = uri.find(':');
  std::string const scheme = colon == std::string::npos ? "" : uri.substr(0, colon);
  std::string const rest = colon == std::string::npos ? "" : uri.substr(colon + 1);
  if (scheme == "openni") {
    return open_openni(rest, capture, pose, sensor, notes, stop);
  }
  if (!rest.empty() && scheme == "dataset") {
    return open_dataset(rest, capture, pose);
  }
  if (!rest.empty() && scheme == "oni") {
    return open_oni(rest, capture, pose);
  }
  if (!rest.empty() && scheme == "sim") {
    return open_sim(rest, pose, sim);
  }
  throw InputError("--source " + uri +
                   ": names no source; write dataset:DIR, oni:FILE, openni: or sim:NAME-or-FILE");
}

}  // namespace credo
