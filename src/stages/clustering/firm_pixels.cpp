#include "stages/clustering/firm_pixels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace credo {
namespace {

constexpr std::size_t kShareOfLargest = 10;

struct Piece {
  LabelCode label = 0;
  std::size_t size_px = 0;
};

/// Numbers from 1 of what holds together; 0 where there is no stuff.
class Pieces {
public:
  Pieces(Grid<float> const& depth_m, LabelMap const& labels)
      : depth_m_(depth_m), labels_(labels), number_(labels.width(), labels.height()) {
    for (std::size_t i = 0; i < labels.size(); ++i) {
      if (is_stuff(labels[i]) && number_[i] == 0) {
        pieces_.push_back({labels[i], fill(labels.pixel(i))});
      }
    }
  }

  [[nodiscard]] Piece const* piece(std::size_t pixel) const {
    return number_[pixel] > 0 ? &pieces_[number_[pixel] - 1] : nullptr;
  }
  [[nodiscard]] std::vector<Piece> const& all() const { return pieces_; }

private:
  std::size_t fill(Pixel start) {
    constexpr std::array<Pixel, 4> kSteps = {{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
    auto const number = static_cast<std::uint32_t>(pieces_.size() + 1);
    queue_.assign(1, start);
    number_[start] = number;
    for (std::size_t i = 0; i < queue_.size(); ++i) {
      Pixel const p = queue_[i];
      for (Pixel const step : kSteps) {
        Pixel const q{p.u + step.u, p.v + step.v};
        if (labels_.contains(q) && number_[q] == 0 && hold_together(p, q)) {
          number_[q] = number;
          queue_.push_back(q);
        }
      }
    }
    return queue_.size();
  }

  [[nodiscard]] bool hold_together(Pixel p, Pixel q) const {
    float const a_m = depth_m_[p];
    float const b_m = depth_m_[q];
    // |1/a - 1/b| without a division.
    return labels_[p] == labels_[q] && std::abs(a_m - b_m) < kFirm_per_m * a_m * b_m;
  }

  Grid<float> const& depth_m_;
  LabelMap const& labels_;
  Grid<std::uint32_t> number_;
  std::vector<Piece> pieces_;
  std::vector<Pixel> queue_;
};

}  // namespace

Grid<std::uint8_t> firm_pixels(Grid<float> const& depth_m, LabelMap const& labels) {
  Pieces const pieces(depth_m, labels);
  std::vector<std::size_t> largest(kMaxStuff, 0);
  for (Piece const& piece : pieces.all()) {
    std::size_t& most = largest[piece.label - std::size_t{kFirstStuff}];
    most = std::max(most, piece.size_px);
  }
  Grid<std::uint8_t> firm(labels.width(), labels.height());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    Piece const* const piece = pieces.piece(i);
    firm[i] = piece != nullptr && kShareOfLargest * piece->size_px >=
                                      largest[piece->label - std::size_t{kFirstStuff}]
                  ? 1
                  : 0;
  }
  return firm;
}

}  // namespace credo
