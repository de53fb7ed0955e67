#include "dds/remote_detector.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "dds/responder.hpp"

namespace credo::test {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

/// Who waits this long waits in vain: the test would time out.
constexpr double kForEverS = 3600.0;

Frame frame_of(std::int64_t index, int width = 4, int height = 3) {
  Frame frame;
  frame.index = FrameIndex{index};
  frame.cloud_camera = OrganizedCloud(width, height);
  return frame;
}

class RemoteDetectorTest : public testing::Test {
protected:
  RemoteDetectorTest() {
    dds_.topic_prefix = "remote_" + std::to_string(getpid());
    dds_.source = "robot";
  }

  std::unique_ptr<RemoteDetector> detector(double timeout_s = kForEverS) {
    RemoteDetectorConfig config;
    config.timeout_s = timeout_s;
    return std::make_unique<RemoteDetector>(
        dds_, config, [this](std::string const& line) { told_.push_back(line); },
        Responder::unused_domain());
  }

  DdsConfig dds_;
  /// By the detector.
  std::vector<std::string> told_;
};

std::vector<Reply> answered(credo_msg_DetectionRequest const& request) {
  return {found_in(request)};
}

/// Where the only thing that was found lies; it lies at the frame's number where all is right.
double found_x(std::vector<Detection> const& found) {
  return found.size() == 1 ? found[0].pose_camera.mean.translation().x() : -1.0;
}

std::string why_nobody_looked(RemoteDetector& detector, std::int64_t frame) {
  try {
    (void)detector.detect(frame_of(frame), {});
  } catch (NobodyLooked const& error) {
    return error.what();
  }
  return "somebody looked";
}

std::string refusal(RemoteDetector& detector, std::int64_t frame) {
  try {
    (void)detector.detect(frame_of(frame), {});
  } catch (NobodyLooked const&) {
    return "nobody looked";
  } catch (std::runtime_error const& error) {
    return error.what();
  }
  return "taken";
}

/// Asks until it is answered, so that what follows does not wait for the two to find each other.
std::int64_t meet(RemoteDetector& detector, std::int64_t frame) {
  for (; why_nobody_looked(detector, frame) != "somebody looked"; ++frame) {
    std::this_thread::sleep_for(10ms);
  }
  return frame + 1;
}

TEST_F(RemoteDetectorTest, IsAnsweredFrameByFrame) {
  Responder const responder(dds_, answered);
  auto const remote = detector();
  for (std::int64_t frame = 0; frame < 50; ++frame) {
    EXPECT_EQ(found_x(remote->detect(frame_of(frame), {})), static_cast<double>(frame));
  }
  EXPECT_EQ(remote->late(), 0U);
  EXPECT_THAT(told_, IsEmpty());
}

// As large as a camera's: what comes is what was sent.
TEST_F(RemoteDetectorTest, ARequestComesWhole) {
  Frame frame = frame_of(5, 640, 480);
  frame.color = Grid<Rgb>(640, 480);
  for (std::size_t i = 0; i < frame.color.size(); ++i) {
    auto const n = static_cast<float>(i);
    if (i % 7 != 0) {
      frame.cloud_camera.set(i, {0.0F, 0.0F, 0.5F + 1e-5F * n});
    }
    frame.color[i] = {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i / 256), 9};
  }
  std::vector<float> depth_m;
  std::vector<std::uint8_t> color;
  std::string type;
  Responder const responder(dds_, [&](credo_msg_DetectionRequest const& request) {
    auto const& depth = request.depth_m;
    auto const& rgb = request.color_rgb;
    depth_m.assign(depth._buffer, depth._buffer + depth._length);
    color.assign(rgb._buffer, rgb._buffer + rgb._length);
    type = request.objects._length == 1 ? request.objects._buffer[0].type : "";
    return answered(request);
  });
  EXPECT_EQ(found_x(detector()->detect(frame, {{"cup_1", "cup", some_pose(0.3)}})), 5.0);
  EXPECT_EQ(type, "cup");
  ASSERT_THAT(depth_m, SizeIs(640U * 480U));
  ASSERT_THAT(color, SizeIs(3U * 640U * 480U));
  std::vector<float> const sent_m(frame.cloud_camera.z.begin(), frame.cloud_camera.z.end());
  EXPECT_THAT(depth_m, testing::Pointwise(testing::NanSensitiveFloatEq(), sent_m));
  for (std::size_t i = 0; i < color.size(); ++i) {
    ASSERT_EQ(color[i], frame.color[i / 3].at(i % 3)) << i;
  }
}

TEST_F(RemoteDetectorTest, TheFirstFrameWaitsForTheDetectorToBeFound) {
  auto const remote = detector();
  std::unique_ptr<Responder> responder;
  std::jthread const later([&] {
    std::this_thread::sleep_for(300ms);
    responder = std::make_unique<Responder>(dds_, answered);
  });
  EXPECT_EQ(found_x(remote->detect(frame_of(0), {})), 0.0);
  EXPECT_THAT(told_, IsEmpty());
}

TEST_F(RemoteDetectorTest, WithoutADetectorNobodyLooksAndItIsToldOnce) {
  auto const remote = detector(0.05);
  for (std::int64_t frame = 4; frame < 10; ++frame) {
    EXPECT_EQ(why_nobody_looked(*remote, frame),
              "nobody answers on " + dds_.topic_prefix + "/detection_request");
  }
  EXPECT_THAT(told_, ElementsAre("frame 4: nobody looks for known objects: nobody answers on " +
                                 dds_.topic_prefix +
                                 "/detection_request; what is believed of them stays as it is "
                                 "until a detector answers"));
}

// It comes just before the next one, and is not taken for that.
TEST_F(RemoteDetectorTest, ALateReplyIsDroppedAndCounted) {
  Reply held;
  std::atomic<std::int64_t> mute = -1;
  Responder const responder(dds_, [&](credo_msg_DetectionRequest const& request) {
    if (request.frame == mute) {
      held = found_in(request);
      return std::vector<Reply>{};
    }
    std::vector<Reply> replies = {found_in(request)};
    if (request.frame == mute + 1) {
      replies.insert(replies.begin(), held);
    }
    return replies;
  });
  auto const remote = detector(0.25);
  std::int64_t const frame = meet(*remote, 0);
  told_.clear();
  std::uint64_t const before = remote->late();
  mute = frame;
  EXPECT_EQ(why_nobody_looked(*remote, frame),
            "no reply within 0.25 s (detector.remote.timeout_s)");
  EXPECT_EQ(found_x(remote->detect(frame_of(frame + 1), {})), static_cast<double>(frame + 1));
  EXPECT_EQ(remote->late(), before + 1);
  std::string const answers =
      ": the detector answers; frames without: 1, replies that came late "
      "so far: " +
      std::to_string(before + 1);
  EXPECT_THAT(told_, ElementsAre(StartsWith("frame " + std::to_string(frame) + ": nobody looks"),
                                 "frame " + std::to_string(frame + 1) + answers));
}

// More than one detector would: they must not push out the reply that is waited for.
TEST_F(RemoteDetectorTest, RepliesToOtherFramesAreCountedHoweverMany) {
  constexpr int kOthers = 10;
  Responder const responder(dds_, [&](credo_msg_DetectionRequest const& request) {
    std::vector<Reply> replies = {found_in(request)};
    for (int i = 1; request.frame == 0 && i <= kOthers; ++i) {
      replies.push_back(found_in(request));
      replies.back().frame = i % 2 == 0 ? -i : 1000 + i;
    }
    return replies;
  });
  auto const remote = detector();
  EXPECT_EQ(found_x(remote->detect(frame_of(0), {})), 0.0);
  EXPECT_EQ(found_x(remote->detect(frame_of(1), {})), 1.0);
  EXPECT_EQ(remote->late(), kOthers);
}

TEST_F(RemoteDetectorTest, RepliesToOthersAreTheirs) {
  Responder const responder(dds_, [&](credo_msg_DetectionRequest const& request) {
    Reply other_session = Reply::to(request);
    other_session.session += 1;
    Reply other_source = Reply::to(request);
    other_source.source += "2";
    return std::vector<Reply>{other_session, other_source, found_in(request)};
  });
  auto const remote = detector();
  EXPECT_EQ(found_x(remote->detect(frame_of(3), {})), 3.0);
  EXPECT_EQ(remote->late(), 0U);
}

// Even where they call themselves the same, and ask of the same frames.
TEST_F(RemoteDetectorTest, TwoThatAskAtOnceHaveEachTheirOwnReplies) {
  std::vector<std::uint64_t> sessions;
  Responder const responder(dds_, [&](credo_msg_DetectionRequest const& request) {
    sessions.push_back(request.session);
    Reply reply = found_in(request);
    reply.detections[0].type = request.objects._buffer[0].object_id;
    return std::vector<Reply>{reply};
  });
  auto const first = detector();
  auto const second = detector();
  auto const ask = [](RemoteDetector& remote, std::string const& name) {
    for (std::int64_t frame = 0; frame < 40; ++frame) {
      std::vector<Detection> const found =
          remote.detect(frame_of(frame), {{name, "cup", some_pose(0.0)}});
      EXPECT_EQ(found_x(found), static_cast<double>(frame)) << name;
      EXPECT_EQ(found.at(0).type, name);
    }
    EXPECT_EQ(remote.late(), 0U) << name;
  };
  {
    std::jthread const one([&] { ask(*first, "cup_1"); });
    std::jthread const other([&] { ask(*second, "cup_2"); });
  }
  EXPECT_THAT(sessions, SizeIs(80U));
  EXPECT_THAT(told_, IsEmpty());
}

TEST_F(RemoteDetectorTest, AReplyThatBreaksTheProtocolCostsItsFrame) {
  Responder const responder(dds_, [&](credo_msg_DetectionRequest const& request) {
    Reply reply = found_in(request);
    if (request.frame == 0) {
      reply.schema_version = 2;
    } else if (request.frame == 1) {
      reply.detections[0].pose_camera.covariance(2, 2) = -1.0;
    }
    return std::vector<Reply>{reply};
  });
  auto const remote = detector();
  EXPECT_THAT(refusal(*remote, 0), HasSubstr("to frame 0 has schema 2, and this Credo reads 1"));
  EXPECT_THAT(refusal(*remote, 1), HasSubstr("positive definite"));
  EXPECT_EQ(found_x(remote->detect(frame_of(2), {})), 2.0);
  EXPECT_EQ(remote->late(), 0U);
}

TEST_F(RemoteDetectorTest, ADetectorThatCouldNotLookIsToldOfOnce) {
  Responder const responder(dds_, [&](credo_msg_DetectionRequest const& request) {
    Reply reply = Reply::to(request);
    reply.error = request.frame < 3 ? "out of memory" : "";
    return std::vector<Reply>{reply};
  });
  auto const remote = detector();
  for (std::int64_t frame = 0; frame < 3; ++frame) {
    EXPECT_EQ(why_nobody_looked(*remote, frame), "the detector says: out of memory");
  }
  EXPECT_THAT(remote->detect(frame_of(3), {}), IsEmpty());
  EXPECT_THAT(told_, ElementsAre(HasSubstr("frame 0: nobody looks for known objects: the detector "
                                           "says: out of memory;"),
                                 "frame 3: the detector answers; frames without: 3, replies that "
                                 "came late so far: 0"));
}

TEST_F(RemoteDetectorTest, OnlyTheFirstFiveSilencesAreTold) {
  Responder const responder(dds_, [&](credo_msg_DetectionRequest const& request) {
    Reply reply = Reply::to(request);
    reply.error = request.frame % 2 == 0 ? "blind" : "";
    return std::vector<Reply>{reply};
  });
  auto const remote = detector();
  for (std::int64_t frame = 0; frame < 20; ++frame) {
    (void)why_nobody_looked(*remote, frame);
  }
  ASSERT_THAT(told_, SizeIs(10U));
  EXPECT_THAT(told_[6], testing::EndsWith("until a detector answers"));
  EXPECT_THAT(told_[8], testing::EndsWith("(more of these are only counted)"));
  EXPECT_THAT(told_[9], StartsWith("frame 9: the detector answers"));
}

// It is not waited for while it is away.
TEST_F(RemoteDetectorTest, ADetectorThatGoesAndComesBackIsAskedAgain) {
  auto responder = std::make_unique<Responder>(dds_, answered);
  auto const remote = detector();
  EXPECT_EQ(found_x(remote->detect(frame_of(0), {})), 0.0);
  responder.reset();
  std::this_thread::sleep_for(1s);
  for (std::int64_t frame = 1; frame < 4; ++frame) {
    EXPECT_THAT(why_nobody_looked(*remote, frame), StartsWith("nobody answers on"));
  }
  responder = std::make_unique<Responder>(dds_, answered);
  std::int64_t const next = meet(*remote, 4);
  EXPECT_EQ(found_x(remote->detect(frame_of(next), {})), static_cast<double>(next));
  EXPECT_THAT(told_, SizeIs(2U));
}

// DDS tells of it on the same way as replies come.
TEST_F(RemoteDetectorTest, TheGoodbyeOfADetectorIsNoReply) {
  auto const answers_only = [](std::int64_t frame) {
    return [frame](credo_msg_DetectionRequest const& request) {
      return request.frame == frame ? answered(request) : std::vector<Reply>{};
    };
  };
  auto first = std::make_unique<Responder>(dds_, answers_only(0));
  Responder const second(dds_, answers_only(7));
  auto const remote = detector();
  EXPECT_EQ(found_x(remote->detect(frame_of(0), {})), 0.0);
  first.reset();
  std::this_thread::sleep_for(500ms);
  EXPECT_EQ(found_x(remote->detect(frame_of(7), {})), 7.0);
  EXPECT_EQ(remote->late(), 0U);
}

TEST_F(RemoteDetectorTest, ADdsThatDoesNotStartIsToldAtOnce) {
  dds_.interface_name = "nowhere0";
  EXPECT_THROW((void)detector(), InputError);
}

}  // namespace
}  // namespace credo::test
