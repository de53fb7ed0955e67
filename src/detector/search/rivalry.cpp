#include "detector/search/rivalry.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace credo {
namespace {

constexpr float kMostLead = 6.0F;
/// Candidates explain the same when they share so much of what the smaller one explains.
constexpr double kSameShare = 0.4;
/// One that is so unlikely is nobody's rival.
constexpr float kLeastLogOdds = -5.0F;
/// Every third pixel of every third row tells how much two share.
constexpr std::uint32_t kStep_px = 3;

struct Entry {
  std::size_t object = 0;
  std::size_t candidate = 0;
  float log_odds = 0.0F;
  std::vector<std::uint32_t> pixels;
};

std::vector<std::uint32_t> thinned(std::vector<std::uint32_t> const& pixels,
                                   std::uint32_t width_px) {
  std::vector<std::uint32_t> kept;
  for (std::uint32_t const pixel : pixels) {
    if (pixel % width_px % kStep_px == 0 && pixel / width_px % kStep_px == 0) {
      kept.push_back(pixel);
    }
  }
  return kept;
}

bool explain_the_same(Entry const& a, Entry const& b) {
  if (a.pixels.empty() || b.pixels.empty() || a.pixels.back() < b.pixels.front() ||
      b.pixels.back() < a.pixels.front()) {
    return false;
  }
  std::size_t common = 0;
  for (auto i = a.pixels.begin(), j = b.pixels.begin();
       i != a.pixels.end() && j != b.pixels.end();) {
    if (*i == *j) {
      ++common;
      ++i;
      ++j;
    } else if (*i < *j) {
      ++i;
    } else {
      ++j;
    }
  }
  return static_cast<double>(common) >=
         kSameShare * static_cast<double>(std::min(a.pixels.size(), b.pixels.size()));
}

std::vector<Entry> entries_of(std::vector<ObjectCandidates> const& objects,
                              std::uint32_t width_px) {
  std::vector<Entry> entries;
  for (std::size_t o = 0; o < objects.size(); ++o) {
    for (std::size_t c = 0; c < objects[o].candidates.size(); ++c) {
      Verification const& verification = objects[o].candidates[c].verification;
      if (verification.log_odds > kLeastLogOdds) {
        entries.push_back(
            {o, c, verification.log_odds, thinned(verification.explained_px, width_px)});
      }
    }
  }
  return entries;
}

}  // namespace

std::vector<std::vector<Lead>> leads_of(std::vector<ObjectCandidates> const& objects,
                                        int width_px) {
  std::vector<std::vector<Lead>> leads;
  leads.reserve(objects.size());
  for (ObjectCandidates const& object : objects) {
    leads.emplace_back(object.candidates.size());
  }
  std::vector<Entry> const entries = entries_of(objects, static_cast<std::uint32_t>(width_px));
  auto const bound = [](float& lead, float value) {
    lead = std::clamp(std::min(lead, value), -kMostLead, kMostLead);
  };
  for (std::size_t i = 0; i < entries.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!explain_the_same(entries[i], entries[j])) {
        continue;
      }
      bool const own = entries[i].object == entries[j].object;
      Lead& of_i = leads[entries[i].object][entries[i].candidate];
      Lead& of_j = leads[entries[j].object][entries[j].candidate];
      float const ahead = entries[i].log_odds - entries[j].log_odds;
      bound(own ? of_i.over_own : of_i.over_others, ahead);
      bound(own ? of_j.over_own : of_j.over_others, -ahead);
    }
  }
  return leads;
}

float probability_among(float log_odds, Lead const& lead) {
  // Logistic regression on made table tops; see docs/detection.md.
  float const x = -2.6F + 1.2F * log_odds + 0.3F * lead.over_own + 0.4F * lead.over_others;
  return 1.0F / (1.0F + std::exp(-x));
}

}  // namespace credo
