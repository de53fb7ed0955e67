#include "doctor/usb_bus.hpp"

#include <gtest/gtest.h>

#include "doctor/fake_root.hpp"
#include "doctor/finding_matchers.hpp"

namespace credo::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// On the hub within it, at port 1-2.
void plug_in_kinect(FakeRoot const& root) {
  root.plug_in("1-2.1", "045e", "02b0", 5, "12");
  root.plug_in("1-2.2", "045e", "02ad", 6);
  root.plug_in("1-2.3", "045e", "02ae", 7);
  root.write("sys/bus/usb/devices/1-2.3/serial", "A00361A00361A\n");
}

TEST(UsbBus, AKinectAsTheKernelTellsIt) {
  FakeRoot const root;
  plug_in_kinect(root);
  root.plug_in("1-1", "046d", "c52b", 2, "12");  // a mouse
  root.write("sys/module/usbcore/parameters/usbfs_memory_mb", "16\n");
  UsbState const usb = read_usb(root.path());
  EXPECT_TRUE(usb.known);
  EXPECT_FALSE(usb.gspca_kinect_loaded);
  EXPECT_EQ(usb.usbfs_memory_mb, 16);
  ASSERT_EQ(usb.devices.size(), 3U);
  UsbDevice const& camera = usb.devices[2];
  EXPECT_EQ(camera.name, "Kinect camera");
  EXPECT_EQ(camera.port, "1-2.3");
  EXPECT_EQ(camera.node(), "/dev/bus/usb/001/007");
  EXPECT_EQ(camera.speed_mbit_s, 480.0);
  EXPECT_EQ(camera.serial, "A00361A00361A");
  EXPECT_EQ(camera.driver, "");
  EXPECT_EQ(camera.access, UsbDevice::Access::kOpen);
  EXPECT_THAT(usb_findings(usb),
              ElementsAre(ok("Kinect camera at port 1-2.3",
                             "045e:02ae, 480 Mbit/s, /dev/bus/usb/001/007, serial A00361A00361A")));
}

TEST(UsbBus, AnXtionIsASensor) {
  FakeRoot const root;
  root.plug_in("1-1", "1d27", "0601", 3);
  root.plug_in("1-3", "1d27", "0400", 4);
  auto const findings = usb_findings(read_usb(root.path()));
  EXPECT_THAT(findings, Contains(ok("Xtion Pro Live at port 1-1", "1d27:0601")));
  EXPECT_THAT(findings, Contains(ok("PrimeSense sensor at port 1-3", "1d27:0400")));
}

TEST(UsbBus, WithoutAnyUsb) {
  FakeRoot const root;
  EXPECT_THAT(usb_findings(read_usb(root.path())),
              ElementsAre(warning("bus", "tells nothing of USB", "container")));
}

TEST(UsbBus, WithoutASensor) {
  FakeRoot const root;
  root.plug_in("1-1", "046d", "c52b", 2, "12");
  EXPECT_THAT(usb_findings(read_usb(root.path())),
              ElementsAre(warning("bus", "no Kinect, Xtion", "lsusb")));
}

TEST(UsbBus, ACameraThatIsTooSlow) {
  FakeRoot const root;
  plug_in_kinect(root);
  root.write("sys/bus/usb/devices/1-2.3/speed", "12\n");
  EXPECT_THAT(troubles(usb_findings(read_usb(root.path()))),
              ElementsAre(error("speed", "12 Mbit/s", "socket")));
}

TEST(UsbBus, AMotorWithoutItsCameraLacksPower) {
  FakeRoot const root;
  root.plug_in("1-2.1", "045e", "02b0", 5, "12");
  // Another Kinect's camera, on another hub.
  root.plug_in("1-3.1", "045e", "02ae", 9);
  EXPECT_THAT(troubles(usb_findings(read_usb(root.path()))),
              ElementsAre(error("Kinect motor at port 1-2.1", "its camera is not",
                                "plug in the Kinect's power supply")));
}

TEST(UsbBus, WithoutADeviceNode) {
  FakeRoot const root;
  plug_in_kinect(root);
  std::filesystem::remove(root.path() / "dev/bus/usb/001/007");
  EXPECT_THAT(troubles(usb_findings(read_usb(root.path()))),
              ElementsAre(error("right to use it", "there is no /dev/bus/usb/001/007", "docker")));
}

// Root may use everything, so this is told, not read.
TEST(UsbBus, WithoutTheRight) {
  UsbState usb;
  usb.known = true;
  usb.devices = {{.vendor = kKinectVendor,
                  .product = 0x02AE,
                  .role = UsbDevice::Role::kCamera,
                  .name = "Kinect camera",
                  .port = "1-2.3",
                  .bus = 1,
                  .number = 7,
                  .speed_mbit_s = 480,
                  .serial = "",
                  .driver = "",
                  .access = UsbDevice::Access::kRefused}};
  EXPECT_THAT(
      troubles(usb_findings(usb)),
      ElementsAre(error(
          "right to use it", "you may not read and write /dev/bus/usb/001/007",
          R"(echo 'SUBSYSTEM=="usb", ATTR{idVendor}=="045e", ATTR{idProduct}=="02ae", MODE="0666"' )"
          "| sudo tee -a /etc/udev/rules.d/60-credo.rules && sudo udevadm control --reload && "
          "sudo udevadm trigger")));
}

TEST(UsbBus, HeldByTheKernelsCameraDriver) {
  FakeRoot const root;
  plug_in_kinect(root);
  root.bind("1-2.3", "gspca_kinect");
  root.write("proc/modules",
             "gspca_main 32768 1 gspca_kinect, Live\ngspca_kinect 16384 0 - Live\n");
  EXPECT_THAT(troubles(usb_findings(read_usb(root.path()))),
              ElementsAre(error("kernel driver", "holds it", "sudo modprobe -r gspca_kinect")));
}

TEST(UsbBus, TheKernelsCameraDriverInWaiting) {
  FakeRoot const root;
  plug_in_kinect(root);
  root.write("proc/modules", "gspca_kinect 16384 0 - Live\n");
  EXPECT_THAT(troubles(usb_findings(read_usb(root.path()))),
              ElementsAre(warning("kernel driver", "is loaded", "blacklist gspca_kinect")));
  root.write("proc/modules", "gspca_kinect_not 16384 1 gspca_kinect - Live\n");
  EXPECT_THAT(troubles(usb_findings(read_usb(root.path()))), IsEmpty());
}

TEST(UsbBus, InUseByAnotherProgram) {
  FakeRoot const root;
  plug_in_kinect(root);
  root.bind("1-2.3", "usbfs");
  EXPECT_THAT(troubles(usb_findings(read_usb(root.path()))),
              ElementsAre(warning("in use", "another program", "fuser -v /dev/bus/usb/001/007")));
}

TEST(UsbBus, HeldByADriverThatIsNotKnown) {
  FakeRoot const root;
  plug_in_kinect(root);
  root.bind("1-2.3", "uvcvideo");
  EXPECT_THAT(troubles(usb_findings(read_usb(root.path()))),
              ElementsAre(warning("kernel driver", "uvcvideo", "modprobe -r uvcvideo")));
}

TEST(UsbBus, TwoSensorsOnOneBus) {
  FakeRoot const root;
  plug_in_kinect(root);
  root.plug_in("1-4", "1d27", "0600", 9);
  EXPECT_THAT(troubles(usb_findings(read_usb(root.path()))),
              ElementsAre(warning("bus 1", "2 sensors share it (ports 1-2.3, 1-4)", "controller")));
  root.write("sys/bus/usb/devices/1-4/busnum", "2\n");
  root.write("dev/bus/usb/002/009", "");
  EXPECT_THAT(troubles(usb_findings(read_usb(root.path()))), IsEmpty());
}

TEST(UsbBus, TooLittleMemoryForTransfers) {
  FakeRoot const root;
  plug_in_kinect(root);
  root.plug_in("1-4", "1d27", "0600", 9);
  root.write("sys/module/usbcore/parameters/usbfs_memory_mb", "1\n");
  auto const few =
      error("memory for transfers", "1 MB for 2 sensors", "echo 16 | sudo tee /sys/module/usbcore");
  EXPECT_THAT(usb_findings(read_usb(root.path())), Contains(few));
  for (char const* enough : {"2\n", "0\n"}) {
    root.write("sys/module/usbcore/parameters/usbfs_memory_mb", enough);
    EXPECT_THAT(troubles(usb_findings(read_usb(root.path()))),
                ElementsAre(warning("bus 1", "2 sensors share it")))
        << enough;
  }
}

}  // namespace
}  // namespace credo::test
