#include "graph/job.hpp"

#include <gtest/gtest.h>

#include "graph/fakes.hpp"

namespace credo {
namespace {

JobPtr job_of(std::int64_t index) {
  auto job = std::make_unique<Job>();
  job->index = FrameIndex{index};
  job->frame = test::tiny_frame(index);
  return job;
}

TEST(Job, AFailureKeepsTheNumberAndLetsTheFrameGo) {
  JobPtr job = job_of(3);
  std::weak_ptr<Frame const> const frame = job->frame;
  job->fail("planes", "no plane");
  EXPECT_FALSE(job->alive());
  EXPECT_TRUE(frame.expired());
  EXPECT_EQ(job->failure->index, FrameIndex{3});
  EXPECT_EQ(job->failure->reason, "planes");
}

TEST(Job, AnyNumberOfDropsTravelsAsOneEntry) {
  JobPtr last = job_of(0);
  for (std::int64_t i = 1; i <= 1000; ++i) {
    JobPtr next = job_of(i);
    inherit_lost(std::move(last), *next, "a_b");
    last = std::move(next);
  }
  ASSERT_EQ(last->lost_before.size(), 1U);
  EXPECT_EQ(last->lost_before[0].first, FrameIndex{0});
  EXPECT_EQ(last->lost_before[0].last, FrameIndex{999});
  EXPECT_EQ(last->lost_before[0].reason, "a_b_full");
  EXPECT_EQ(last->last_settled_before(), kPriorFrame);
}

TEST(Job, AFailedFrameThatIsDroppedStaysAFailure) {
  JobPtr failed = job_of(5);
  failed->fail("normals", "broken");
  JobPtr next = job_of(6);
  inherit_lost(std::move(failed), *next, "a_b");
  JobPtr last = job_of(7);
  inherit_lost(std::move(next), *last, "a_b");
  ASSERT_EQ(last->lost_before.size(), 2U);
  EXPECT_FALSE(last->lost_before[0].dropped);
  EXPECT_EQ(last->lost_before[0].reason, "normals");
  EXPECT_EQ(last->lost_before[0].message, "broken");
  EXPECT_TRUE(last->lost_before[1].dropped);
  EXPECT_EQ(last->last_settled_before(), FrameIndex{4});
}

TEST(Job, WhatTravelledEarlierComesFirst) {
  JobPtr a = job_of(0);
  JobPtr b = job_of(1);
  inherit_lost(std::move(a), *b, "early");
  JobPtr c = job_of(2);
  JobPtr d = job_of(3);
  inherit_lost(std::move(c), *d, "early");
  inherit_lost(std::move(b), *d, "late");
  ASSERT_EQ(d->lost_before.size(), 3U);
  EXPECT_EQ(d->lost_before[0].first, FrameIndex{0});
  EXPECT_EQ(d->lost_before[1].reason, "late_full");
  EXPECT_EQ(d->lost_before[2].first, FrameIndex{2});
}

}  // namespace
}  // namespace credo
