#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace credo {

/// A pixel position: u to the right, v down, (0, 0) top left.
struct Pixel {
  int u = 0;
  int v = 0;
  friend bool operator==(Pixel const&, Pixel const&) = default;
};

/// Leaves values without a constructor unset where none is given: who writes all of an image need
/// not pay for zeros first.
template <typename T>
struct UnsetAllocator : std::allocator<T> {
  template <typename U>
  void construct(U* place) {
    ::new (static_cast<void*>(place)) U;
  }
  template <typename U, typename... Args>
  void construct(U* place, Args&&... args) {
    std::construct_at(place, std::forward<Args>(args)...);
  }
};

/// The one image container: width x height values, row-major, no padding.
///
/// Depth, colour, points, normals and labels are grids side by side, not structs of everything.
/// An empty grid (0 x 0) is valid. A negative size or a buffer of the wrong length throws
/// std::logic_error.
template <typename T>
class Grid {
public:
  using value_type = T;

  Grid() = default;
  Grid(int width, int height, T const& value = T{})
      : width_(width), height_(height), data_(checked_count(width, height), value) {}
  Grid(int width, int height, std::vector<T> const& data)
      : width_(width), height_(height), data_(data.begin(), data.end()) {
    if (data_.size() != checked_count(width, height)) {
      throw std::logic_error("Grid: " + std::to_string(data_.size()) + " values for " +
                             std::to_string(width) + "x" + std::to_string(height));
    }
  }

  /// Numbers in it are anything until they are written.
  [[nodiscard]] static Grid unset(int width, int height) {
    Grid grid;
    grid.data_.resize(checked_count(width, height));
    grid.width_ = width;
    grid.height_ = height;
    return grid;
  }

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] std::size_t size() const { return data_.size(); }
  [[nodiscard]] bool empty() const { return data_.empty(); }
  [[nodiscard]] bool contains(Pixel p) const {
    return p.u >= 0 && p.v >= 0 && p.u < width_ && p.v < height_;
  }
  template <typename U>
  [[nodiscard]] bool same_size(Grid<U> const& other) const {
    return width_ == other.width() && height_ == other.height();
  }

  /// Row-major position of a pixel; unchecked.
  [[nodiscard]] std::size_t index(Pixel p) const {
    return static_cast<std::size_t>(p.v) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(p.u);
  }
  [[nodiscard]] Pixel pixel(std::size_t index) const {
    auto const width = static_cast<std::size_t>(width_);
    return {static_cast<int>(index % width), static_cast<int>(index / width)};
  }

  // Unchecked, like std::vector.
  T& operator[](Pixel p) { return data_[index(p)]; }
  T const& operator[](Pixel p) const { return data_[index(p)]; }
  T& operator[](std::size_t i) { return data_[i]; }
  T const& operator[](std::size_t i) const { return data_[i]; }

  T* data() { return data_.data(); }
  T const* data() const { return data_.data(); }
  [[nodiscard]] std::span<T> row(int v) {
    return {data_.data() + index({0, v}), static_cast<std::size_t>(width_)};
  }
  [[nodiscard]] std::span<T const> row(int v) const {
    return {data_.data() + index({0, v}), static_cast<std::size_t>(width_)};
  }
  auto begin() { return data_.begin(); }
  auto end() { return data_.end(); }
  auto begin() const { return data_.begin(); }
  auto end() const { return data_.end(); }

  friend bool operator==(Grid const&, Grid const&) = default;

private:
  static std::size_t checked_count(int width, int height) {
    if (width < 0 || height < 0) {
      throw std::logic_error("Grid: negative size " + std::to_string(width) + "x" +
                             std::to_string(height));
    }
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }

  int width_ = 0;
  int height_ = 0;
  std::vector<T, UnsetAllocator<T>> data_;
};

}  // namespace credo
