// A detector outside the house, to begin your own from: answers what Credo asks on DDS with what a
// file says was found (docs/known-objects.md, recorded detections). Only look() is about detection,
// the rest is the protocol (docs/detectors.md). Listens where CYCLONEDDS_URI says:
//   export CYCLONEDDS_URI=file://$PWD/config/cyclonedds.xml
//   credo_example_detector detections.jsonl [PREFIX]
//   credo run --source ... --prior ... --set detector.kind=remote
#include <dds/dds.h>

#include <csignal>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "detector.h"

namespace {

volatile std::sig_atomic_t stopped = 0;
/// A pose takes the model into the camera's optical frame; the covariance is as in the IDL.
struct Found {
  std::string type;
  credo_msg_CameraPose pose{};
  double score = 0.0;
  double visible_fraction = 1.0;
};

/// By frame. The file's lines are JSON.
using Recording = std::map<std::int64_t, std::vector<Found>>;

Recording read_recording(std::string const& path) {
  std::ifstream file(path);
  if (!file) {
    throw std::runtime_error(path + ": cannot be read");
  }
  Recording recording;
  for (nlohmann::json line; file >> std::ws && !file.eof();) {
    file >> line;
    for (auto const& detection : line.at("detections")) {
      Found& found = recording[line.at("frame")].emplace_back();
      found.type = detection.at("type");
      detection.at("position").get_to(found.pose.position_camera_m);
      detection.at("orientation_xyzw").get_to(found.pose.orientation_camera_xyzw);
      detection.at("covariance").get_to(found.pose.covariance);
      found.score = detection.at("score");
      found.visible_fraction = detection.value("visible_fraction", 1.0);
    }
  }
  return recording;
}

/// Yours: find request.objects in request.depth_m and request.color_rgb. A throw is told to Credo
/// as the reply's error; that differs from finding nothing, which counts against what is in view.
std::vector<Found> look(credo_msg_DetectionRequest const& request, Recording const& recording) {
  if (request.depth_m._length != request.width_px * request.height_px) {
    throw std::runtime_error("the depth image is not of its size");
  }
  auto const found = recording.find(request.frame);
  return found != recording.end() ? found->second : std::vector<Found>{};
}

/// Whatever happens, each request is answered once.
void answer(credo_msg_DetectionRequest const& request, Recording const& recording,
            dds_entity_t writer) {
  std::vector<Found> found;
  std::string error;
  try {
    if (request.schema_version != credo_msg_DETECTION_SCHEMA) {
      throw std::runtime_error("I know another version of detector.idl");
    }
    found = look(request, recording);
  } catch (std::exception const& failure) {
    error = failure.what();
  }
  std::vector<credo_msg_FoundObject> detections;
  for (Found& one : found) {
    detections.push_back({one.type.data(), one.pose, one.score, one.visible_fraction});
  }
  credo_msg_DetectionReply reply{};
  reply.source = request.source;  // these three say which request it answers
  reply.session = request.session;
  reply.frame = request.frame;
  reply.schema_version = credo_msg_DETECTION_SCHEMA;
  reply.error = error.data();
  reply.detections._length = static_cast<std::uint32_t>(detections.size());
  reply.detections._buffer = detections.data();
  dds_write(writer, &reply);
}

dds_entity_t checked(dds_entity_t entity) {
  if (entity < 0) {
    throw std::runtime_error(dds_strretcode(-entity));
  }
  return entity;
}

void serve(Recording const& recording, std::string const& prefix) {
  dds_entity_t const domain = checked(dds_create_participant(DDS_DOMAIN_DEFAULT, nullptr, nullptr));
  auto const topic = [&](dds_topic_descriptor_t const& type, char const* name) {
    return checked(dds_create_topic(domain, &type, (prefix + name).c_str(), nullptr, nullptr));
  };
  dds_entity_t const replies = topic(credo_msg_DetectionReply_desc, "/detection_reply");
  dds_entity_t const requests = topic(credo_msg_DetectionRequest_desc, "/detection_request");
  // As Credo has them: with less, the two do not find each other. Of each run the newest request
  // only: no other waits any longer.
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 1);
  dds_entity_t const writer = checked(dds_create_writer(domain, replies, qos, nullptr));
  dds_entity_t const reader = checked(dds_create_reader(domain, requests, qos, nullptr));
  dds_delete_qos(qos);
  dds_entity_t const waitset = checked(dds_create_waitset(domain));
  dds_set_status_mask(reader, DDS_DATA_AVAILABLE_STATUS);
  dds_waitset_attach(waitset, reader, 0);
  while (stopped == 0) {
    dds_waitset_wait(waitset, nullptr, 0, DDS_MSECS(100));
    void* sample = nullptr;  // lent by DDS
    dds_sample_info_t info;
    while (dds_take(reader, &sample, &info, 1, 1) > 0) {
      if (info.valid_data) {  // else a run has ended
        answer(*static_cast<credo_msg_DetectionRequest const*>(sample), recording, writer);
      }
      dds_return_loan(reader, &sample, 1);
      sample = nullptr;
    }
  }
  dds_delete(domain);
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 2) {
    std::fprintf(stderr, "usage: %s DETECTIONS [PREFIX]\n", argv[0]);
    return 2;
  }
  std::signal(SIGINT, [](int) { stopped = 1; });
  std::signal(SIGTERM, [](int) { stopped = 1; });
  serve(read_recording(argv[1]), argc > 2 ? argv[2] : "credo");
  return 0;
} catch (std::exception const& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
