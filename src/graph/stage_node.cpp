#include "graph/stage_node.hpp"

#include <oneapi/tbb/task_arena.h>

#include <optional>

namespace credo {

Edge::Edge(std::string edge_name, EdgeConfig const& config)
    : name(std::move(edge_name)),
      queue(
          static_cast<std::size_t>(config.capacity), config.overflow,
          [this](JobPtr dropped, JobPtr& next) { inherit_lost(std::move(dropped), *next, name); }) {
}

void Edge::push(JobPtr job) {
  queue.push(std::move(job));
  wake_reader();
}

StageNode::StageNode(tbb::flow::graph& graph, std::string name, std::size_t concurrency, Edge& in,
                     Edge* out, Work work, Ready ready)
    : name_(std::move(name)),
      concurrency_(concurrency),
      in_(in),
      out_(out),
      work_(std::move(work)),
      ready_(std::move(ready)),
      node_(graph, concurrency, [this](tbb::flow::continue_msg) {
        advance();
        return tbb::flow::continue_msg{};
      }) {
  in_.wake_reader = [this] { wake(); };
  if (out_ != nullptr) {
    out_->wake_writer = [this] { wake(); };
  }
}

void StageNode::advance() {
  auto [job, ticket] = begin();
  if (job == nullptr) {
    return;
  }
  in_.wake_writer();
  if (concurrency_ > 1) {
    wake();  // perhaps there is one more to begin, beside this one
  }
  work_on(*job);
  finish(std::move(job), ticket);
  wake();
  if (also_wakes_ != nullptr) {
    also_wakes_->wake();
  }
}

std::pair<JobPtr, std::uint64_t> StageNode::begin() {
  std::scoped_lock const lock(mutex_);
  // Also bounds `finished_` where one slow job holds back others that are done.
  if (begun_ - passed_on_ >= concurrency_) {
    return {};
  }
  if (out_ != nullptr && !out_->queue.try_reserve()) {
    return {};
  }
  std::optional<JobPtr> job =
      in_.queue.try_pop([this](JobPtr const& head) { return ready_(*head); });
  if (!job.has_value()) {
    if (out_ != nullptr) {
      out_->queue.release();
    }
    return {};
  }
  return {*std::move(job), begun_++};
}

void StageNode::work_on(Job& job) {
  bool const counts = job.alive();
  auto const start = Job::Clock::now();
  // A stage that waits for its own parallel loop must not pick up another frame's work meanwhile.
  tbb::this_task_arena::isolate([&] { work_(job); });
  auto const duration = Job::Clock::now() - start;
  if (counts) {
    std::scoped_lock const lock(mutex_);
    durations_.add(duration);
  }
}

void StageNode::finish(JobPtr job, std::uint64_t ticket) {
  std::scoped_lock const lock(mutex_);
  finished_.emplace(ticket, std::move(job));
  while (!finished_.empty() && finished_.begin()->first == passed_on_) {
    if (out_ != nullptr) {
      out_->push(std::move(finished_.begin()->second));
    }
    finished_.erase(finished_.begin());
    ++passed_on_;
  }
}

DurationQuantiles StageNode::durations() const {
  std::scoped_lock const lock(mutex_);
  return durations_.quantiles();
}

}  // namespace credo
