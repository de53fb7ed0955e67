#include "io/dataset_listing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>

#include "core/error.hpp"
#include "core/frame.hpp"
#include "io/trajectory.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;

constexpr double kTumDepthUnitM = 1.0 / 5000.0;
constexpr std::int64_t kMaxStampGapNs = 20'000'000;

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

/// A TUM list: `stamp_s file` lines.
std::vector<StampedFile> read_tum_list(fs::path const& path) {
  std::ifstream file(path);
  if (!file) {
    throw InputError(path.string() + ": cannot be read");
  }
  std::vector<StampedFile> list;
  int line_number = 0;
  for (std::string line; std::getline(file, line);) {
    ++line_number;
    std::istringstream words(line.substr(0, line.find('#')));
    double stamp_s = 0;
    std::string name;
    if (!(words >> std::ws) || words.eof()) {
      continue;
    }
    if (!(words >> stamp_s >> name) || !std::isfinite(stamp_s)) {
      throw InputError(path.string() + ":" + std::to_string(line_number) +
                       ": needs a stamp in seconds and a file name");
    }
    list.push_back(
        {static_cast<std::int64_t>(std::llround(stamp_s * 1e9)), path.parent_path() / name});
    if (list.size() > 1 && list.back().stamp_ns < list[list.size() - 2].stamp_ns) {
      throw InputError(path.string() + ":" + std::to_string(line_number) + ": stamp falls");
    }
  }
  return list;
}

DatasetListing list_tum(fs::path const& folder) {
  std::vector<StampedFile> const depth = read_tum_list(folder / "depth.txt");
  std::vector<StampedFile> const color = read_tum_list(folder / "rgb.txt");
  std::optional<Trajectory> trajectory;
  if (fs::exists(folder / "groundtruth.txt")) {
    trajectory.emplace(folder / "groundtruth.txt");
  }
  DatasetListing listing;
  listing.depth_unit_m = kTumDepthUnitM;
  listing.has_poses = trajectory.has_value();
  for (StampedFile const& d : depth) {
    DatasetEntry entry;
    entry.stamp_ns = d.stamp_ns;
    entry.depth = d.path;
    auto const nearest = std::min_element(
        color.begin(), color.end(), [&d](StampedFile const& a, StampedFile const& b) {
          return std::abs(a.stamp_ns - d.stamp_ns) < std::abs(b.stamp_ns - d.stamp_ns);
        });
    if (nearest != color.end() && std::abs(nearest->stamp_ns - d.stamp_ns) <= kMaxStampGapNs) {
      entry.color = nearest->path;
    }
    if (trajectory) {
      entry.pose = trajectory->at(FrameIndex{0}, d.stamp_ns);
    }
    listing.entries.push_back(std::move(entry));
  }
  return listing;
}

std::vector<fs::path> files_in(fs::path const& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    throw InputError("dataset " + folder.string() + ": no such folder");
  }
  std::vector<fs::path> files;
  for (auto const& entry : fs::directory_iterator(folder, error)) {
    files.push_back(entry.path());
  }
  if (error) {
    throw InputError("dataset " + folder.string() + ": cannot be read: " + error.message());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

DatasetListing list_dataset(fs::path const& folder) {
  std::vector<fs::path> const files = files_in(folder);
  if (fs::exists(folder / "depth.txt") && fs::exists(folder / "rgb.txt")) {
    DatasetListing listing = list_tum(folder);
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
  if (listing.entries.empty()) {
    throw InputError("dataset " + folder.string() +
                     ": no frames found; known are frame-NNNNNN.depth.png with .color.jpg|png, "
                     "NNNN.depth.png with .color.png, TUM depth.txt with rgb.txt, and *.pcd");
  }
  return listing;
}

}  // namespace credo
