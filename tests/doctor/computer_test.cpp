#include "doctor/computer.hpp"

#include <gtest/gtest.h>

#include "doctor/fake_root.hpp"
#include "doctor/finding_matchers.hpp"

namespace credo::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// lo, and eth0 with multicast.
struct FakeComputer : FakeRoot {
  FakeComputer() {
    write("proc/cpuinfo", "processor\t: 0\nflags\t\t: sse2 avx avx2\n\nprocessor\t: 1\n");
    write("proc/loadavg", "0.75 0.50 0.25 1/200 1234\n");
    write("proc/sys/net/core/rmem_max", "4194304\n");
    write("sys/class/net/lo/flags", "0x9\n");
    write("sys/class/net/eth0/flags", "0x1003\n");
  }
};

ComputerState two_cores(FakeRoot const& root) {
  ComputerState computer = read_computer(root.path());
  computer.cores = 2;
  return computer;
}

DdsDelivery in_5_ms() {
  return {std::chrono::milliseconds(5), ""};
}

std::vector<Finding> findings_of(ComputerState const& computer, std::string const& interface) {
  DdsConfig config;
  config.interface_name = interface;
  return computer_findings(computer, config, false, in_5_ms());
}

TEST(Computer, AllIsWell) {
  FakeComputer const root;
  EXPECT_GE(read_computer(root.path()).cores, 1);
  EXPECT_THAT(findings_of(two_cores(root), "lo"),
              ElementsAre(ok("processor", "2 cores, AVX2"),
                          ok("load", "0.8 programs ran or wanted to, on 2 cores"),
                          ok("socket buffers", "net.core.rmem_max is 4194304 bytes"),
                          ok("interface lo", "stays on this computer"),
                          ok("DDS", "in 5.0 ms, over lo, domain 0")));
  EXPECT_THAT(troubles(findings_of(two_cores(root), "eth0")), IsEmpty());
}

TEST(Computer, ASlowProcessor) {
  FakeComputer const root;
  root.write("proc/cpuinfo", "flags\t\t: sse2 avx\n");
  EXPECT_THAT(troubles(findings_of(two_cores(root), "lo")),
              ElementsAre(warning("processor", "without AVX2")));
  root.write("proc/cpuinfo", "Features\t: asimd\n");  // not of that kind
  EXPECT_THAT(troubles(findings_of(two_cores(root), "lo")), IsEmpty());
  ComputerState computer = two_cores(root);
  computer.cores = 1;
  EXPECT_THAT(troubles(findings_of(computer, "lo")),
              ElementsAre(warning("processor", "1 core", "config/live.yaml")));
}

TEST(Computer, ABusyOne) {
  FakeComputer const root;
  root.write("proc/loadavg", "2.10 0.50 0.25 1/200 1234\n");
  EXPECT_THAT(troubles(findings_of(two_cores(root), "lo")),
              ElementsAre(warning("load", "2.1 programs", "top")));
  std::filesystem::remove(root.path() / "proc/loadavg");
  EXPECT_THAT(findings_of(two_cores(root), "lo"), testing::Not(Contains(ok("load"))));
}

TEST(Computer, SmallSocketBuffers) {
  FakeComputer const root;
  root.write("proc/sys/net/core/rmem_max", "212992\n");
  EXPECT_THAT(
      troubles(findings_of(two_cores(root), "lo")),
      ElementsAre(warning("socket buffers", "212992", "sudo sysctl -w net.core.rmem_max=4194304")));
  std::filesystem::remove(root.path() / "proc/sys/net/core/rmem_max");
  EXPECT_THAT(troubles(findings_of(two_cores(root), "lo")),
              ElementsAre(warning("socket buffers", "cannot be read")));
}

TEST(Computer, AnInterfaceThatIsNotThere) {
  FakeComputer const root;
  EXPECT_THAT(troubles(findings_of(two_cores(root), "wlan0")),
              ElementsAre(error("interface wlan0", "is not there; there are eth0, lo",
                                "--set dds.interface=lo")));
}

TEST(Computer, AnInterfaceThatIsDownOrWithoutMulticast) {
  FakeComputer const root;
  root.write("sys/class/net/eth0/flags", "0x1002\n");
  EXPECT_THAT(troubles(findings_of(two_cores(root), "eth0")),
              ElementsAre(error("interface eth0", "is down", "sudo ip link set eth0 up")));
  root.write("sys/class/net/eth0/flags", "0x3\n");
  EXPECT_THAT(troubles(findings_of(two_cores(root), "eth0")),
              ElementsAre(warning("interface eth0", "no multicast", "multicast on")));
}

TEST(Computer, DdsThatDoesNotStartOrDeliver) {
  FakeComputer const root;
  ComputerState const computer = two_cores(root);
  EXPECT_THAT(troubles(computer_findings(computer, {}, false, {std::nullopt, "no such thing"})),
              ElementsAre(error("DDS", "no such thing", "--set dds.interface=lo")));
  EXPECT_THAT(troubles(computer_findings(computer, {}, false, {std::nullopt, ""})),
              ElementsAre(error("DDS", "did not come", "firewall")));
}

TEST(Computer, WhereTheUriSaysWhereDdsListens) {
  FakeComputer const root;
  DdsConfig config;
  config.interface_name = "wlan0";
  auto const findings = computer_findings(two_cores(root), config, true, in_5_ms());
  EXPECT_THAT(troubles(findings), IsEmpty());
  EXPECT_THAT(findings, Contains(ok("DDS", "as CYCLONEDDS_URI says")));
  EXPECT_THAT(troubles(computer_findings(two_cores(root), config, true, {std::nullopt, "bad XML"})),
              ElementsAre(error("DDS", "bad XML", "unset CYCLONEDDS_URI")));
}

TEST(Computer, DdsOverTheLoopbackIsTried) {
  DdsConfig config;
  config.topic_prefix = "doctor_test";
  DdsDelivery const delivery = try_dds(config);
  EXPECT_EQ(delivery.trouble, "");
  EXPECT_TRUE(delivery.time);
  config.interface_name = "nowhere0";
  EXPECT_THAT(try_dds(config).trouble, testing::HasSubstr("nowhere0"));
}

}  // namespace
}  // namespace credo::test
