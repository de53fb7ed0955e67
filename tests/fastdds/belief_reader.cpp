// Prints the first belief that comes on a topic as a line of belief.jsonl, read with Fast DDS on
// the loopback. Usage: credo_fastdds_reader TOPIC TIMEOUT_S
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "beliefPubSubTypes.h"
#include "core/belief_summary.hpp"
#include "io/belief_json.hpp"

namespace {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastdds::rtps;

template <typename Array>
auto vector_of(Array const& array) {
  using Scalar = typename Array::value_type;
  return Eigen::Matrix<Scalar, static_cast<int>(std::tuple_size_v<Array>), 1>(array.data());
}

template <int kSide>
Eigen::Matrix<double, kSide, kSide> matrix_of(
    std::array<double, static_cast<std::size_t>(kSide) * kSide> const& rows) {
  return Eigen::Map<Eigen::Matrix<double, kSide, kSide, Eigen::RowMajor> const>(rows.data());
}

std::optional<credo::LabelCode> label_of(credo::msg::PixelLabel const& label) {
  return label.given() ? std::optional<credo::LabelCode>(label.code()) : std::nullopt;
}

/// Our words are in the order of the IDL.
credo::Evidence evidence_of(credo::msg::Evidence evidence) {
  return static_cast<credo::Evidence>(evidence);
}

credo::Account account_of(credo::msg::Account const& message) {
  credo::Account why;
  auto const put = [&](credo::PointState state, std::uint32_t points) {
    why.points[state] = static_cast<int>(points);
  };
  put(credo::PointState::kAgrees, message.agrees());
  put(credo::PointState::kOccluded, message.occluded());
  put(credo::PointState::kSeenThrough, message.seen_through());
  put(credo::PointState::kUnmeasured, message.no_depth());
  put(credo::PointState::kOutOfView, message.out_of_view());
  why.visible_share = message.visible_share();
  why.news = message.news();
  why.moved = message.moved();
  why.bounded = message.bounded();
  return why;
}

credo::BeliefSummary summary_of(credo::msg::Belief const& belief) {
  credo::BeliefSummary summary;
  summary.frame = credo::FrameIndex{belief.frame()};
  summary.stamp_ns = belief.stamp_ns();
  summary.segmented_with = credo::FrameIndex{belief.segmented_with()};
  summary.T_world_camera = matrix_of<4>(belief.T_world_camera());
  for (credo::msg::FloorPlane const& floor : belief.floor()) {
    summary.floor = {vector_of(floor.normal_world()),
                     floor.height_m(),
                     floor.point_count(),
                     floor.probability(),
                     floor.log_odds(),
                     evidence_of(floor.evidence()),
                     account_of(floor.why())};
  }
  for (credo::msg::WallSegment const& wall : belief.walls()) {
    summary.walls.push_back({wall.wall_id(), vector_of(wall.segment_start_world_m()),
                             vector_of(wall.segment_end_world_m()), vector_of(wall.normal_world()),
                             wall.point_count(), label_of(wall.label()), wall.probability(),
                             wall.log_odds(), evidence_of(wall.evidence()),
                             account_of(wall.why())});
  }
  for (credo::msg::KnownObject const& object : belief.objects()) {
    credo::ObjectSummary entry;
    entry.id = object.object_id();
    entry.type = object.type();
    entry.probability = object.probability();
    entry.position_m = vector_of(object.position_world_m());
    entry.orientation.coeffs() = vector_of(object.orientation_world_xyzw());
    entry.covariance = matrix_of<6>(object.covariance());
    entry.evidence = evidence_of(object.evidence());
    entry.label = label_of(object.label());
    entry.log_odds = object.log_odds();
    entry.why = account_of(object.why());
    summary.objects.push_back(entry);
  }
  for (credo::msg::StuffItem const& stuff : belief.stuff()) {
    summary.stuff.push_back({stuff.stuff_id(),
                             stuff.probability(),
                             stuff.history_count(),
                             stuff.pixel_count(),
                             vector_of(stuff.centroid_world_m()),
                             vector_of(stuff.min_world_m()),
                             vector_of(stuff.max_world_m()),
                             evidence_of(stuff.evidence()),
                             label_of(stuff.label()),
                             stuff.log_odds(),
                             account_of(stuff.why()),
                             {stuff.joined_ids().begin(), stuff.joined_ids().end()}});
  }
  return summary;
}

dds::DomainParticipant* loopback_participant() {
  dds::DomainParticipantQos qos;
  auto udp = std::make_shared<rtps::UDPv4TransportDescriptor>();
  udp->interfaceWhiteList.emplace_back("127.0.0.1");
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(udp);
  return dds::DomainParticipantFactory::get_instance()->create_participant(0, qos);
}

int read_one(std::string const& topic_name, double timeout_s) {
  dds::DomainParticipant* participant = loopback_participant();
  if (participant == nullptr) {
    std::cerr << "Fast DDS does not start on the loopback\n";
    return 2;
  }
  dds::TypeSupport const type(new credo::msg::BeliefPubSubType());
  type.register_type(participant);
  dds::Topic* topic =
      participant->create_topic(topic_name, type.get_type_name(), dds::TOPIC_QOS_DEFAULT);
  dds::Subscriber* subscriber = participant->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT);
  dds::DataReaderQos qos;
  qos.reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
  qos.durability().kind = dds::TRANSIENT_LOCAL_DURABILITY_QOS;
  dds::DataReader* reader = subscriber->create_datareader(topic, qos);

  auto const end = std::chrono::steady_clock::now() + std::chrono::duration<double>(timeout_s);
  bool read = false;
  while (!read && std::chrono::steady_clock::now() < end) {
    reader->wait_for_unread_message({0, 200'000'000});
    credo::msg::Belief belief;
    dds::SampleInfo info;
    if (reader->take_next_sample(&belief, &info) ==
            eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK &&
        info.valid_data) {
      std::cout << credo::belief_json(summary_of(belief)) << '\n';
      read = true;
    }
  }
  participant->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(participant);
  return read ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "Usage: credo_fastdds_reader TOPIC TIMEOUT_S\n";
    return 2;
  }
  return read_one(argv[1], std::atof(argv[2]));
}
