#include "io/image.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spng.h>
#include <turbojpeg.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>
#include <vector>

#include "support/temp_folder.hpp"

namespace credo {
namespace {

using test::TempFolder;
using test::write_text;

/// Every value of 16 bits once, so that swapped bytes or lost bits show.
Grid<std::uint16_t> all_counts() {
  Grid<std::uint16_t> image(256, 256);
  for (std::size_t i = 0; i < image.size(); ++i) {
    image[i] = static_cast<std::uint16_t>(i * 40503U);
  }
  return image;
}

Grid<Rgb> colors(int width, int height) {
  Grid<Rgb> image(width, height);
  for (std::size_t i = 0; i < image.size(); ++i) {
    image[i] = {static_cast<std::uint8_t>(i * 37), static_cast<std::uint8_t>(i * 101),
                static_cast<std::uint8_t>(i * 11)};
  }
  return image;
}

std::string text_of(EncodedPng const& bytes) {
  return {reinterpret_cast<char const*>(bytes.data()), bytes.size()};
}

/// A PNG of any kind, as other programs write them.
std::string png_of(int width, int height, std::uint8_t bits, std::uint8_t color_type,
                   std::vector<std::uint8_t> const& pixels) {
  spng_ctx* context = spng_ctx_new(SPNG_CTX_ENCODER);
  spng_set_option(context, SPNG_ENCODE_TO_BUFFER, 1);
  spng_ihdr header{};
  header.width = static_cast<std::uint32_t>(width);
  header.height = static_cast<std::uint32_t>(height);
  header.bit_depth = bits;
  header.color_type = color_type;
  spng_set_ihdr(context, &header);
  spng_plte palette{2, {{10, 20, 30, 255}, {200, 150, 100, 255}}};
  if (color_type == SPNG_COLOR_TYPE_INDEXED) {
    spng_set_plte(context, &palette);
  }
  EXPECT_EQ(
      spng_encode_image(context, pixels.data(), pixels.size(), SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE),
      0);
  std::size_t size = 0;
  int error = 0;
  void* png = spng_get_png_buffer(context, &size, &error);
  std::string const text(static_cast<char const*>(png), size);
  std::free(png);
  spng_ctx_free(context);
  return text;
}

std::string jpeg_of(Grid<Rgb> const& image) {
  tjhandle const handle = tjInitCompress();
  unsigned char* bytes = nullptr;
  unsigned long size = 0;  // NOLINT(google-runtime-int): the type of the library
  EXPECT_EQ(tjCompress2(handle, reinterpret_cast<unsigned char const*>(image.data()), image.width(),
                        0, image.height(), TJPF_RGB, &bytes, &size, TJSAMP_444, 95, 0),
            0);
  std::string const text(reinterpret_cast<char const*>(bytes), size);
  tjFree(bytes);
  tjDestroy(handle);
  return text;
}

class ImageTest : public testing::Test {
protected:
  struct Failure {
    ImageFault fault;
    std::string text;
  };
  /// What the reader says of these bytes, without the path; the path must come first.
  template <typename Read>
  std::optional<Failure> failure_of(Read read, std::string const& bytes) {
    auto const path = folder_ / "image";
    write_text(path, bytes);
    try {
      read(path);
    } catch (ImageError const& error) {
      std::string const text = error.what();
      EXPECT_EQ(text.rfind(path.string() + ": ", 0), 0U) << text;
      return Failure{error.fault(), text.substr(path.string().size() + 2)};
    }
    return std::nullopt;
  }
  void expect_color_failure(std::string const& bytes, ImageFault fault, std::string const& text) {
    auto const failure = failure_of(read_color, bytes);
    ASSERT_TRUE(failure.has_value());
    EXPECT_EQ(failure->fault, fault);
    EXPECT_EQ(failure->text, text);
  }
  void expect_depth_failure(std::string const& bytes, ImageFault fault, std::string const& text) {
    auto const failure = failure_of(read_png16, bytes);
    ASSERT_TRUE(failure.has_value());
    EXPECT_EQ(failure->fault, fault);
    EXPECT_EQ(failure->text, text);
  }
  Grid<Rgb> color_of(std::string const& bytes) {
    write_text(folder_ / "image", bytes);
    return read_color(folder_ / "image");
  }

  TempFolder folder_;
};

TEST_F(ImageTest, CountsOfSixteenBitsComeBackAsTheyWere) {
  write_png16(folder_ / "depth.png", all_counts());
  EXPECT_EQ(read_png16(folder_ / "depth.png"), all_counts());
}

TEST_F(ImageTest, CountsAreStoredWithTheHighByteFirst) {
  // 0x0102 as the PNG standard stores it; a byte swap in both reader and writer would go unseen.
  std::uint16_t const count = 0x0102;
  std::vector<std::uint8_t> host(2);
  std::memcpy(host.data(), &count, 2);
  write_text(folder_ / "image", png_of(1, 1, 16, SPNG_COLOR_TYPE_GRAYSCALE, host));
  EXPECT_EQ(read_png16(folder_ / "image"), (Grid<std::uint16_t>(1, 1, count)));
}

TEST_F(ImageTest, ColoursComeBackAsTheyWere) {
  write_png_rgb(folder_ / "color.png", colors(31, 17));
  EXPECT_EQ(read_color(folder_ / "color.png"), colors(31, 17));
}

TEST_F(ImageTest, OnePixelIsAnImage) {
  write_png16(folder_ / "depth.png", Grid<std::uint16_t>(1, 1, 65535));
  EXPECT_EQ(read_png16(folder_ / "depth.png")[0], 65535);
  EXPECT_EQ(color_of(jpeg_of(Grid<Rgb>(1, 1))).size(), 1U);
}

TEST_F(ImageTest, AnEmptyImageIsABrokenContract) {
  EXPECT_THROW(encode_png16({}), std::logic_error);
  EXPECT_THROW(encode_png_rgb({}), std::logic_error);
}

TEST_F(ImageTest, ReadsGreyAlphaAndPaletteAsColour) {
  EXPECT_EQ(color_of(png_of(2, 1, 8, SPNG_COLOR_TYPE_GRAYSCALE, {5, 250})),
            (Grid<Rgb>(2, 1, std::vector<Rgb>{{5, 5, 5}, {250, 250, 250}})));
  EXPECT_EQ(color_of(png_of(2, 1, 8, SPNG_COLOR_TYPE_TRUECOLOR_ALPHA, {1, 2, 3, 0, 4, 5, 6, 255})),
            (Grid<Rgb>(2, 1, std::vector<Rgb>{{1, 2, 3}, {4, 5, 6}})));
  EXPECT_EQ(color_of(png_of(2, 1, 8, SPNG_COLOR_TYPE_INDEXED, {1, 0})),
            (Grid<Rgb>(2, 1, std::vector<Rgb>{{200, 150, 100}, {10, 20, 30}})));
}

TEST_F(ImageTest, ReadsJpegToWithinItsLoss) {
  // A gentle ramp: what JPEG keeps well.
  Grid<Rgb> image(64, 48);
  for (std::size_t i = 0; i < image.size(); ++i) {
    auto const p = image.pixel(i);
    image[i] = {static_cast<std::uint8_t>(2 * p.u), static_cast<std::uint8_t>(3 * p.v), 80};
  }
  Grid<Rgb> const read = color_of(jpeg_of(image));
  ASSERT_TRUE(read.same_size(image));
  for (std::size_t i = 0; i < image.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(read[i][c], image[i][c], 6) << "pixel " << i << " channel " << c;
    }
  }
}

TEST_F(ImageTest, MissingFileAndFolderInItsPlace) {
  try {
    read_color(folder_ / "none.png");
    FAIL();
  } catch (ImageError const& error) {
    EXPECT_EQ(error.fault(), ImageFault::kMissing);
    EXPECT_EQ(error.what(), (folder_ / "none.png").string() + ": no such file");
  }
  try {
    read_png16(folder_.path());
    FAIL();
  } catch (ImageError const& error) {
    EXPECT_EQ(error.fault(), ImageFault::kUnreadable);
    EXPECT_EQ(error.what(), folder_.path().string() + ": cannot be read: Is a directory");
  }
}

TEST_F(ImageTest, SaysWhatIsWrong) {
  expect_color_failure("", ImageFault::kTruncated, "empty file");
  expect_color_failure("hello, world", ImageFault::kUnreadable, "neither PNG nor JPEG");
  expect_depth_failure(jpeg_of(colors(8, 8)), ImageFault::kUnreadable, "not a PNG");
  expect_depth_failure(text_of(encode_png_rgb(colors(8, 8))), ImageFault::kUnreadable,
                       "not a 16-bit grey PNG (8 bits, colour type 2)");
  expect_depth_failure(png_of(1, 1, 8, SPNG_COLOR_TYPE_GRAYSCALE, {7}), ImageFault::kUnreadable,
                       "not a 16-bit grey PNG (8 bits, colour type 0)");
  expect_color_failure(text_of(encode_png16(all_counts())), ImageFault::kUnreadable,
                       "not an 8-bit colour or grey PNG (16 bits)");
}

TEST_F(ImageTest, AFlippedByteOfAPngIsDamage) {
  std::string bytes = text_of(encode_png16(all_counts()));
  bytes[bytes.size() / 2] ^= 0x20;
  auto const failure = failure_of(read_png16, bytes);
  ASSERT_TRUE(failure.has_value());
  EXPECT_EQ(failure->fault, ImageFault::kUnreadable);
  EXPECT_THAT(failure->text, testing::StartsWith("damaged PNG: "));
}

TEST_F(ImageTest, ASizeNoCameraHasIsRefusedBeforeItIsAllocated) {
  std::string jpeg = jpeg_of(colors(8, 8));
  std::size_t const frame_header = jpeg.find("\xFF\xC0");
  ASSERT_NE(frame_header, std::string::npos);
  jpeg.replace(frame_header + 5, 4, "\xFF\x00\xFF\x00", 4);
  expect_color_failure(jpeg, ImageFault::kUnreadable, "claims 65280x65280 pixels");
}

TEST_F(ImageTest, NoPrefixOfAPngIsAnImage) {
  std::string const whole = text_of(encode_png16(Grid<std::uint16_t>(7, 5, 1234)));
  // The last four bytes are a checksum of nothing, which the decoder does not ask for.
  for (std::size_t length = 8; length < whole.size() - 4; ++length) {
    auto const failure = failure_of(read_png16, whole.substr(0, length));
    ASSERT_TRUE(failure.has_value()) << length << " of " << whole.size();
    EXPECT_EQ(failure->fault, ImageFault::kTruncated) << length << ": " << failure->text;
  }
}

TEST_F(ImageTest, NoPrefixOfAJpegIsAnImage) {
  std::string const whole = jpeg_of(colors(16, 16));
  for (std::size_t length = 3; length < whole.size(); ++length) {
    auto const failure = failure_of(read_color, whole.substr(0, length));
    ASSERT_TRUE(failure.has_value()) << length << " of " << whole.size();
    EXPECT_EQ(failure->fault, ImageFault::kTruncated) << length << ": " << failure->text;
  }
}

TEST_F(ImageTest, CannotBeWritten) {
  auto const path = folder_ / "no such folder" / "a.png";
  try {
    write_png_rgb(path, colors(2, 2));
    FAIL();
  } catch (InputError const& error) {
    EXPECT_EQ(error.what(),
              path.string() + ": cannot be written: is the disk full, or the folder gone?");
  }
}

}  // namespace
}  // namespace credo
