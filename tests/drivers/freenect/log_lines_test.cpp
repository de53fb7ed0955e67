#include "drivers/freenect/log_lines.hpp"

#include <gtest/gtest.h>

#include <string>

namespace credo::freenect::test {
namespace {

TEST(PacketNews, LostPacketsOfEitherStream) {
  auto const depth = packet_news("[Stream 70] Lost 3 packets\n");
  ASSERT_TRUE(depth);
  EXPECT_EQ(depth->stream, StreamKind::kDepth);
  EXPECT_EQ(depth->lost, 3);
  EXPECT_FALSE(depth->frame_dropped);
  auto const color = packet_news("[Stream 80] Lost 255 packets\n");
  ASSERT_TRUE(color);
  EXPECT_EQ(color->stream, StreamKind::kColor);
  EXPECT_EQ(color->lost, 255);
}

TEST(PacketNews, FramesGivenUp) {
  for (char const* line :
       {"[Stream 80] Lost too many packets, resyncing...\n",
        "[Stream 80] Inconsistent flag 81 with 12 packets in buf (162 total), resyncing...\n"}) {
    auto const news = packet_news(line);
    ASSERT_TRUE(news) << line;
    EXPECT_EQ(news->stream, StreamKind::kColor);
    EXPECT_TRUE(news->frame_dropped);
    EXPECT_EQ(news->lost, 0);
  }
}

TEST(PacketNews, OtherLinesAreNone) {
  for (char const* line :
       {"", "[Stream 70]", "[Stream 70] ", "[Stream 70] Lost packets", "[Stream 70] Lost 3",
        "[Stream 70] Lost 0 packets", "[Stream 70] Lost 3 total packets in 2 frames",
        "[Stream 70] Lost 99999999999 packets", "[Stream 71] Lost 3 packets", "Lost 3 packets",
        "[Stream 70] Negotiated packet size 1760\n"}) {
    EXPECT_FALSE(packet_news(line)) << line;
  }
}

TEST(LogTail, KeepsTheLastLines) {
  LogTail tail;
  EXPECT_EQ(tail.text(), "");
  tail.add("one\n");
  tail.add("two");
  EXPECT_EQ(tail.text(), "one; two");
  for (int i = 0; i < 6; ++i) {
    tail.add(std::to_string(i) + "\r\n");
  }
  EXPECT_EQ(tail.text(), "0; 1; 2; 3; 4; 5");
  tail.clear();
  EXPECT_EQ(tail.text(), "");
}

}  // namespace
}  // namespace credo::freenect::test
