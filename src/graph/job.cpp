#include "graph/job.hpp"

#include <utility>

namespace credo {
namespace {

LostFrames lost_from(Job& job, std::string const& edge) {
  if (job.failure.has_value()) {
    return {job.index, job.index, false, std::move(job.failure->reason),
            std::move(job.failure->message)};
  }
  return {job.index, job.index, true, edge + "_full", "the queue " + edge + " was full"};
}

/// One entry for any number of drops, so that a stage that hangs costs no memory a frame.
void append(std::vector<LostFrames>& all, LostFrames lost) {
  if (!all.empty() && all.back().dropped && lost.dropped && all.back().reason == lost.reason) {
    all.back().last = lost.last;
  } else {
    all.push_back(std::move(lost));
  }
}

}  // namespace

void Job::fail(std::string reason, std::string message) {
  failure = FrameFailure{index, std::move(reason), std::move(message)};
  frame.reset();
  normals = {};
  segmentation = {};
}

FrameIndex Job::last_settled_before() const {
  FrameIndex const first = lost_before.empty() ? index : lost_before.front().first;
  return FrameIndex{number(first) - 1};
}

void inherit_lost(JobPtr dropped, Job& next, std::string const& edge) {
  std::vector<LostFrames> all = std::move(dropped->lost_before);
  append(all, lost_from(*dropped, edge));
  for (LostFrames& lost : next.lost_before) {
    append(all, std::move(lost));
  }
  next.lost_before = std::move(all);
}

}  // namespace credo
