#include "io/image.hpp"

#include <spng.h>
#include <turbojpeg.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <vector>

namespace credo {
namespace {

using Bytes = std::vector<unsigned char>;

// A header may claim any size; no depth camera makes larger images than this.
constexpr int kMaxSidePx = 8192;

struct ContextDeleter {
  void operator()(spng_ctx* context) const { spng_ctx_free(context); }
};
using Context = std::unique_ptr<spng_ctx, ContextDeleter>;

struct JpegDeleter {
  void operator()(void* handle) const { tjDestroy(handle); }
};

[[noreturn]] void fail(ImageFault fault, std::filesystem::path const& path,
                       std::string const& what) {
  throw ImageError(fault, path.string() + ": " + what);
}

bool is_png(Bytes const& bytes) {
  return bytes.size() >= 4 && bytes[0] == 0x89 && bytes[1] == 'P' && bytes[2] == 'N' &&
         bytes[3] == 'G';
}

bool is_jpeg(Bytes const& bytes) {
  return bytes.size() >= 3 && bytes[0] == 0xFF && bytes[1] == 0xD8 && bytes[2] == 0xFF;
}

/// libspng tells a cut file by one of these.
bool means_truncated(int error) {
  return error == SPNG_EOF || error == SPNG_IO_EOF;
}

void check_png(int error, std::filesystem::path const& path) {
  if (error != 0) {
    fail(means_truncated(error) ? ImageFault::kTruncated : ImageFault::kUnreadable, path,
         means_truncated(error) ? std::string("cut short")
                                : std::string("damaged PNG: ") + spng_strerror(error));
  }
}

/// Opens a PNG and reads its header. `bytes` must outlive the context.
Context open_png(Bytes const& bytes, std::filesystem::path const& path, spng_ihdr& header) {
  if (!is_png(bytes)) {
    fail(ImageFault::kUnreadable, path, "not a PNG");
  }
  Context context(spng_ctx_new(0));
  check_png(spng_set_image_limits(context.get(), kMaxSidePx, kMaxSidePx), path);
  check_png(spng_set_png_buffer(context.get(), bytes.data(), bytes.size()), path);
  check_png(spng_get_ihdr(context.get(), &header), path);
  return context;
}

/// Decodes all pixels, then reads on to the end: a file may hold every pixel and still be cut.
void decode_png(Context const& context, void* pixels, std::size_t size, spng_format format,
                std::filesystem::path const& path) {
  check_png(spng_decode_image(context.get(), pixels, size, format, 0), path);
  check_png(spng_decode_chunks(context.get()), path);
}

Grid<Rgb> read_png_rgb(Bytes const& bytes, std::filesystem::path const& path) {
  spng_ihdr header{};
  Context const context = open_png(bytes, path, header);
  if (header.bit_depth > 8) {
    fail(ImageFault::kUnreadable, path,
         "not an 8-bit colour or grey PNG (" + std::to_string(header.bit_depth) + " bits)");
  }
  Grid<Rgb> image(static_cast<int>(header.width), static_cast<int>(header.height));
  decode_png(context, image.data(), image.size() * sizeof(Rgb), SPNG_FMT_RGB8, path);
  return image;
}

/// Every JPEG ends with this marker; the decoder makes one up where it is missing.
bool has_end_of_jpeg(Bytes const& bytes) {
  return bytes[bytes.size() - 2] == 0xFF && bytes[bytes.size() - 1] == 0xD9;
}

/// A cut JPEG is only a warning to the decoder, which fills the rest with grey: here it is an
/// error.
[[noreturn]] void fail_jpeg(tjhandle handle, Bytes const& bytes,
                            std::filesystem::path const& path) {
  std::string const text = tjGetErrorStr2(handle);
  bool const cut = !has_end_of_jpeg(bytes) || text.find("remature end") != std::string::npos;
  fail(cut ? ImageFault::kTruncated : ImageFault::kUnreadable, path,
       cut ? "cut short" : "damaged JPEG: " + text);
}

Grid<Rgb> read_jpeg(Bytes const& bytes, std::filesystem::path const& path) {
  std::unique_ptr<void, JpegDeleter> const handle(tjInitDecompress());
  int width = 0;
  int height = 0;
  int subsampling = 0;
  int colorspace = 0;
  if (tjDecompressHeader3(handle.get(), bytes.data(), bytes.size(), &width, &height, &subsampling,
                          &colorspace) != 0) {
    fail_jpeg(handle.get(), bytes, path);
  }
  if (width < 1 || height < 1) {
    // A file that ends before its picture begins passes for one of tables only.
    fail(ImageFault::kTruncated, path, "cut short");
  }
  if (width > kMaxSidePx || height > kMaxSidePx) {
    fail(ImageFault::kUnreadable, path,
         "claims " + std::to_string(width) + "x" + std::to_string(height) + " pixels");
  }
  Grid<Rgb> image(width, height);
  if (tjDecompress2(handle.get(), bytes.data(), bytes.size(),
                    reinterpret_cast<unsigned char*>(image.data()), width, 0, height, TJPF_RGB,
                    0) != 0) {
    fail_jpeg(handle.get(), bytes, path);
  }
  return image;
}

/// `filter` is one for all rows: libspng would try all five on each, which takes ten times as long
/// as compressing it.
EncodedPng encode(void const* data, std::size_t length, spng_ihdr header,
                  spng_filter_choice filter) {
  Context const context(spng_ctx_new(SPNG_CTX_ENCODER));
  spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1);
  spng_set_option(context.get(), SPNG_IMG_COMPRESSION_LEVEL, 2);
  spng_set_option(context.get(), SPNG_FILTER_CHOICE, filter);
  spng_set_ihdr(context.get(), &header);
  int error = spng_encode_image(context.get(), data, length, SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE);
  std::size_t size = 0;
  std::unique_ptr<void, void (*)(void*)> const png(
      error == 0 ? spng_get_png_buffer(context.get(), &size, &error) : nullptr, std::free);
  if (error != 0 || png == nullptr) {
    // Only an empty image gets here.
    throw std::logic_error(std::string("PNG cannot be encoded: ") + spng_strerror(error));
  }
  auto const* begin = static_cast<unsigned char const*>(png.get());
  return {begin, begin + size};
}

spng_ihdr header_of(int width, int height, std::uint8_t bits, std::uint8_t color_type) {
  spng_ihdr header{};
  header.width = static_cast<std::uint32_t>(width);
  header.height = static_cast<std::uint32_t>(height);
  header.bit_depth = bits;
  header.color_type = color_type;
  return header;
}

}  // namespace

Bytes read_bytes(std::filesystem::path const& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    fail(ImageFault::kMissing, path, "no such file");
  }
  auto const size = std::filesystem::file_size(path, error);
  if (error) {
    fail(ImageFault::kUnreadable, path, "cannot be read: " + error.message());
  }
  if (size == 0) {
    fail(ImageFault::kTruncated, path, "empty file");
  }
  Bytes bytes(size);
  std::ifstream file(path, std::ios::binary);
  if (!file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size))) {
    fail(ImageFault::kUnreadable, path, "cannot be read");
  }
  return bytes;
}

Grid<std::uint16_t> decode_png16(Bytes const& bytes, std::filesystem::path const& path) {
  spng_ihdr header{};
  Context const context = open_png(bytes, path, header);
  if (header.bit_depth != 16 || header.color_type != SPNG_COLOR_TYPE_GRAYSCALE) {
    fail(ImageFault::kUnreadable, path,
         "not a 16-bit grey PNG (" + std::to_string(header.bit_depth) + " bits, colour type " +
             std::to_string(header.color_type) + ")");
  }
  Grid<std::uint16_t> image(static_cast<int>(header.width), static_cast<int>(header.height));
  // SPNG_FMT_PNG is the stored format in host byte order.
  decode_png(context, image.data(), image.size() * sizeof(std::uint16_t), SPNG_FMT_PNG, path);
  return image;
}

Grid<std::uint16_t> read_png16(std::filesystem::path const& path) {
  return decode_png16(read_bytes(path), path);
}

Grid<Rgb> decode_color(Bytes const& bytes, std::filesystem::path const& name) {
  if (is_png(bytes)) {
    return read_png_rgb(bytes, name);
  }
  if (is_jpeg(bytes)) {
    return read_jpeg(bytes, name);
  }
  fail(ImageFault::kUnreadable, name, "neither PNG nor JPEG");
}

Grid<Rgb> read_color(std::filesystem::path const& path) {
  return decode_color(read_bytes(path), path);
}

EncodedPng encode_png16(Grid<std::uint16_t> const& image) {
  return encode(image.data(), image.size() * sizeof(std::uint16_t),
                header_of(image.width(), image.height(), 16, SPNG_COLOR_TYPE_GRAYSCALE),
                SPNG_FILTER_CHOICE_NONE);
}

EncodedPng encode_png_rgb(Grid<Rgb> const& image) {
  return encode(image.data(), image.size() * sizeof(Rgb),
                header_of(image.width(), image.height(), 8, SPNG_COLOR_TYPE_TRUECOLOR),
                SPNG_FILTER_CHOICE_SUB);
}

void write_bytes(std::filesystem::path const& path, EncodedPng const& bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<char const*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) {
    throw InputError(path.string() + ": cannot be written: is the disk full, or the folder gone?");
  }
}

void write_png16(std::filesystem::path const& path, Grid<std::uint16_t> const& image) {
  write_bytes(path, encode_png16(image));
}

void write_png_rgb(std::filesystem::path const& path, Grid<Rgb> const& image) {
  write_bytes(path, encode_png_rgb(image));
}

}  // namespace credo
