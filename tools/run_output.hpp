#pragma once

#include "core/outline.hpp"
#include "graph/run_sink.hpp"
#include "io/run_folder.hpp"
#include "progress.hpp"

namespace credo {

/// What `--dump` asks for.
struct Dump {
  bool labels = false;
  bool pictures = false;
};

/// A sink that writes into `folder` where there is one and shows `progress`; both, and `outlines`
/// (known objects, for pictures), outlive it. A
/// frame's images are written before its line, so that whoever reads the line finds them.
RunSink run_output(RunFolder* folder, Dump const& dump, Outlines const& outlines,
                   Progress& progress);

}  // namespace credo
