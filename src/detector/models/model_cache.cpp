#include "detector/models/model_cache.hpp"

#include <unistd.h>

#include <atomic>
#include <cstddef>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "detector/models/model_archive.hpp"
#include "geometry/shapes/model_mesh.hpp"
#include "io/sha256.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;

using Bytes = std::vector<unsigned char>;

template <typename T>
void append(std::string& text, std::vector<T> const& values) {
  text.append(reinterpret_cast<char const*>(values.data()), values.size() * sizeof(T));
}

/// What a file begins with, so that neither another's nor a damaged one passes.
std::string first_line(std::string const& key, std::span<unsigned char const> archive) {
  return "credo model " + key + " " + sha256_of(archive) + "\n";
}

std::optional<PreparedModel> kept_at(fs::path const& path, std::string const& key) {
  std::error_code error;
  std::size_t const size = fs::file_size(path, error);  // of a folder an error
  std::size_t const head = first_line(key, {}).size();
  if (error || size < head) {
    return std::nullopt;
  }
  Bytes bytes(size);
  std::ifstream file(path, std::ios::binary);
  if (!file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size))) {
    return std::nullopt;
  }
  std::span const all(bytes);
  std::string const line(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(head));
  if (line != first_line(key, all.subspan(head))) {
    return std::nullopt;
  }
  return unarchived(all.subspan(head));
}

/// Written beside and renamed. That it cannot be is no fault: the next run prepares it again.
void keep_at(fs::path const& path, std::string const& key, PreparedModel const& model) {
  static std::atomic<int> count = 0;  // threads of one process write files of their own
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  fs::path const beside =
      path.string() + "." + std::to_string(::getpid()) + "." + std::to_string(count++) + ".part";
  Bytes const archive = archived(model);
  bool written = false;
  {
    std::ofstream file(beside, std::ios::binary);
    file << first_line(key, archive);
    file.write(reinterpret_cast<char const*>(archive.data()),
               static_cast<std::streamsize>(archive.size()));
    file.close();
    written = !file.fail();
  }
  if (written) {
    fs::rename(beside, path, error);
  }
  if (!written || error) {
    fs::remove(beside, error);
  }
}

}  // namespace

std::string cache_key(ObjectModel const& model) {
  TriangleMesh const mesh = mesh_of(model);
  // With the count: else a corner more and a triangle less could be the same bytes.
  std::string text = "preparation " + std::to_string(kPreparationVersion) + ", one-sided " +
                     std::to_string(static_cast<int>(model.one_sided)) + ", vertices " +
                     std::to_string(mesh.vertices.size()) + "\n";
  append(text, mesh.vertices);
  append(text, mesh.triangles);
  return sha256_of({reinterpret_cast<unsigned char const*>(text.data()), text.size()});
}

std::shared_ptr<PreparedModel const> kept_or_prepared(ObjectModel const& model,
                                                      fs::path const& folder) {
  if (folder.empty()) {
    return std::make_shared<PreparedModel const>(prepared(model));
  }
  std::string const key = cache_key(model);
  fs::path const path = folder / (key + ".model");
  if (std::optional<PreparedModel> kept = kept_at(path, key)) {
    kept->model.name = model.name;
    kept->model.symmetry = model.symmetry;
    return std::make_shared<PreparedModel const>(*std::move(kept));
  }
  auto made = std::make_shared<PreparedModel const>(prepared(model));
  keep_at(path, key, *made);
  return made;
}

}  // namespace credo
