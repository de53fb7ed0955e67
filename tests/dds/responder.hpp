#pragma once

#include <dds/dds.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "dds/detection_messages.hpp"
#include "dds/entities.hpp"
#include "dds/participant.hpp"

namespace credo::test {

/// A pose about which all numbers differ.
inline PoseDistribution some_pose(double x_m) {
  PoseDistribution pose;
  pose.mean = Se3(so3_exp({0.3, -0.4, 0.5}), {x_m, -0.2, 1.5});
  pose.covariance = Vector6d(1, 2, 3, 4, 5, 6).asDiagonal();
  pose.covariance(0, 4) = pose.covariance(4, 0) = 0.5;
  return pose;
}

inline credo_msg_CameraPose camera_pose_message(PoseDistribution const& pose) {
  credo_msg_CameraPose message{};
  Eigen::Map<Eigen::Vector3d>(message.position_camera_m) = pose.mean.translation();
  Eigen::Quaterniond const& q = pose.mean.rotation();
  Eigen::Map<Eigen::Vector4d>(message.orientation_camera_xyzw) << q.x(), q.y(), q.z(), q.w();
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(message.covariance) = pose.covariance;
  return message;
}

/// A reply that owns what it tells. As it stands, it is right, and nothing was found.
struct Reply {
  std::string source;
  std::uint64_t session = 0;
  std::int64_t frame = 0;
  std::uint32_t schema_version = credo_msg_DETECTION_SCHEMA;
  std::string error;
  std::vector<Detection> detections;

  static Reply to(credo_msg_DetectionRequest const& request) {
    Reply reply;
    reply.source = request.source;
    reply.session = request.session;
    reply.frame = request.frame;
    return reply;
  }

  /// By `use(message)`.
  template <typename Use>
  void lend(Use const& use) {
    std::vector<credo_msg_FoundObject> found;
    for (Detection& one : detections) {
      found.push_back(
          {one.type.data(), camera_pose_message(one.pose_camera), one.score, one.visible_fraction});
    }
    credo_msg_DetectionReply message{};
    message.source = source.data();
    message.session = session;
    message.frame = frame;
    message.schema_version = schema_version;
    message.error = error.data();
    message.detections._length = message.detections._maximum =
        static_cast<std::uint32_t>(found.size());
    message.detections._buffer = found.data();
    use(message);
  }
};

/// Found at x = the frame's number.
inline Reply found_in(credo_msg_DetectionRequest const& request) {
  Reply reply = Reply::to(request);
  reply.detections.push_back({"cup", some_pose(static_cast<double>(request.frame)), 0.9, 0.5});
  return reply;
}

/// A detector in a thread of its own, on the same topics. Each request is answered by the replies
/// that it is told; ends with this object.
class Responder {
public:
  using Answer = std::function<std::vector<Reply>(credo_msg_DetectionRequest const&)>;

  Responder(DdsConfig const& config, Answer answer)
      : participant_(config, unused_domain()),
        writer_(writer_of(participant_, "detection_reply", credo_msg_DetectionReply_desc,
                          many_replies_qos())),
        reader_(reader_of(participant_, "detection_request", credo_msg_DetectionRequest_desc,
                          last_state_qos())),
        answer_(std::move(answer)),
        thread_([this](std::stop_token const& stop) { serve(stop); }) {}

  /// Of this process; no two participants of one may share it.
  static std::uint32_t unused_domain() {
    static std::atomic<std::uint32_t> next = 1100;
    return next++;
  }

private:
  /// A writer that keeps the last one only might never send those before.
  static Qos many_replies_qos() {
    Qos qos = last_state_qos();
    dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, 16);
    return qos;
  }

  void serve(std::stop_token const& stop) {
    while (!stop.stop_requested()) {
      void* sample = nullptr;
      dds_sample_info_t info{};
      if (dds_take(reader_.handle(), &sample, &info, 1, 1) <= 0) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        continue;
      }
      if (info.valid_data) {
        for (Reply& reply : answer_(*static_cast<credo_msg_DetectionRequest const*>(sample))) {
          reply.lend([&](auto const& message) { dds_write(writer_.handle(), &message); });
        }
        flush(writer_);
      }
      dds_return_loan(reader_.handle(), &sample, 1);
    }
  }

  Participant participant_;
  DdsEntity writer_;
  DdsEntity reader_;
  Answer answer_;
  std::jthread thread_;
};

}  // namespace credo::test
