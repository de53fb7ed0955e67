#include "graph/pipeline.hpp"

#include <oneapi/tbb/flow_graph.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "graph/belief_trail.hpp"
#include "graph/frame_reader.hpp"
#include "graph/job.hpp"
#include "graph/ledger.hpp"
#include "graph/stage_node.hpp"

namespace credo {
namespace {

constexpr auto kMetricsInterval = std::chrono::seconds(1);

/// What the bodies of the nodes do with a job. None of them throws.
class Bodies {
public:
  Bodies(Stages const& stages, RunSink const& sink, GraphConfig const& config,
         BeliefPtr const& prior)
      : stages_(stages),
        encode_(sink.encode),
        config_(config),
        trail_(prior, static_cast<std::size_t>(config.belief_lag)),
        ledger_(sink, config.max_consecutive_failures) {}

  Ledger& ledger() { return ledger_; }

  void normals(Job& job) {
    guarded("normals", job, [&] { job.normals = stages_.normals(*job.frame); });
  }

  /// True once the belief that the frame is to be segmented with is there.
  [[nodiscard]] bool belief_is_there(Job const& job) const {
    return !job.alive() || config_.belief_seen == BeliefSeen::kNewest ||
           trail_.counted(frame_seen(job));
  }

  void detection(Job& job) {
    guarded("detection", job, [&] {
      BeliefPtr const seen = config_.belief_seen == BeliefSeen::kNewest
                                 ? trail_.newest()
                                 : trail_.after(frame_seen(job));
      job.segmentation = stages_.detection(*job.frame, job.normals, *seen);
    });
  }

  void planes(Job& job) {
    guarded("planes", job, [&] {
      job.segmentation = stages_.planes(*job.frame, job.normals, std::move(job.segmentation));
    });
  }

  void clustering(Job& job) {
    guarded("clustering", job, [&] {
      job.segmentation = stages_.clustering(*job.frame, job.normals, std::move(job.segmentation));
      job.normals = {};
    });
  }

  void fusion(Job& job) {
    guarded("fusion", job, [&] {
      job.belief =
          std::make_shared<BeliefState const>(stages_.fusion(*trail_.newest(), job.segmentation));
    });
    trail_.count_lost_until(FrameIndex{number(job.index) - 1});
    trail_.count(job.index, job.belief != nullptr ? job.belief : trail_.newest());
  }

  void encoding(Job& job) {
    if (!job.alive() || ledger_.ended()) {
      return;
    }
    try {
      auto segmentation = std::make_shared<Segmentation const>(std::move(job.segmentation));
      job.delivery = encode_({job.captured, job.frame, std::move(segmentation), job.belief});
    } catch (...) {
      // The belief has moved already, so this is more than a lost frame: it ends the run, in order.
      job.delivery = [error = std::current_exception()] { std::rethrow_exception(error); };
    }
  }

  void sink(Job& job) {
    ledger_.settle(job);
    auto const now = Job::Clock::now();
    if (tell_metrics && now - told_metrics_ >= kMetricsInterval) {
      told_metrics_ = now;
      tell_metrics(ledger_.so_far());
    }
  }

  /// Set before the first job, where someone asks for metrics.
  std::function<void(RunMetrics)> tell_metrics;

private:
  /// A stage that throws costs its frame.
  template <typename Work>
  void guarded(char const* stage, Job& job, Work const& work) {
    if (!job.alive() || ledger_.ended()) {
      return;
    }
    try {
      work();
    } catch (std::exception const& error) {
      job.fail(stage, error.what());
    } catch (...) {
      job.fail(stage, "threw what is no std::exception");
    }
  }

  /// The frame whose belief this one is segmented with. Frames dropped just before it are counted
  /// only together with it, but moved nothing: the belief before them is the same.
  [[nodiscard]] FrameIndex frame_seen(Job const& job) const {
    return std::min(FrameIndex{number(job.index) - config_.belief_lag}, job.last_settled_before());
  }

  Stages const& stages_;
  std::function<Delivery(FrameResult const&)> const& encode_;
  GraphConfig const& config_;
  BeliefTrail trail_;
  Ledger ledger_;
  Job::Clock::time_point told_metrics_ = Job::Clock::now();
};

/// The whole graph: seven edges and the stages between them.
struct Pipeline {
  Pipeline(tbb::flow::graph& graph, Bodies& bodies, EdgesConfig const& config,
           std::size_t parallel);

  Edge capture_normals;
  Edge normals_detection;
  Edge detection_planes;
  Edge planes_clustering;
  Edge clustering_fusion;
  Edge fusion_encoding;
  Edge encoding_sink;

  StageNode normals;
  StageNode detection;
  StageNode planes;
  StageNode clustering;
  StageNode fusion;
  StageNode encoding;
  StageNode sink;
};

constexpr std::size_t kSerial = 1;

// clang-format off
Pipeline::Pipeline(tbb::flow::graph& graph, Bodies& bodies, EdgesConfig const& config,
                   std::size_t parallel)
    : capture_normals("capture_normals", config.capture_normals),
      normals_detection("normals_detection", config.normals_detection),
      detection_planes("detection_planes", config.detection_planes),
      planes_clustering("planes_clustering", config.planes_clustering),
      clustering_fusion("clustering_fusion", config.clustering_fusion),
      fusion_encoding("fusion_encoding", config.fusion_encoding),
      encoding_sink("encoding_sink", config.encoding_sink),
      normals(graph, "normals", parallel, capture_normals, &normals_detection,
              [&](Job& job) { bodies.normals(job); }),
      detection(graph, "detection", kSerial, normals_detection, &detection_planes,
                [&](Job& job) { bodies.detection(job); },
                [&](Job const& job) { return bodies.belief_is_there(job); }),
      planes(graph, "planes", parallel, detection_planes, &planes_clustering,
             [&](Job& job) { bodies.planes(job); }),
      clustering(graph, "clustering", parallel, planes_clustering, &clustering_fusion,
                 [&](Job& job) { bodies.clustering(job); }),
      fusion(graph, "fusion", kSerial, clustering_fusion, &fusion_encoding,
             [&](Job& job) { bodies.fusion(job); }),
      encoding(graph, "encoding", parallel, fusion_encoding, &encoding_sink,
               [&](Job& job) { bodies.encoding(job); }),
      sink(graph, "sink", kSerial, encoding_sink, nullptr,
           [&](Job& job) { bodies.sink(job); }) {
  fusion.wakes(detection);  // with the belief that it waits for
}
// clang-format on

/// With the times of the stages and the state of the queues.
RunMetrics measured(RunMetrics counts, FrameReader const& reader, Pipeline const& pipeline) {
  counts.stages.emplace_back("capture", reader.durations());
  for (StageNode const* node :
       {&pipeline.normals, &pipeline.detection, &pipeline.planes, &pipeline.clustering,
        &pipeline.fusion, &pipeline.encoding, &pipeline.sink}) {
    counts.stages.emplace_back(node->name(), node->durations());
  }
  for (Edge const* edge :
       {&pipeline.capture_normals, &pipeline.normals_detection, &pipeline.detection_planes,
        &pipeline.planes_clustering, &pipeline.clustering_fusion, &pipeline.fusion_encoding,
        &pipeline.encoding_sink}) {
    QueueStats const stats = edge->queue.stats();
    counts.queues.emplace_back(edge->name, QueueMetrics{stats.capacity, stats.peak, stats.dropped});
  }
  return counts;
}

}  // namespace

RunReport run_pipeline(FrameSource& source, Stages const& stages, RunSink const& sink,
                       GraphConfig const& config, BeliefPtr const& prior, Workers& workers,
                       std::stop_token const& stop) {
  Bodies bodies(stages, sink, config, prior);
  Ledger& ledger = bodies.ledger();
  // A graph runs its nodes in the arena that it was made in.
  std::optional<tbb::flow::graph> graph;
  workers.execute([&] { graph.emplace(); });
  Pipeline pipeline(*graph, bodies, config.edges, static_cast<std::size_t>(workers.threads()));

  FrameReader reader(source);
  if (sink.metrics) {
    bodies.tell_metrics = [&](RunMetrics counts) {
      sink.metrics(measured(std::move(counts), reader, pipeline));
    };
  }
  while (!stop.stop_requested() && !ledger.ended()) {
    JobPtr job = reader.next();
    if (job == nullptr) {
      break;
    }
    pipeline.capture_normals.queue.wait_and_reserve();
    pipeline.capture_normals.push(std::move(job));
  }
  ledger.wait_until_settled(reader.frames());
  graph->wait_for_all();

  RunReport report = ledger.close(!stop.stop_requested());
  if (reader.error() != nullptr) {
    report.error = reader.error();
  }
  report.metrics = measured(std::move(report.metrics), reader, pipeline);
  return report;
}

}  // namespace credo
