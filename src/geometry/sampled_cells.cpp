#include "geometry/sampled_cells.hpp"

#include <algorithm>
#include <array>

namespace credo {
namespace {

/// Points on their way to cells, as many at once as these take.
class CellFeed {
public:
  explicit CellFeed(CellSums& cells) : cells_(cells) {}

  void add(OrganizedCloud const& cloud, std::size_t begin, std::size_t end, std::size_t step) {
    for (std::size_t i = begin; i < end;) {
      std::size_t const room = CellSums::kChunk - count_;
      std::size_t const some = std::min(room, (end - i + step - 1) / step);
      copy(cloud.x.data() + i, step, some, axes_[0].data() + count_);
      copy(cloud.y.data() + i, step, some, axes_[1].data() + count_);
      copy(cloud.z.data() + i, step, some, axes_[2].data() + count_);
      count_ += some;
      i += some * step;
      if (count_ == CellSums::kChunk) {
        flush();
      }
    }
  }
  void flush() {
    cells_.add({{axes_[0].data(), count_}, {axes_[1].data(), count_}, {axes_[2].data(), count_}});
    count_ = 0;
  }

private:
  /// Steps that the compiler knows vectorise.
  static void copy(float const* from, std::size_t step, std::size_t count, float* to) {
    if (step == 1) {
      std::copy_n(from, count, to);
    } else if (step == 2) {
      copy_every<2>(from, count, to);
    } else {
      copy_every<4>(from, count, to);
    }
  }
  template <std::size_t kStep>
  static void copy_every(float const* from, std::size_t count, float* to) {
    for (std::size_t i = 0; i < count; ++i) {
      to[i] = from[i * kStep];
    }
  }

  CellSums& cells_;
  std::array<std::array<float, CellSums::kChunk>, 3> axes_;
  std::size_t count_ = 0;
};

CellSums all_cells(OrganizedCloud const& cloud, std::span<PixelRun const> runs, float spacing_m,
                   Se3 const& T_grid_camera) {
  CellSums cells(spacing_m, T_grid_camera);
  CellFeed feed(cells);
  for (auto const [begin, end] : runs) {
    feed.add(cloud, begin, end, 1);
  }
  feed.flush();
  return cells;
}

}  // namespace

CellSums sampled_cells(OrganizedCloud const& cloud, std::span<PixelRun const> runs,
                       PixelSampling const& sampling, Se3 const& T_grid_camera) {
  if (sampling.focal_px > 0.0F) {
    auto const width = static_cast<std::size_t>(cloud.width());
    CellSums cells(sampling.spacing_m, T_grid_camera);
    CellFeed feed(cells);
    for (auto const [begin, end] : runs) {
      Eigen::Vector3f const first = cloud.at(begin);
      std::size_t const v = begin / width;
      // Steps are powers of two. Of a row that is left out its own need not be known.
      if ((v & (sampling.step_px(1, first) - 1)) == 0) {
        std::size_t const step = sampling.step_px(0, first);
        std::size_t const u = begin - v * width;
        feed.add(cloud, begin + (-u & (step - 1)), end, step);
      }
    }
    feed.flush();
    if (cells.cell_count() >= kFewCells) {
      return cells;
    }
  }
  return all_cells(cloud, runs, sampling.spacing_m, T_grid_camera);
}

}  // namespace credo
