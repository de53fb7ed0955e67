#include "support/oni_writer.hpp"

namespace credo::test {
namespace {

constexpr std::uint32_t kDepthNode = 2;
constexpr std::uint32_t kImageNode = 3;

template <typename T>
std::string raw(T const& value) {
  return {reinterpret_cast<char const*>(&value), sizeof(value)};
}

std::string text(std::string const& value) {
  return raw(static_cast<std::uint32_t>(value.size() + 1)) + value + '\0';
}

std::string record(std::uint32_t type, std::uint32_t node, std::string const& fields,
                   std::string const& payload = "") {
  return std::string("NIR\0", 4) + raw(type) + raw(node) +
         raw(static_cast<std::uint32_t>(28 + fields.size())) +
         raw(static_cast<std::uint32_t>(payload.size())) + raw(std::uint64_t{0}) + fields + payload;
}

std::string property(std::uint32_t type, std::uint32_t node, std::string const& name,
                     std::string const& value) {
  return record(type, node, text(name) + raw(static_cast<std::uint32_t>(value.size())) + value);
}

std::string number(std::uint32_t node, std::string const& name, std::uint64_t value) {
  return property(0x03, node, name, raw(value));
}

std::string node(std::uint32_t id, std::uint32_t type, std::string const& name,
                 std::string const& codec, std::size_t images, OniScript const& script) {
  constexpr std::uint32_t kFramesPerS = 30;
  std::string const mode = raw(static_cast<std::uint32_t>(script.width)) +
                           raw(static_cast<std::uint32_t>(script.height)) + raw(kFramesPerS);
  auto const pixels =
      static_cast<std::uint64_t>(script.width) * static_cast<std::uint64_t>(script.height);
  bool const depth = type == kDepthNode;
  std::string bytes = record(0x0D, id,
                             text(name) + raw(type) + codec +
                                 raw(static_cast<std::uint32_t>(images)) + raw(std::uint64_t{0}) +
                                 raw(std::uint64_t{images * 33333}) + raw(std::uint64_t{0}));
  bytes += number(id, "oniRequiredFrameSize", pixels * (depth ? 2 : 3));
  bytes += number(id, "xnIsGenerating", 1);
  bytes += number(id, "xnDeviceMaxDepth", 10000);
  bytes += number(id, "xnSupportedMapOutputModesCount", 1);
  bytes += property(0x06, id, "xnSupportedMapOutputModes", mode);
  bytes += property(0x06, id, "xnMapOutputMode", mode);
  bytes += property(0x06, id, "xnSupportedPixelFormats", raw(depth ? 8U : 1U));
  bytes += number(id, "xnPixelFormat", depth ? 4 : 1);
  bytes += number(id, "oniPixelFormat", depth ? 100 : 200);
  bytes += property(0x06, id, "xnFOV", raw(script.fov_rad) + raw(script.fov_rad));
  bytes += number(id, "Cropping", 1);
  bytes += property(0x06, id, "xnCropping", std::string(12, '\0'));
  bytes += number(id, "Mirror", 1);
  bytes += number(id, "xnMirror", script.mirrored ? 1 : 0);
  return bytes;
}

std::string ready(std::uint32_t id) {
  return record(0x09, id, "") + record(0x08, id, std::string(12, '\xFF'));
}

}  // namespace

std::string oni_bytes(OniScript const& script) {
  bool const color = !script.color_images.empty();
  std::string bytes = "NI10" + std::string("\x01\0\x01\0\0\0\0\0", 8) + raw(~std::uint64_t{0}) +
                      raw(std::uint32_t{2});
  bytes += node(1, kDepthNode, "Depth", script.depth_codec, script.depth_images.size(), script);
  if (color) {
    bytes += node(2, kImageNode, "Image", script.color_codec, script.color_images.size(), script);
  }
  // OpenNI2 looks for nodes no further than the first that is ready.
  bytes += ready(1) + (color ? ready(2) : "");
  for (std::size_t i = 0; i < script.depth_images.size(); ++i) {
    auto const stamp_us = static_cast<std::int64_t>(i * 33333);
    auto const image_number = static_cast<std::uint32_t>(i + 1);
    bytes += record(0x0A, 1, raw(stamp_us) + raw(image_number), script.depth_images[i]);
    if (color) {
      bytes += record(0x0A, 2, raw(stamp_us + script.color_delay_us) + raw(image_number),
                      script.color_images[i]);
    }
  }
  return bytes + record(0x0B, 0, "");
}

std::string packed(std::vector<std::uint16_t> const& counts) {
  return {reinterpret_cast<char const*>(counts.data()), counts.size() * sizeof(counts[0])};
}

}  // namespace credo::test
