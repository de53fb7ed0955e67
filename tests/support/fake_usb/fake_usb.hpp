#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

// A libusb-1.0 that plays Kinects of model 1414, for libfreenect as it is. A program that links it
// has it in the place of the true one, and plugs in and breaks Kinects through these functions.
namespace credo::test::fake_usb {

enum class Stream : std::uint8_t { kDepth, kColor };

/// 640 x 480 values each.
struct Images {
  /// 11 bits, as the sensor measures: larger is farther, 2047 is nothing.
  std::vector<std::vector<std::uint16_t>> depth_raw;
  /// One byte a pixel: green red / blue green.
  std::vector<std::vector<std::uint8_t>> color_bayer;
};

struct Kinect {
  std::string serial = "A00361A00361A";
  /// Frame k shows image k modulo their number. Frames are counted from the plugging in, whether
  /// the streams run or not.
  Images images;
  double rate_hz = 30;
  /// Colour's packets come so much of a frame's time earlier than they would.
  double color_lead = 0;
  /// What its clock of 60 MHz says at frame 0.
  std::uint32_t first_stamp = 0;
};

/// The colour of a frame is stamped so much later than its depth.
inline constexpr std::uint32_t kColorDelay_ticks = 30'000;

void plug(Kinect kinect);
/// Transfers under way end with "no device", and calls fail with it.
void unplug(std::string const& serial);

/// How libusb's functions fail with a Kinect; 0: they do not.
struct Faults {
  int open_error = 0;
  int claim_error = 0;
  int submit_error = 0;
  /// Control reads answer with 0 bytes, for ever.
  bool silent_replies = false;
};
void set_faults(std::string const& serial, Faults const& faults);

/// Sends nothing more until the stream is started anew.
void stall(std::string const& serial, Stream stream);
/// Does not send so many packets of the middle of the next frame.
void lose_packets(std::string const& serial, Stream stream, int packets);

/// What a Kinect has been asked for so far.
struct Usage {
  int open_handles = 0;
  int transfers_in_flight = 0;
  int depth_starts = 0;
  int color_starts = 0;
  /// The colour sensor's register of automatic exposure and white balance.
  std::uint16_t color_flags = 0;
  /// Transfers freed and handles closed while transfers were under way.
  int misuses = 0;
};
Usage usage(std::string const& serial);

/// Depth in millimetres that libfreenect makes of a raw value, where this is no nonsense: the
/// nominal calibration, which all these Kinects have.
double depth_mm(int raw);
/// Where a depth pixel lies in the colour image, by the projection that the registration tables of
/// these Kinects stand for: 575.8 to 525 px, colour camera 24 mm beside.
double registered_u_px(double u_px, double depth_mm);
double registered_v_px(double v_px);

}  // namespace credo::test::fake_usb
