#include "io/dataset_listing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/frame.hpp"
#include "io/recording_file.hpp"
#include "io/trajectory.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;

constexpr double kTumDepthUnitM = 1.0 / 5000.0;
constexpr std::int64_t kMaxStampGapNs = 20'000'000;
constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

std::int64_t stamp_of_frame(std::size_t index) {
  return static_cast<std::int64_t>(index) * 1'000'000'000 / 30;
}

/// Numbered files of either layout; the expression captures number and kind.
DatasetListing list_numbered(std::vector<fs::path> const& files, std::regex const& pattern) {
  std::map<std::uint64_t, DatasetEntry> entries;
  bool has_poses = false;
  for (fs::path const& file : files) {
    std::smatch match;
    std::string const name = file.filename().string();
    if (!std::regex_match(name, match, pattern)) {
      continue;
    }
    std::uint64_t const number = std::stoull(match[1]);
    std::string const kind = match[2];
    DatasetEntry& entry = entries[number];
    if (kind == "depth.png") {
      entry.depth = file;
    } else if (kind == "pose.txt") {
      entry.pose_file = file;
      has_poses = true;
    } else {
      entry.color = file;
    }
  }
  DatasetListing listing;
  listing.has_poses = has_poses;
  for (auto& [number, entry] : entries) {
    if (!entry.depth.empty() || !entry.color.empty()) {
      entry.stamp_ns = stamp_of_frame(listing.entries.size());
      listing.entries.push_back(std::move(entry));
    }
  }
  return listing;
}

DatasetListing list_clouds(std::vector<fs::path> const& files) {
  DatasetListing listing;
  for (fs::path const& file : files) {
    if (file.extension() == ".pcd") {
      DatasetEntry entry;
      entry.cloud = file;
      entry.stamp_ns = stamp_of_frame(listing.entries.size());
      listing.entries.push_back(std::move(entry));
    }
  }
  return listing;
}

struct StampedFile {
  std::int64_t stamp_ns;
  fs::path path;
};

[[noreturn]] void fail_at(fs::path const& path, int line, std::string const& what) {
  throw InputError(path.string() + ":" + std::to_string(line) + ": " + what);
}

/// A TUM list: `stamp_s file` lines, in order of time.
std::vector<StampedFile> read_tum_list(fs::path const& path, LastLine last) {
  std::ifstream file(path);
  if (!file) {
    throw InputError(path.string() + ": cannot be read");
  }
  std::vector<StampedFile> list;
  int line_number = 0;
  for (std::string line; std::getline(file, line);) {
    ++line_number;
    if (last == LastLine::kDropTorn && file.eof()) {
      break;
    }
    std::istringstream words(line.substr(0, line.find('#')));
    if ((words >> std::ws).eof()) {
      continue;
    }
    std::string stamp;
    std::string name;
    words >> stamp >> name;
    std::optional<std::int64_t> const stamp_ns = stamp_from_text(stamp);
    if (!words || !stamp_ns) {
      fail_at(path, line_number, "needs a stamp in seconds and a file name");
    }
    if (!list.empty() && *stamp_ns < list.back().stamp_ns) {
      fail_at(path, line_number, "stamp falls");
    }
    list.push_back({*stamp_ns, path.parent_path() / name});
  }
  return list;
}

/// The file nearest in time, the earlier of two that are equally near; empty where none is near.
fs::path nearest_file(std::vector<StampedFile> const& list, std::int64_t stamp_ns,
                      std::int64_t most_gap_ns) {
  auto const after = std::lower_bound(
      list.begin(), list.end(), stamp_ns,
      [](StampedFile const& file, std::int64_t stamp) { return file.stamp_ns < stamp; });
  std::int64_t const until = after == list.end() ? kNever : after->stamp_ns - stamp_ns;
  std::int64_t const since = after == list.begin() ? kNever : stamp_ns - std::prev(after)->stamp_ns;
  if (std::min(since, until) > most_gap_ns) {
    return {};
  }
  return since <= until ? std::prev(after)->path : after->path;
}

/// Drops the depth images before the first that has all a frame needs, if there is one.
void drop_early_start(DatasetListing& listing, fs::path const& folder) {
  auto const first = std::find_if(
      listing.entries.begin(), listing.entries.end(), [&listing](DatasetEntry const& entry) {
        return !entry.color.empty() && (entry.pose.has_value() || !listing.has_poses);
      });
  auto const early = first - listing.entries.begin();
  if (early > 0 && first != listing.entries.end()) {
    listing.warnings.push_back(folder.string() + ": passing over the first " +
                               std::to_string(early) +
                               " depth images, which have no colour or no pose");
    listing.entries.erase(listing.entries.begin(), first);
  }
}

DatasetListing list_tum(fs::path const& folder, Checksums const& sums) {
  std::optional<RecordingInfo> const recording = read_recording_info(folder);
  bool const cut = recording && !sums.lists(folder / "depth.txt");
  LastLine const last = cut ? LastLine::kDropTorn : LastLine::kKeep;
  std::vector<StampedFile> const depth = read_tum_list(folder / "depth.txt", last);
  std::vector<StampedFile> const color = read_tum_list(folder / "rgb.txt", last);
  std::optional<Trajectory> trajectory;
  if (fs::exists(folder / "groundtruth.txt")) {
    trajectory.emplace(folder / "groundtruth.txt", last);
  }
  DatasetListing listing;
  listing.depth_unit_m = recording ? recording->depth_unit_m : kTumDepthUnitM;
  listing.color_registered = !recording || recording->color_registered;
  listing.color_may_lack = recording.has_value();
  listing.has_poses = trajectory.has_value();
  for (StampedFile const& image : depth) {
    DatasetEntry entry;
    entry.stamp_ns = image.stamp_ns;
    entry.depth = image.path;
    entry.color = nearest_file(color, image.stamp_ns, recording ? 0 : kMaxStampGapNs);
    if (trajectory) {
      FrameIndex const index{static_cast<std::int64_t>(listing.entries.size())};
      entry.pose = trajectory->at(index, image.stamp_ns);
    }
    listing.entries.push_back(std::move(entry));
  }
  if (!recording) {
    drop_early_start(listing, folder);
  }
  if (cut) {
    listing.warnings.push_back(
        folder.string() + ": the recording was cut short, or not closed; what is whole is read");
  }
  return listing;
}

/// Those that are there, and those that should be.
std::vector<fs::path> files_in(fs::path const& folder, Checksums const& sums) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    throw InputError("dataset " + folder.string() +
                     (fs::exists(folder, error) ? ": not a folder" : ": no such folder"));
  }
  std::vector<fs::path> files;
  try {
    for (auto const& entry : fs::directory_iterator(folder)) {
      files.push_back(entry.path());
    }
  } catch (fs::filesystem_error const& failure) {
    throw InputError("dataset " + folder.string() +
                     ": cannot be read: " + failure.code().message());
  }
  for (auto const& [file, sum] : sums.all()) {
    if (file.parent_path() == folder.lexically_normal() && !fs::exists(file)) {
      files.push_back(folder / file.filename());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

DatasetListing list_dataset(fs::path const& folder, Checksums const& sums) {
  std::vector<fs::path> const files = files_in(folder, sums);
  if (fs::exists(folder / "depth.txt") && fs::exists(folder / "rgb.txt")) {
    DatasetListing listing = list_tum(folder, sums);
    if (!listing.entries.empty()) {
      return listing;
    }
  }
  static std::array<std::regex, 2> const numbered = {
      std::regex(R"(frame-(\d{1,18})\.(depth\.png|color\.jpg|color\.png|pose\.txt))"),
      std::regex(R"((\d{1,18})\.(depth\.png|color\.png|color\.jpg))")};
  for (std::regex const& pattern : numbered) {
    DatasetListing listing = list_numbered(files, pattern);
    if (!listing.entries.empty()) {
      return listing;
    }
  }
  DatasetListing listing = list_clouds(files);
  listing.color_registered = true;  // it comes with the points
  if (listing.entries.empty()) {
    throw InputError("dataset " + folder.string() +
                     ": no frames found; known are frame-NNNNNN.depth.png with .color.jpg|png, "
                     "NNNN.depth.png with .color.png, TUM depth.txt with rgb.txt, and *.pcd");
  }
  return listing;
}

}  // namespace credo
