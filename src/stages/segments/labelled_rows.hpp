#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/grid.hpp"
#include "stages/segments/label_runs.hpp"

namespace credo::segments {

/// Pixels of a row, side by side, of one label; as many as there are.
struct LabelRun {
  int begin = 0;
  int end = 0;
  std::int32_t label = 0;
};

/// An image of labels as the runs of its rows: a hundredth of its memory, for who goes through it
/// more than once.
class LabelledRows {
public:
  explicit LabelledRows(Grid<std::int32_t> const& labels) {
    LabelRuns ends(labels.width());
    begins_.reserve(static_cast<std::size_t>(labels.height()) + 1);
    begins_.push_back(0);
    for (int v = 0; v < labels.height(); ++v) {
      std::span<std::int32_t const> const row = labels.row(v);
      ends.find(row);
      for (std::size_t begin = 0, end = 0; begin < row.size(); begin = end) {
        end = ends.end(begin);
        runs_.push_back({static_cast<int>(begin), static_cast<int>(end), row[begin]});
      }
      begins_.push_back(runs_.size());
    }
  }

  /// From the left, without gaps.
  [[nodiscard]] std::span<LabelRun const> row(int v) const {
    auto const i = static_cast<std::size_t>(v);
    return std::span(runs_).subspan(begins_[i], begins_[i + 1] - begins_[i]);
  }

private:
  std::vector<LabelRun> runs_;
  /// Of each row the number of its first run; then that of all.
  std::vector<std::size_t> begins_;
};

}  // namespace credo::segments
