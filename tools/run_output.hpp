#pragma once

#include <string>

#include "core/outline.hpp"
#include "dds/belief_publisher.hpp"
#include "graph/run_sink.hpp"
#include "io/run_folder.hpp"
#include "progress.hpp"
#include "stages/capture/level_watch.hpp"

namespace credo {

/// What `--dump` asks for.
struct Dump {
  bool labels = false;
  bool pictures = false;
};

/// A sink that writes into `folder` and publishes on DDS where these are not null, and shows
/// `progress`; all three, and `outlines` (known objects, for pictures), outlive it. `source` is its
/// URI, for the lifecycle. What `watch` finds, where it is not null, is logged and told there. A
/// frame's images are written before its line, and that before the belief
/// is published, so that whoever sees one finds the other.
RunSink run_output(RunFolder* folder, BeliefPublisher* publisher, Dump const& dump,
                   Outlines const& outlines, Progress& progress, std::string const& source,
                   LevelWatch* watch);

}  // namespace credo
