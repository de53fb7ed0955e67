#include "geometry/thinning.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace credo {
namespace {

/// The grid position of a point in one number, 21 bits an axis.
class CellGrid {
public:
  explicit CellGrid(float spacing_m) : cells_per_m_(1.0 / static_cast<double>(spacing_m)) {
    if (!(spacing_m > 0.0F) || !std::isfinite(spacing_m)) {
      throw std::logic_error("thinning: spacing_m is " + std::to_string(spacing_m));
    }
  }

  [[nodiscard]] std::uint64_t key(Eigen::Vector3f const& p) const {
    return (along_axis(p.x()) << 42U) | (along_axis(p.y()) << 21U) | along_axis(p.z());
  }

private:
  [[nodiscard]] std::uint64_t along_axis(float coordinate_m) const {
    constexpr double kHalfRange = 1 << 20;
    // Shifted to be positive before the cast, which is then the floor.
    double const cell = static_cast<double>(coordinate_m) * cells_per_m_ + kHalfRange;
    return static_cast<std::uint64_t>(std::clamp(cell, 0.0, 2.0 * kHalfRange - 1.0));
  }

  double cells_per_m_;
};

/// Numbers cells from 0 in the order in which they are first asked for. Open addressing with linear
/// probing: successive points mostly fall into the same few cells, so that the table stays in
/// cache.
class CellNumbers {
public:
  std::uint32_t number_of(std::uint64_t key) {
    if (key == last_key_) {
      return last_number_;
    }
    std::size_t slot = first_slot(key);
    while (slots_[slot].key != key && slots_[slot].key != kEmpty) {
      slot = (slot + 1) & (slots_.size() - 1);
    }
    last_key_ = key;
    if (slots_[slot].key == key) {
      last_number_ = slots_[slot].number;
      return last_number_;
    }
    last_number_ = count_++;
    slots_[slot] = {key, last_number_};
    if (2 * std::size_t{count_} > slots_.size()) {
      grow();
    }
    return last_number_;
  }

  [[nodiscard]] std::uint32_t count() const { return count_; }

private:
  // Keys have 63 bits.
  static constexpr std::uint64_t kEmpty = ~std::uint64_t{0};
  struct Slot {
    std::uint64_t key = kEmpty;
    std::uint32_t number = 0;
  };

  [[nodiscard]] std::size_t first_slot(std::uint64_t key) const {
    // Fibonacci hashing: the upper bits of the product depend on all bits of the key.
    return (key * 0x9E3779B97F4A7C15U) >>
           (64U - static_cast<unsigned>(std::countr_zero(slots_.size())));
  }

  void grow() {
    std::vector<Slot> const old = std::exchange(slots_, std::vector<Slot>(2 * slots_.size()));
    for (Slot const& entry : old) {
      if (entry.key == kEmpty) {
        continue;
      }
      std::size_t slot = first_slot(entry.key);
      while (slots_[slot].key != kEmpty) {
        slot = (slot + 1) & (slots_.size() - 1);
      }
      slots_[slot] = entry;
    }
  }

  std::vector<Slot> slots_ = std::vector<Slot>(256);
  std::uint32_t count_ = 0;
  std::uint64_t last_key_ = kEmpty;
  std::uint32_t last_number_ = 0;
};

/// Sums in double, so that the mean of a few hundred thousand points keeps a float's precision.
struct CellSum {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0.0;

  void add(Eigen::Vector3f const& p) {
    sum += p.cast<double>();
    count += 1.0;
  }
  [[nodiscard]] Eigen::Vector3f mean() const { return (sum / count).cast<float>(); }
};

/// The known cells are numbered first; the sums are those of the cells after them.
void append_thinned(PointList& result, std::span<Eigen::Vector3f const> points,
                    CellGrid const& grid, CellNumbers& numbers) {
  std::uint32_t const known_cells = numbers.count();
  std::vector<CellSum> sums;
  for (Eigen::Vector3f const& p : points) {
    if (!p.allFinite()) {
      continue;
    }
    std::uint32_t const number = numbers.number_of(grid.key(p));
    if (number < known_cells) {
      continue;
    }
    std::size_t const fresh = number - known_cells;
    if (fresh == sums.size()) {
      sums.emplace_back();
    }
    sums[fresh].add(p);
  }
  result.reserve(result.size() + sums.size());
  for (CellSum const& cell : sums) {
    result.push_back(cell.mean());
  }
}

}  // namespace

PointList thin_points(std::span<Eigen::Vector3f const> points, float spacing_m) {
  CellGrid const grid(spacing_m);
  CellNumbers numbers;
  PointList thinned;
  append_thinned(thinned, points, grid, numbers);
  return thinned;
}

PointList merged_points(PointList const& known, PointList const& added, float spacing_m) {
  CellGrid const grid(spacing_m);
  CellNumbers numbers;
  for (Eigen::Vector3f const& p : known) {
    if (p.allFinite()) {
      numbers.number_of(grid.key(p));
    }
  }
  PointList merged = known;
  append_thinned(merged, added, grid, numbers);
  return merged;
}

}  // namespace credo
