#include "doctor/listed_findings.hpp"

#include <gtest/gtest.h>

#include "doctor/finding_matchers.hpp"

namespace credo::test {
namespace {

using ::testing::ElementsAre;

UsbDevice kinect() {
  UsbDevice device;
  device.vendor = kKinectVendor;
  device.product = 0x02AE;
  device.name = "Kinect camera";
  device.port = "1-2.3";
  return device;
}

UsbState with(std::vector<UsbDevice> devices) {
  UsbState usb;
  usb.known = true;
  usb.devices = std::move(devices);
  return usb;
}

OpenniInstall install(bool with_kinect_driver = true) {
  OpenniInstall result;
  if (with_kinect_driver) {
    result.modules = {{"libcredo_freenect.so.0", "", ""}};
  }
  return result;
}

SensorInfo listed(std::uint16_t vendor) {
  SensorInfo info;
  info.uri = "freenect://A00361A00361A";
  info.vendor = "Microsoft";
  info.name = "Kinect";
  info.usb_vendor = vendor;
  info.depth_modes = {{640, 480, 30, "1 mm"}, {640, 480, 30, "1 mm"}, {320, 240, 60, "1 mm"}};
  info.color_modes = {{640, 480, 30, "RGB888"}};
  return info;
}

TEST(ListedFindings, TellsWhatASensorCan) {
  EXPECT_THAT(
      listed_findings({listed(kKinectVendor)}, with({kinect()}), install()),
      ElementsAre(ok("freenect://A00361A00361A",
                     "Microsoft Kinect: depth 640x480 at 30 Hz (1 mm), 320x240 at 60 Hz (1 mm); "
                     "colour 640x480 at 30 Hz (RGB888)")));
}

TEST(ListedFindings, ASensorThatDoesNotOpen) {
  SensorInfo info = listed(kKinectVendor);
  info.trouble = "LIBUSB_ERROR_BUSY";
  EXPECT_THAT(listed_findings({info}, with({kinect()}), install()),
              ElementsAre(error("freenect://", "LIBUSB_ERROR_BUSY", "end other programs")));
}

TEST(ListedFindings, ASensorWithoutDepth) {
  SensorInfo info = listed(kKinectVendor);
  info.depth_modes.clear();
  EXPECT_THAT(listed_findings({info}, with({kinect()}), install()),
              ElementsAre(error("freenect://", "has no depth", "--source")));
}

TEST(ListedFindings, NoSensorAtAll) {
  EXPECT_THAT(listed_findings({}, with({}), install()),
              ElementsAre(error("list", "OpenNI2 lists no sensor", "docs/virtual-sensor.md")));
}

// What else is listed does not stand for it.
TEST(ListedFindings, OneOnTheBusIsNotListedAndWhy) {
  SensorInfo const other = listed(0);
  auto const why = [&](UsbDevice const& device, bool with_driver) {
    return troubles(listed_findings({other}, with({device}), install(with_driver)));
  };
  EXPECT_THAT(why(kinect(), false), ElementsAre(error("Kinect camera", "there is no driver for it",
                                                      "see OpenNI2: Kinect driver")));
  UsbDevice refused = kinect();
  refused.access = UsbDevice::Access::kRefused;
  EXPECT_THAT(why(refused, true), ElementsAre(error("Kinect camera", "you may not use it")));
  UsbDevice held = kinect();
  held.driver = "gspca_kinect";
  EXPECT_THAT(why(held, true), ElementsAre(error("Kinect camera", "the kernel's camera driver")));
  held.driver = "usbfs";
  EXPECT_THAT(why(held, true), ElementsAre(error("Kinect camera", "another program")));
  EXPECT_THAT(why(kinect(), true),
              ElementsAre(error("Kinect camera", "its driver could not open it", "1414")));
}

TEST(ListedFindings, OneOfTwoIsNotListed) {
  UsbDevice motor = kinect();
  motor.role = UsbDevice::Role::kMotor;
  EXPECT_THAT(troubles(listed_findings({listed(kKinectVendor)}, with({kinect(), kinect(), motor}),
                                       install())),
              ElementsAre(error("Kinect camera", "2 on the bus, 1 listed by OpenNI2")));
}

TEST(ListedFindings, AnXtionNeedsNoKinectDriver) {
  UsbDevice xtion = kinect();
  xtion.vendor = kPrimeSenseVendor;
  xtion.name = "Xtion Pro";
  EXPECT_THAT(troubles(listed_findings({listed(0)}, with({xtion}), install(false))),
              ElementsAre(error("Xtion Pro", "its driver could not open it")));
}

}  // namespace
}  // namespace credo::test
