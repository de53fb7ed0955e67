#pragma once

#include <cstdint>

#include "core/label.hpp"
#include "geometry/sampled_cells.hpp"

namespace credo {

/// Pixels of one label of stuff, side by side in a row.
struct StuffRun {
  PixelRun pixels;
  LabelCode label = kFirstStuff;
  /// Whether they hold together with most of their label; see firm_runs.
  bool is_firm = true;
  /// Of the piece that they belong to; 0 where firm_runs was not asked.
  std::uint32_t piece_px = 0;
};

}  // namespace credo
