#include "io/run_folder.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "io/image.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;

void write_file(fs::path const& path, std::string const& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) {
    throw InputError(path.string() + ": cannot be written: is the disk full, or the folder gone?");
  }
}

void create_folder(fs::path const& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder)) {
    throw InputError("--out " + folder.string() + ": cannot be created" +
                     (error ? ": " + error.message() : ": a file is in the way"));
  }
}

/// NNNNNN.png: six digits or more, as image_path makes them.
bool is_image_name(std::string const& name) {
  std::string const ending = ".png";
  return name.size() >= 6 + ending.size() && name.ends_with(ending) &&
         name.find_first_not_of("0123456789") == name.size() - ending.size();
}

/// A folder of NNNNNN.png files of ours: stale ones of an earlier run would be taken for this
/// one's.
void fresh_image_folder(fs::path const& folder, bool wanted) {
  std::error_code error;
  std::vector<fs::path> stale;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (is_image_name(entry->path().filename().string())) {
      stale.push_back(entry->path());
    }
  }
  for (fs::path const& path : stale) {
    if (!fs::remove(path, error)) {
      throw InputError(path.string() +
                       ": an earlier run's image cannot be removed: " + error.message());
    }
  }
  if (!wanted && fs::is_directory(folder, error) && fs::is_empty(folder, error)) {
    fs::remove(folder, error);
  }
  if (wanted) {
    create_folder(folder);
  }
}

fs::path image_path(fs::path const& folder, FrameIndex frame) {
  constexpr std::size_t kDigits = 6;
  std::string const digits = std::to_string(number(frame));
  std::string const zeros(kDigits - std::min(kDigits, digits.size()), '0');
  return folder / (zeros + digits + ".png");
}

}  // namespace

RunFolder::RunFolder(fs::path folder, bool with_labels, bool with_pictures,
                     std::string const& config_yaml)
    : folder_(std::move(folder)) {
  create_folder(folder_);
  fresh_image_folder(folder_ / "labels", with_labels);
  fresh_image_folder(folder_ / "pictures", with_pictures);
  std::error_code ignored;
  fs::remove(folder_ / "metrics.json", ignored);
  write_file(folder_ / "config.yaml", config_yaml);
  beliefs_.open(folder_ / "belief.jsonl", std::ios::binary | std::ios::trunc);
  if (!beliefs_) {
    throw InputError((folder_ / "belief.jsonl").string() + ": cannot be written");
  }
}

void RunFolder::write_belief(std::string const& json_line) {
  beliefs_ << json_line << '\n' << std::flush;
  if (!beliefs_) {
    throw InputError((folder_ / "belief.jsonl").string() +
                     ": cannot be written: is the disk full?");
  }
}

void RunFolder::write_labels(FrameIndex frame, EncodedPng const& labels) const {
  write_bytes(image_path(folder_ / "labels", frame), labels);
}

void RunFolder::write_picture(FrameIndex frame, EncodedPng const& picture) const {
  write_bytes(image_path(folder_ / "pictures", frame), picture);
}

void RunFolder::write_metrics(RunMetrics const& metrics) const {
  fs::path const temporary = folder_ / "metrics.json.part";
  write_file(temporary, metrics_json(metrics));
  std::error_code error;
  fs::rename(temporary, folder_ / "metrics.json", error);
  if (error) {
    throw InputError((folder_ / "metrics.json").string() +
                     ": cannot be written: " + error.message());
  }
}

}  // namespace credo
