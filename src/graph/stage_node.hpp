#pragma once

#include <oneapi/tbb/flow_graph.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <utility>

#include "graph/bounded_queue.hpp"
#include "graph/duration_histogram.hpp"
#include "graph/job.hpp"
#include "graph/pipeline_config.hpp"

namespace credo {

/// A bounded queue between two stages that wakes whom its changes concern.
struct Edge {
  Edge(std::string edge_name, EdgeConfig const& config);

  /// Into room reserved before.
  void push(JobPtr job);

  std::string name;
  BoundedQueue<JobPtr> queue;
  // Set by the nodes at its ends; none where no node is.
  std::function<void()> wake_reader = [] {};
  std::function<void()> wake_writer = [] {};
};

/// One stage of the graph: takes jobs from one edge, works on them, puts them on the next.
///
/// Up to `concurrency` jobs are in work at once, and leave in the order they came. A job is begun
/// only when its place on the next edge is certain, so no worker ever waits: a full edge holds the
/// stage back until its reader takes a job and wakes it. The node itself carries no data. Each of
/// its messages means "see whether a job can be begun", and whatever makes that possible (a job
/// came, room came, a job left) sends one.
class StageNode {
public:
  using Work = std::function<void(Job&)>;
  using Ready = std::function<bool(Job const&)>;

  /// `work` must not throw. A job waits at the head of the queue until `ready`; whatever makes it
  /// ready then calls `wake`. `out` is none for the last stage. Edges and graph outlive the node's
  /// last message.
  StageNode(
      tbb::flow::graph& graph, std::string name, std::size_t concurrency, Edge& in, Edge* out,
      Work work, Ready ready = [](Job const&) { return true; });
  StageNode(StageNode const&) = delete;
  StageNode& operator=(StageNode const&) = delete;
  StageNode(StageNode&&) = delete;
  StageNode& operator=(StageNode&&) = delete;
  ~StageNode() = default;

  /// See whether a job can be begun. Any thread, but never from within `work`: tasks made there
  /// belong to the frame in work, and may be run by a thread that waits inside it.
  void wake() { node_.try_put({}); }
  /// From now on `other` is woken after each job, because this one's work may make its head ready.
  void wakes(StageNode& other) { also_wakes_ = &other; }

  [[nodiscard]] std::string const& name() const { return name_; }
  /// Time spent on each frame that was good when it came. Any thread.
  [[nodiscard]] DurationQuantiles durations() const;

private:
  void advance();
  std::pair<JobPtr, std::uint64_t> begin();
  void work_on(Job& job);
  void finish(JobPtr job, std::uint64_t ticket);

  std::string name_;
  std::size_t concurrency_;
  Edge& in_;
  Edge* out_;
  Work work_;
  Ready ready_;
  StageNode* also_wakes_ = nullptr;

  mutable std::mutex mutex_;
  /// Jobs begun, and jobs passed on; the difference is in work or waits in `finished_`.
  std::uint64_t begun_ = 0;
  std::uint64_t passed_on_ = 0;
  std::map<std::uint64_t, JobPtr> finished_;
  DurationHistogram durations_;

  tbb::flow::function_node<tbb::flow::continue_msg> node_;
};

}  // namespace credo
