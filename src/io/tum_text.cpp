#include "io/tum_text.hpp"

#include <array>
#include <cstdio>

namespace credo {
namespace {

template <typename... Values>
std::string text(char const* format, Values... values) {
  std::array<char, 512> line{};
  std::snprintf(line.data(), line.size(), format, values...);  // NOLINT(*-vararg)
  return line.data();
}

}  // namespace

std::string tum_image_name(FrameIndex frame) {
  return text("%06lld.png", static_cast<long long>(number(frame)));
}

std::string tum_stamp(std::int64_t stamp_ns) {
  return text("%lld.%09lld", static_cast<long long>(stamp_ns / 1'000'000'000),
              static_cast<long long>(stamp_ns % 1'000'000'000));
}

std::string tum_pose(std::int64_t stamp_ns, Se3 const& T_source_camera) {
  Eigen::Vector3d const& t = T_source_camera.translation();
  Eigen::Quaterniond const& q = T_source_camera.rotation();
  return tum_stamp(stamp_ns) + text(" %.17g %.17g %.17g %.17g %.17g %.17g %.17g", t.x(), t.y(),
                                    t.z(), q.x(), q.y(), q.z(), q.w());
}

std::string intrinsics_text(CameraIntrinsics const& k) {
  return text("%.17g 0 %.17g\n0 %.17g %.17g\n0 0 1\n", k.fx_px, k.cx_px, k.fy_px, k.cy_px);
}

}  // namespace credo
