#pragma once

#include <cstdint>

#include "core/capture_config.hpp"
#include "core/dds_config.hpp"
#include "core/detector_config.hpp"
#include "core/fields.hpp"
#include "core/sensor_config.hpp"
#include "core/sim_config.hpp"
#include "graph/bounded_queue.hpp"
#include "stages/clustering/clustering.hpp"
#include "stages/detection/detection.hpp"
#include "stages/fusion/fusion.hpp"
#include "stages/normals/normals.hpp"
#include "stages/planes/planes.hpp"
#include "stages/region_growing/region_growing.hpp"
#include "stages/segments/segments.hpp"

namespace credo {

/// One bounded queue between two stages.
struct EdgeConfig {
  int capacity = 2;
  Overflow overflow = Overflow::kWait;
};
FieldList fields(EdgeConfig& config);

/// Every edge of the pipeline, named writer_reader, in the order that a frame passes them.
struct EdgesConfig {
  EdgeConfig capture_normals;
  EdgeConfig normals_detection;
  EdgeConfig detection_planes;
  EdgeConfig planes_clustering;
  EdgeConfig clustering_fusion;
  EdgeConfig fusion_encoding;
  EdgeConfig encoding_sink;
};
FieldList fields(EdgesConfig& config);

/// Which belief a frame is segmented with.
enum class BeliefSeen : std::uint8_t {
  /// The one after frame n - belief_lag: the same in every run of a recording.
  kLagged,
  /// The newest there is when the frame's turn comes (live); recorded as `segmented_with`.
  kNewest,
};

/// How the stages run side by side.
struct GraphConfig {
  /// Worker threads; 0 = one for each core.
  int threads = 0;
  BeliefSeen belief_seen = BeliefSeen::kLagged;
  /// L >= 1: frame n is segmented with the belief once frame n - L has been counted (fused, failed
  /// or dropped; those last two leave the belief as it was), the prior before that.
  int belief_lag = 2;
  /// So many frames lost in a row to failures (not to drops) end the run with an error.
  int max_consecutive_failures = 10;
  EdgesConfig edges;
};
FieldList fields(GraphConfig& config);

/// Everything a run is configured by, one section a room.
struct PipelineConfig {
  CaptureConfig capture;
  PoseConfig pose;
  SensorConfig sensor;
  SimConfig sim;
  NormalsConfig normals;
  DetectorConfig detector;
  DetectionConfig detection;
  RegionGrowingConfig region_growing;
  SegmentsConfig segments;
  PlanesConfig planes;
  ClusteringConfig clustering;
  FusionConfig fusion;
  GraphConfig graph;
  DdsConfig dds;
};
FieldList fields(PipelineConfig& config);

}  // namespace credo
