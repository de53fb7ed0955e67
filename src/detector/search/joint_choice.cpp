#include "detector/search/joint_choice.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace credo {
namespace {

std::size_t common(std::vector<std::uint32_t> const& a, std::vector<std::uint32_t> const& b) {
  std::size_t count = 0;
  for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end();) {
    if (*i < *j) {
      ++i;
    } else if (*j < *i) {
      ++j;
    } else {
      ++count;
      ++i;
      ++j;
    }
  }
  return count;
}

/// What two poses lose of their worth by each other.
double loss_of(Explanation const& a, Explanation const& b) {
  auto const shared = static_cast<double>(common(a.pixels, b.pixels));
  if (shared == 0.0) {
    return 0.0;
  }
  return shared * (a.log_odds / static_cast<double>(a.pixels.size()) +
                   b.log_odds / static_cast<double>(b.pixels.size()));
}

/// A choice that is changed one pose at a time.
class Choice {
public:
  explicit Choice(std::vector<Explanation> const& explanations)
      : explanations_(explanations),
        in_(explanations.size(), false),
        losses_(explanations.size() * explanations.size(), 0.0) {
    for (std::size_t i = 0; i < explanations.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        losses_[i * in_.size() + j] = losses_[j * in_.size() + i] =
            loss_of(explanations[i], explanations[j]);
      }
    }
  }

  /// What the choice would be worth more with `i` in it.
  [[nodiscard]] double gain(std::size_t i) const {
    double gain = explanations_[i].log_odds;
    for (std::size_t j = 0; j < in_.size(); ++j) {
      gain -= in_[j] && j != i ? losses_[i * in_.size() + j] : 0.0;
    }
    return gain;
  }
  /// Whether another pose of its object is in.
  [[nodiscard]] std::optional<std::size_t> rival(std::size_t i) const {
    for (std::size_t j = 0; j < in_.size(); ++j) {
      if (in_[j] && j != i && explanations_[j].object == explanations_[i].object) {
        return j;
      }
    }
    return std::nullopt;
  }

  /// The change that betters the choice most; false where none does.
  bool step() {
    double best = 1e-9;
    std::optional<std::size_t> in;
    std::optional<std::size_t> out;
    for (std::size_t i = 0; i < in_.size(); ++i) {
      if (in_[i]) {
        consider(-gain(i), {}, i, best, in, out);
        continue;
      }
      if (auto const other = rival(i)) {
        consider(swap_gain(i, *other), i, *other, best, in, out);
        continue;
      }
      consider(gain(i), i, {}, best, in, out);
      for (std::size_t j = 0; j < in_.size(); ++j) {
        if (in_[j]) {
          consider(swap_gain(i, j), i, j, best, in, out);
        }
      }
    }
    if (in) {
      in_[*in] = true;
    }
    if (out) {
      in_[*out] = false;
    }
    return in || out || make_room();
  }

  [[nodiscard]] std::vector<std::size_t> chosen() const {
    std::vector<std::size_t> positions;
    for (std::size_t i = 0; i < in_.size(); ++i) {
      if (in_[i]) {
        positions.push_back(i);
      }
    }
    return positions;
  }

private:
  /// Adds a pose while another one, `j`, gives way to another of its object, `k`.
  bool make_room() {
    for (std::size_t i = 0; i < in_.size(); ++i) {
      if (in_[i] || rival(i)) {
        continue;
      }
      for (std::size_t j = 0; j < in_.size(); ++j) {
        if (!in_[j] || losses_[i * in_.size() + j] == 0.0) {
          continue;
        }
        for (std::size_t k = 0; k < in_.size(); ++k) {
          if (k == j || explanations_[k].object != explanations_[j].object) {
            continue;
          }
          double const moved = swap_gain(k, j);
          double const added = gain(i) + losses_[i * in_.size() + j] - losses_[i * in_.size() + k];
          if (moved + added > 1e-9) {
            in_[j] = false;
            in_[k] = true;
            in_[i] = true;
            return true;
          }
        }
      }
    }
    return false;
  }

  /// Of `i` coming in for `j`.
  [[nodiscard]] double swap_gain(std::size_t i, std::size_t j) const {
    return gain(i) + losses_[i * in_.size() + j] - gain(j);
  }
  static void consider(double gain, std::optional<std::size_t> coming,
                       std::optional<std::size_t> going, double& best,
                       std::optional<std::size_t>& in, std::optional<std::size_t>& out) {
    if (gain > best) {
      best = gain;
      in = coming;
      out = going;
    }
  }

  std::vector<Explanation> const& explanations_;
  std::vector<bool> in_;
  std::vector<double> losses_;
};

}  // namespace

double worth_of(std::vector<Explanation> const& explanations,
                std::vector<std::size_t> const& chosen) {
  double worth = 0.0;
  for (std::size_t a = 0; a < chosen.size(); ++a) {
    worth += explanations[chosen[a]].log_odds;
    for (std::size_t b = 0; b < a; ++b) {
      worth -= loss_of(explanations[chosen[a]], explanations[chosen[b]]);
    }
  }
  return worth;
}

std::vector<std::size_t> best_choice(std::vector<Explanation> const& explanations) {
  Choice choice(explanations);
  while (choice.step()) {
  }
  return choice.chosen();
}

}  // namespace credo
