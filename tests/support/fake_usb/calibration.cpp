#include "support/fake_usb/calibration.hpp"

#include <array>
#include <cmath>
#include <cstring>

#include "support/fake_usb/fake_usb.hpp"

namespace credo::test::fake_usb {
namespace {

// A Kinect's nominal calibration: distances in cm, at the reference plane in the sensor's own
// pixels, of which an image's pixel holds two a side.
constexpr double kEmitterBaseline_cm = 7.5;
constexpr double kColorBaseline_cm = 2.4;
constexpr double kReference_cm = 120.0;
constexpr double kPixel_cm = 0.1042;
constexpr std::uint16_t kShift = 200;
constexpr double kDepthFocal_px = 575.8;
constexpr double kColorFocal_px = 525.0;
constexpr double kCenterU_px = 319.5;
constexpr double kCenterV_px = 239.5;
// libfreenect's own: by parallax against the reference plane, by rounding, by its tables.
constexpr double kParallax_px = kColorBaseline_cm / (2 * kPixel_cm);
constexpr double kRounding_px = 0.375;
constexpr double kTable_px = 1.0;
/// By how much an image shrinks from the depth camera's focal length to the colour camera's.
constexpr double kSlope = kColorFocal_px / kDepthFocal_px - 1.0;

std::int32_t fixed(double value, double scale) {
  return static_cast<std::int32_t>(std::lround(value * scale));
}

template <typename T>
void put(Bytes& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof(T));
}

}  // namespace

Bytes registration_parameters() {
  // 29 numbers after a status; of them a start and a slope in each direction are enough here.
  constexpr std::size_t kStartU = 5;
  constexpr std::size_t kStartV = 10;
  constexpr std::size_t kSlopeU = 17;
  constexpr std::size_t kSlopeV = 20;
  double const start_u_px = -kSlope * kCenterU_px - kParallax_px - kRounding_px - kTable_px;
  double const start_v_px = -kSlope * kCenterV_px - kTable_px;
  std::array<std::int32_t, 29> numbers{};
  numbers[kStartU] = fixed(start_u_px, 1 << 8);
  numbers[kStartV] = fixed(start_v_px, 1 << 8);
  numbers[kSlopeU] = fixed(kSlope, 1 << 15);
  numbers[kSlopeV] = fixed(kSlope, 1 << 15);
  Bytes reply(2 + sizeof(numbers));
  std::memcpy(reply.data() + 2, numbers.data(), sizeof(numbers));
  return reply;
}

Bytes padding_parameters() {
  return Bytes(8);
}

Bytes shift_parameters() {
  Bytes reply(4);
  put(reply, 2, kShift);
  return reply;
}

Bytes fixed_parameters() {
  constexpr std::size_t kBytesOfModel1414 = 322;
  constexpr std::size_t kPlane = 94;
  Bytes reply(kBytesOfModel1414);
  put(reply, kPlane, static_cast<float>(kEmitterBaseline_cm));
  put(reply, kPlane + 4, 2.3F);  // libfreenect takes 2.4 whatever is here
  put(reply, kPlane + 8, static_cast<float>(kReference_cm));
  put(reply, kPlane + 12, static_cast<float>(kPixel_cm));
  return reply;
}

double depth_mm(int raw) {
  double const shift_cm = ((raw - 4.0 * kShift) / 4.0 - kRounding_px) * kPixel_cm;
  return 10 * (shift_cm * kReference_cm / (kEmitterBaseline_cm - shift_cm) + kReference_cm);
}

double registered_u_px(double u_px, double depth_mm) {
  double const beside_px = kParallax_px * (10 * kReference_cm) / depth_mm;
  return kCenterU_px + (u_px - kCenterU_px) * (1.0 + kSlope) - beside_px;
}

double registered_v_px(double v_px) {
  return kCenterV_px + (v_px - kCenterV_px) * (1.0 + kSlope);
}

}  // namespace credo::test::fake_usb
