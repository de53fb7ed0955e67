#include "graph/run_once.hpp"

#include <exception>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "graph/frame_reader.hpp"
#include "graph/ledger.hpp"

namespace credo {
namespace {

void guarded(char const* half, Job& job, std::function<void()> const& work) {
  if (!job.alive()) {
    return;
  }
  try {
    work();
  } catch (std::exception const& error) {
    job.fail(half, error.what());
  } catch (...) {
    job.fail(half, "threw what is no std::exception");
  }
}

}  // namespace

RunReport run_once(FrameSource& source, Stages const& stages, RunSink const& sink,
                   GraphConfig const& config, BeliefPtr const& prior, std::stop_token const& stop) {
  auto const lag = config.belief_seen == BeliefSeen::kNewest
                       ? std::size_t{1}
                       : static_cast<std::size_t>(config.belief_lag);
  // beliefs[i] is the belief after frame n - lag + i; the prior stands for what came before.
  std::vector<BeliefPtr> beliefs(lag, prior);
  Ledger ledger(sink, config.max_consecutive_failures);
  FrameReader reader(source);
  while (!stop.stop_requested() && !ledger.ended()) {
    JobPtr job = reader.next();
    if (job == nullptr) {
      break;
    }
    guarded("segmentation", *job,
            [&] { job->segmentation = segment(stages, *job->frame, *beliefs.front()); });
    BeliefPtr after = beliefs.back();
    guarded("fusion", *job, [&] {
      after = std::make_shared<BeliefState const>(stages.fusion(*after, job->segmentation));
    });
    beliefs.erase(beliefs.begin());
    beliefs.push_back(after);
    if (job->alive()) {
      job->delivery = [&, after] {
        auto segmentation = std::make_shared<Segmentation const>(std::move(job->segmentation));
        sink.encode({job->captured, job->frame, std::move(segmentation), after})();
      };
    }
    ledger.settle(*job);
  }
  RunReport report = ledger.close(!stop.stop_requested());
  if (reader.error() != nullptr) {
    report.error = reader.error();
  }
  return report;
}

}  // namespace credo
