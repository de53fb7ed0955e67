// The joint choice against trying all choices.
#include "detector/search/joint_choice.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <vector>

namespace credo::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Choice = std::vector<std::size_t>;
using Explanations = std::vector<Explanation>;

std::vector<std::uint32_t> pixels(std::uint32_t first, std::uint32_t count) {
  std::vector<std::uint32_t> run(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    run[i] = first + i;
  }
  return run;
}

/// Poses on a strip of pixels, crowded enough to be in each other's way.
Explanations random_explanations(unsigned seed, std::size_t count) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<std::uint32_t> place(0, 300);
  std::uniform_int_distribution<std::uint32_t> length(10, 80);
  std::uniform_int_distribution<std::size_t> object(0, count / 2);
  std::uniform_real_distribution<double> odds(0.05, 6.0);
  Explanations explanations;
  for (std::size_t i = 0; i < count; ++i) {
    explanations.push_back({object(random), odds(random), pixels(place(random), length(random))});
  }
  return explanations;
}

bool allowed(Explanations const& explanations, Choice const& chosen) {
  std::set<std::size_t> objects;
  return std::ranges::all_of(
      chosen, [&](std::size_t i) { return objects.insert(explanations[i].object).second; });
}

double literal_worth(Explanations const& explanations, Choice const& chosen) {
  double worth = 0.0;
  for (std::size_t const i : chosen) {
    worth += explanations[i].log_odds;
  }
  for (std::size_t const i : chosen) {
    for (std::size_t const j : chosen) {
      std::set<std::uint32_t> const of_j(explanations[j].pixels.begin(),
                                         explanations[j].pixels.end());
      for (std::uint32_t const pixel : explanations[i].pixels) {
        // Pixel by pixel, what the one counts for it.
        worth -= i != j && of_j.contains(pixel)
                     ? explanations[i].log_odds / static_cast<double>(explanations[i].pixels.size())
                     : 0.0;
      }
    }
  }
  return worth;
}

double best_worth(Explanations const& explanations) {
  double best = 0.0;
  for (std::uint32_t bits = 0; bits < 1U << explanations.size(); ++bits) {
    Choice chosen;
    for (std::size_t i = 0; i < explanations.size(); ++i) {
      if ((bits >> i & 1U) != 0) {
        chosen.push_back(i);
      }
    }
    if (allowed(explanations, chosen)) {
      best = std::max(best, worth_of(explanations, chosen));
    }
  }
  return best;
}

/// All choices that one change leads to.
std::vector<Choice> neighbours(Explanations const& explanations, Choice const& chosen) {
  std::vector<Choice> all;
  for (std::size_t i = 0; i < explanations.size(); ++i) {
    if (std::ranges::find(chosen, i) != chosen.end()) {
      Choice without = chosen;
      std::erase(without, i);
      all.push_back(without);
      continue;
    }
    Choice with = chosen;
    with.push_back(i);
    all.push_back(with);
    for (std::size_t const j : chosen) {
      Choice swapped = with;
      std::erase(swapped, j);
      all.push_back(swapped);
    }
  }
  return all;
}

TEST(JointChoice, WorthCountsPixelByPixel) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    Explanations const explanations = random_explanations(seed, 5);
    for (Choice const& chosen : {Choice{}, Choice{0}, Choice{1, 3}, Choice{0, 2, 4}}) {
      EXPECT_NEAR(worth_of(explanations, chosen), literal_worth(explanations, chosen), 1e-9);
    }
  }
}

TEST(JointChoice, TwoPosesInOnePlaceAreWorthNothing) {
  Explanations const explanations = {{0, 3.0, pixels(0, 50)}, {1, 2.0, pixels(0, 50)}};
  EXPECT_NEAR(worth_of(explanations, {0, 1}), 0.0, 1e-12);
  EXPECT_THAT(best_choice(explanations), ElementsAre(0));
}

TEST(JointChoice, ASeamCostsLittle) {
  Explanations const explanations = {{0, 3.0, pixels(0, 50)}, {1, 2.0, pixels(48, 50)}};
  EXPECT_NEAR(worth_of(explanations, {0, 1}), 5.0 - 2.0 * (3.0 + 2.0) / 50.0, 1e-12);
  EXPECT_THAT(best_choice(explanations), ElementsAre(0, 1));
}

TEST(JointChoice, OneObjectIsChosenOnce) {
  Explanations const explanations = {
      {4, 1.0, pixels(0, 50)}, {4, 3.0, pixels(100, 50)}, {4, 2.0, pixels(200, 50)}};
  EXPECT_THAT(best_choice(explanations), ElementsAre(1));
}

TEST(JointChoice, OfNothingIsNothing) {
  EXPECT_THAT(best_choice({}), IsEmpty());
  EXPECT_EQ(worth_of({}, {}), 0.0);
}

// The better pose of one object gives way to its second, where another stands in the first's place.
TEST(JointChoice, APoseIsPutInAnothersPlace) {
  Explanations const explanations = {
      {0, 5.0, pixels(0, 100)}, {0, 4.5, pixels(200, 100)}, {1, 4.9, pixels(55, 100)}};
  EXPECT_THAT(best_choice(explanations), ElementsAre(1, 2));
}

class RandomChoices : public ::testing::TestWithParam<std::size_t> {};

TEST_P(RandomChoices, NoSingleChangeBettersThem) {
  for (unsigned seed = 0; seed < 150; ++seed) {
    Explanations const explanations = random_explanations(seed, GetParam());
    Choice const chosen = best_choice(explanations);
    EXPECT_TRUE(std::ranges::is_sorted(chosen));
    ASSERT_TRUE(allowed(explanations, chosen));
    double const worth = worth_of(explanations, chosen);
    for (Choice const& other : neighbours(explanations, chosen)) {
      EXPECT_FALSE(allowed(explanations, other) && worth_of(explanations, other) > worth + 1e-6)
          << seed;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, RandomChoices, ::testing::Values(3, 6, 12, 25));

// Poses that are more in each other's way than those of a frame.
TEST(JointChoice, IsSeldomWorseThanTheBestOfAll) {
  int best = 0;
  int all = 0;
  double least_share = 1.0;
  double shares = 0.0;
  for (unsigned seed = 0; seed < 120; ++seed) {
    Explanations const explanations = random_explanations(seed, 8 + seed % 4);
    double const most = best_worth(explanations);
    double const worth = worth_of(explanations, best_choice(explanations));
    EXPECT_LE(worth, most + 1e-9);
    least_share = std::min(least_share, worth / most);
    shares += worth / most;
    best += worth > most - 1e-6 ? 1 : 0;
    ++all;
  }
  RecordProperty("best_of_120", best);
  RecordProperty("least_share", std::to_string(least_share));
  EXPECT_GT(best, all * 6 / 10);
  RecordProperty("mean_share", std::to_string(shares / all));
  EXPECT_GT(least_share, 0.6);
  EXPECT_GT(shares / all, 0.9);
}

TEST(JointChoice, WhatIsFarApartIsChosenRightly) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    Explanations explanations = random_explanations(seed, 12);
    for (std::size_t i = 0; i < explanations.size(); ++i) {
      explanations[i].pixels = pixels(static_cast<std::uint32_t>(1000 * i), 30);
    }
    // The best pose of each object.
    std::map<std::size_t, double> best;
    double sum = 0.0;
    for (Explanation const& one : explanations) {
      double& most = best[one.object];
      sum += std::max(0.0, one.log_odds - most);
      most = std::max(most, one.log_odds);
    }
    EXPECT_NEAR(worth_of(explanations, best_choice(explanations)), sum, 1e-9);
  }
}

}  // namespace
}  // namespace credo::test
