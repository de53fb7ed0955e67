#include "graph/pipeline_config.hpp"

namespace credo {

FieldList fields(EdgeConfig& config) {
  return {
      {"capacity", &config.capacity, {1, 1000}, "frames", "most frames that wait here at once"},
      choice("overflow", config.overflow, {"wait", "drop_oldest"},
             "one frame too many: wait for room, or drop the oldest that waits here"),
  };
}

FieldList fields(EdgesConfig& config) {
  return {
      section("capture_normals", fields(config.capture_normals), "frames not yet begun"),
      section("normals_detection", fields(config.normals_detection), "frames with normals"),
      section("detection_planes", fields(config.detection_planes), "frames with known objects"),
      section("planes_clustering", fields(config.planes_clustering), "frames with floor and walls"),
      section("clustering_fusion", fields(config.clustering_fusion), "finished segmentations"),
      section("fusion_encoding", fields(config.fusion_encoding), "beliefs"),
      section("encoding_sink", fields(config.encoding_sink), "results ready to be written"),
  };
}

FieldList fields(GraphConfig& config) {
  return {
      {"threads", &config.threads, {0, 256}, "", "worker threads; 0 = one for each core"},
      choice("belief_seen", config.belief_seen, {"lagged", "newest"},
             "belief a frame is segmented with: after frame n - belief_lag, or the newest (live)"),
      {"belief_lag",
       &config.belief_lag,
       {1, 64},
       "frames",
       "how far behind a frame the belief is that it is segmented with; 1 allows no overlap"},
      {"max_consecutive_failures",
       &config.max_consecutive_failures,
       {1, 1000000},
       "frames",
       "so many failed frames in a row end the run"},
      section("edges", fields(config.edges), "the bounded queues between the stages"),
  };
}

FieldList fields(PipelineConfig& config) {
  return {
      section("capture", fields(config.capture), "what recordings do not say about themselves"),
      section("pose", fields(config.pose), "camera poses and the level world"),
      section("sensor", fields(config.sensor), "a live sensor, opened through OpenNI2"),
      section("sim", fields(config.sim), "what a simulated scene's camera is like"),
      section("normals", fields(config.normals), "one normal per pixel"),
      section("detector", fields(config.detector), "the black box that finds known objects"),
      section("detection", fields(config.detection), "what of its answers the belief takes"),
      section("region_growing", fields(config.region_growing), "which points are known objects'"),
      section("segments", fields(config.segments), "surfaces that are one thing each"),
      section("planes", fields(config.planes), "floor and walls"),
      section("clustering", fields(config.clustering), "stuff: what is neither plane nor object"),
      section("fusion", fields(config.fusion), "segmentations into the belief"),
      section("graph", fields(config.graph), "how the stages run side by side"),
      section("dds", fields(config.dds), "where the belief is published, and looked for"),
  };
}

}  // namespace credo
