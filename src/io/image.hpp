#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/frame.hpp"
#include "core/grid.hpp"

namespace credo {

/// What is wrong with an image, for counters.
enum class ImageFault : std::uint8_t { kMissing, kUnreadable, kTruncated };

/// An image file that cannot be used; the text names the file and the fault.
class ImageError : public InputError {
public:
  ImageError(ImageFault fault, std::string const& message) : InputError(message), fault_(fault) {}
  [[nodiscard]] ImageFault fault() const { return fault_; }

private:
  ImageFault fault_;
};

/// All of a file. Throws ImageError where it is not there, empty, or cannot be read.
std::vector<unsigned char> read_bytes(std::filesystem::path const& path);

/// A 16-bit grey PNG, counts as stored. Anything else throws ImageError: a depth image saved with 8
/// bits has lost its depth.
Grid<std::uint16_t> read_png16(std::filesystem::path const& path);
/// The same from memory; `name` is for what is thrown.
Grid<std::uint16_t> decode_png16(std::vector<unsigned char> const& bytes,
                                 std::filesystem::path const& name);

/// An 8-bit colour or grey image, PNG or JPEG by content. Cut files throw ImageError, also where
/// the decoder would fill the rest with grey.
Grid<Rgb> read_color(std::filesystem::path const& path);
/// The same from memory; `name` is for what is thrown.
Grid<Rgb> decode_color(std::vector<unsigned char> const& bytes, std::filesystem::path const& name);

/// A PNG file in memory. Compressed lightly: these are made at frame rate.
using EncodedPng = std::vector<unsigned char>;
EncodedPng encode_png16(Grid<std::uint16_t> const& image);
EncodedPng encode_png_rgb(Grid<Rgb> const& image);

/// Throw InputError where the file cannot be written.
void write_bytes(std::filesystem::path const& path, EncodedPng const& bytes);
void write_png16(std::filesystem::path const& path, Grid<std::uint16_t> const& image);
void write_png_rgb(std::filesystem::path const& path, Grid<Rgb> const& image);

}  // namespace credo
