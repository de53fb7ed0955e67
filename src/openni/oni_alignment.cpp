#include "openni/oni_alignment.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "core/error.hpp"
#include "openni/oni_codec.hpp"
#include "openni/oni_records.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<unsigned char>;

/// Of a stream's images: one that was seen is among them, or was seen before it was recorded.
constexpr std::size_t kSearched = 10;
/// A stamp lies so many bytes before its image: 8 of its own, 4 of the image's number.
constexpr std::uint64_t kStampBeforeImage = 12;

Bytes read(std::fstream& file, std::uint64_t offset, std::size_t size) {
  Bytes bytes(size);
  file.seekg(static_cast<std::streamoff>(offset));
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  return bytes;
}

template <typename T>
bool holds(Bytes const& bytes, Grid<T> const& image, bool mirrored) {
  if (bytes.size() != image.size() * sizeof(T)) {
    return false;
  }
  std::vector<T> row(static_cast<std::size_t>(image.width()));
  for (int v = 0; v < image.height(); ++v) {
    std::memcpy(row.data(), bytes.data() + static_cast<std::size_t>(v) * row.size() * sizeof(T),
                row.size() * sizeof(T));
    if (mirrored) {
      std::ranges::reverse(row);
    }
    if (!std::ranges::equal(row, image.row(v))) {
      return false;
    }
  }
  return true;
}

/// Its pixels as they lie in memory; empty where they do not come out.
Bytes unpacked(Bytes packed, OniStream const& stream) {
  if (stream.codec == "NONE") {
    return packed;
  }
  auto const size =
      static_cast<std::size_t>(stream.width) * static_cast<std::size_t>(stream.height);
  auto const counts = stream.codec == "16zT" ? unpack_16z_with_table(packed, size) : std::nullopt;
  if (!counts) {
    return {};
  }
  Bytes bytes(counts->size() * sizeof(std::uint16_t));
  std::memcpy(bytes.data(), counts->data(), bytes.size());
  return bytes;
}

/// The sensor's time where the stream's own begins [us].
template <typename T>
std::optional<std::int64_t> origin_us(std::fstream& file, OniStream const& stream,
                                      std::vector<StampedImage<T>> const& seen) {
  for (StampedImage<T> const& one : seen) {
    for (std::size_t i = 0; i < std::min(kSearched, stream.images.size()); ++i) {
      OniImage const& image = stream.images[i];
      Bytes const bytes = unpacked(read(file, image.offset_bytes, image.size_bytes), stream);
      if (holds(bytes, one.image, stream.mirrored)) {
        return static_cast<std::int64_t>(one.stamp_us) - image.stamp_ns / 1000;
      }
    }
  }
  return std::nullopt;
}

void delay(std::fstream& file, OniStream const& stream, std::int64_t by_us) {
  for (OniImage const& image : stream.images) {
    std::int64_t const stamp_us = image.stamp_ns / 1000 + by_us;
    file.seekp(static_cast<std::streamoff>(image.offset_bytes - kStampBeforeImage));
    file.write(reinterpret_cast<char const*>(&stamp_us), sizeof stamp_us);
  }
}

}  // namespace

std::optional<std::int64_t> align_oni(fs::path const& path, FirstImages const& seen) {
  OniIndex const index = index_oni(path);
  if (!index.color) {
    return std::nullopt;
  }
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  auto const depth_us = origin_us(file, index.depth, seen.depth);
  auto const color_us = origin_us(file, *index.color, seen.color);
  if (!depth_us || !color_us) {
    return std::nullopt;
  }
  std::int64_t const by_us = *color_us - *depth_us;
  if (by_us != 0) {
    delay(file, by_us > 0 ? *index.color : index.depth, std::abs(by_us));
  }
  file.close();
  if (!file) {
    throw InputError(path.string() + ": its stamps cannot be set right");
  }
  return by_us;
}

}  // namespace credo
