#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/frame.hpp"
#include "core/grid.hpp"

namespace credo {

/// An image that a sensor gave while it was recorded, by the sensor's own clock.
template <typename T>
struct StampedImage {
  std::uint64_t stamp_us = 0;
  Grid<T> image;
};

/// The first few of each stream. Not mirrored.
struct FirstImages {
  std::vector<StampedImage<std::uint16_t>> depth;
  std::vector<StampedImage<Rgb>> color;
};

/// OpenNI2's recorder counts the time of each stream from that stream's own first image, so that a
/// colour image may stand beside the depth of another moment. Finds, by their pixels, images that
/// the sensor gave among the recording's first ones, and sets the later stream's stamps right in
/// the file. Returns by how much [us]: above 0 colour's, below 0 depth's; none where no image of a
/// stream is found again, and the stamps stay. Throws InputError where the file cannot be changed.
std::optional<std::int64_t> align_oni(std::filesystem::path const& path, FirstImages const& seen);

}  // namespace credo
