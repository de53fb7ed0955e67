#include "dds/delivery_check.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "dds/participant.hpp"

namespace credo::test {
namespace {

constexpr std::chrono::seconds kPatience{10};

DdsConfig config() {
  DdsConfig config;
  config.topic_prefix = "delivery_check";
  return config;
}

TEST(DeliveryCheck, ASampleComesOverTheLoopback) {
  EXPECT_TRUE(delivery_time(config(), 1'000'000, kPatience));
}

// Its domains are numbered otherwise: a run's participant may be there, too.
TEST(DeliveryCheck, BesideAParticipantOfTheSameDomain) {
  Participant const other(config());
  EXPECT_TRUE(delivery_time(config(), 1000, kPatience));
}

TEST(DeliveryCheck, AnInterfaceThatIsNotThere) {
  DdsConfig bad = config();
  bad.interface_name = "nowhere0";
  EXPECT_THROW((void)delivery_time(bad, 1000, kPatience), InputError);
}

}  // namespace
}  // namespace credo::test
