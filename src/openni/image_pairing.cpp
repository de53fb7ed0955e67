#include "openni/image_pairing.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace credo {
namespace {

/// Enough to find the one nearest to a depth image that came a little late.
constexpr std::size_t kColorsKept = 4;

}  // namespace

void ImagePairing::add(ColorImage color) {
  colors_.push_back(std::move(color));
  if (colors_.size() > kColorsKept) {
    colors_.erase(colors_.begin());
  }
}

void ImagePairing::add(DepthImage depth) {
  if (waiting_) {
    done_ = paired(*std::exchange(waiting_, std::nullopt));
  }
  waiting_ = std::move(depth);
}

std::optional<ImagePair> ImagePairing::take() {
  if (done_) {
    return std::exchange(done_, std::nullopt);
  }
  if (!waiting_) {
    return std::nullopt;
  }
  // Colours come in order: once one is not older than the depth, no nearer one follows but the
  // next.
  bool const met = std::ranges::any_of(
      colors_, [&](ColorImage const& color) { return color.stamp_ns >= waiting_->stamp_ns; });
  return met || !color_expected_ ? take_now() : std::nullopt;
}

std::optional<ImagePair> ImagePairing::take_now() {
  if (done_) {
    return std::exchange(done_, std::nullopt);
  }
  if (!waiting_) {
    return std::nullopt;
  }
  return paired(*std::exchange(waiting_, std::nullopt));
}

void ImagePairing::clear() {
  colors_.clear();
  waiting_.reset();
  done_.reset();
}

ImagePair ImagePairing::paired(DepthImage depth) {
  auto const distance_ns = [&](ColorImage const& color) {
    return std::abs(color.stamp_ns - depth.stamp_ns);
  };
  auto const nearest = std::ranges::min_element(colors_, {}, distance_ns);
  bool const near = nearest != colors_.end() && distance_ns(*nearest) <= kNear.count();
  return {std::move(depth), near ? nearest->image : Grid<Rgb>()};
}

}  // namespace credo
