#include "history/history.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <utility>

#include "history/history_names.hpp"

namespace credo {
namespace {

RunFrame run_frame(std::vector<BeliefSummary> const& run, std::size_t position) {
  constexpr double kSecondsPerNanosecond = 1e-9;
  std::int64_t const since_ns = run[position].stamp_ns - run.front().stamp_ns;
  return {position, run[position].frame, kSecondsPerNanosecond * static_cast<double>(since_ns)};
}

/// Collects what is believed of each thing, frame by frame.
class Histories {
public:
  void add(RunFrame const& at, BeliefSummary const& belief) {
    auto const add_thing = [&](ThingKind kind, std::string const& id, auto const& thing) {
      Moment const moment{at, thing.probability, thing.log_odds, thing.evidence,
                          thing.why.value_or(Account())};
      history_of(kind, id).moments.push_back(moment);
    };
    if (belief.floor) {
      add_thing(ThingKind::kFloorPlane, "", *belief.floor);
    }
    for (WallSummary const& wall : belief.walls) {
      add_thing(ThingKind::kWallPlane, std::to_string(wall.id), wall);
    }
    for (ObjectSummary const& object : belief.objects) {
      add_thing(ThingKind::kObject, object.id, object);
      history_of(ThingKind::kObject, object.id).type = object.type;
    }
    for (StuffSummary const& stuff : belief.stuff) {
      add_thing(ThingKind::kStuff, std::to_string(stuff.id), stuff);
    }
  }

  /// By kind, then by first frame.
  [[nodiscard]] std::vector<ThingHistory> sorted(std::vector<BeliefSummary> const& run) && {
    for (ThingHistory& history : histories_) {
      std::size_t const after = history.moments.back().at.position + 1;
      if (after < run.size()) {
        history.gone = run_frame(run, after);
        history.joined = joined_of(history, run[after]);
      }
    }
    std::ranges::stable_sort(histories_, {}, &ThingHistory::kind);
    return std::move(histories_);
  }

private:
  /// The name of what it became one with.
  static std::string joined_of(ThingHistory const& history, BeliefSummary const& belief) {
    for (StuffSummary const& stuff : belief.stuff) {
      for (std::uint32_t const id : stuff.joined_ids) {
        if (history.kind == ThingKind::kStuff &&
            history.name == thing_name(ThingKind::kStuff, std::to_string(id))) {
          return thing_name(ThingKind::kStuff, std::to_string(stuff.id));
        }
      }
    }
    return "";
  }

  ThingHistory& history_of(ThingKind kind, std::string const& id) {
    auto const [place, is_new] = places_.try_emplace({kind, id}, histories_.size());
    if (is_new) {
      ThingHistory& history = histories_.emplace_back();
      history.kind = kind;
      history.name = thing_name(kind, id);
    }
    return histories_[place->second];
  }

  std::vector<ThingHistory> histories_;
  std::map<std::pair<ThingKind, std::string>, std::size_t> places_;
};

bool follows(Moment const& after, Moment const& before) {
  return after.at.position == before.at.position + 1;
}

Span span_of(std::vector<Moment> const& moments, std::size_t begin, std::size_t end) {
  Span span;
  span.begin = begin;
  span.end = end;
  span.evidence = moments[begin].evidence;
  span.log_odds_before = moments[begin].log_odds - moments[begin].why.moved;
  span.log_odds_after = moments[end - 1].log_odds;
  std::array<double, 5> shares{};
  std::size_t looks = 0;
  for (std::size_t i = begin; i < end; ++i) {
    Account const& why = moments[i].why;
    span.news += why.news;
    span.moved += why.moved;
    span.bounded += why.bounded ? 1U : 0U;
    span.mean_visible_share += why.visible_share / static_cast<double>(end - begin);
    double const points =
        std::accumulate(why.points.by_state.begin(), why.points.by_state.end(), 0.0);
    if (points > 0.0) {
      ++looks;
      for (std::size_t s = 0; s < shares.size(); ++s) {
        shares.at(s) += why.points.by_state.at(s) / points;
      }
    }
  }
  if (looks > 0) {
    for (double& share : shares) {
      share /= static_cast<double>(looks);
    }
    span.point_shares = shares;
  }
  return span;
}

}  // namespace

std::vector<ThingHistory> histories_of(std::vector<BeliefSummary> const& run) {
  Histories histories;
  for (std::size_t i = 0; i < run.size(); ++i) {
    histories.add(run_frame(run, i), run[i]);
  }
  return std::move(histories).sorted(run);
}

bool tells_why(BeliefSummary const& belief) {
  auto const told = [](auto const& thing) { return thing.why.has_value(); };
  return (!belief.floor || told(*belief.floor)) && std::ranges::all_of(belief.walls, told) &&
         std::ranges::all_of(belief.objects, told) && std::ranges::all_of(belief.stuff, told);
}

std::vector<Span> spans_of(ThingHistory const& history) {
  std::vector<Moment> const& moments = history.moments;
  std::vector<Span> spans;
  std::size_t begin = 0;
  for (std::size_t i = 1; i <= moments.size(); ++i) {
    bool const goes_on = i < moments.size() && moments[i].evidence == moments[begin].evidence &&
                         follows(moments[i], moments[i - 1]);
    if (!goes_on) {
      spans.push_back(span_of(moments, begin, i));
      begin = i;
    }
  }
  return spans;
}

std::string evidence_text(Evidence evidence) {
  std::string text = to_string(evidence);
  std::ranges::replace(text, '_', ' ');
  return text;
}

double travelled(ThingHistory const& history) {
  return std::accumulate(
      history.moments.begin(), history.moments.end(), 0.0,
      [](double sum, Moment const& moment) { return sum + std::abs(moment.why.moved); });
}

std::optional<std::size_t> first_unaccounted(ThingHistory const& history) {
  constexpr double kRounding = 1e-9;
  std::vector<Moment> const& moments = history.moments;
  for (std::size_t i = 1; i < moments.size(); ++i) {
    double const told = moments[i - 1].log_odds + moments[i].why.moved;
    if (follows(moments[i], moments[i - 1]) && std::abs(moments[i].log_odds - told) > kRounding) {
      return i;
    }
  }
  return std::nullopt;
}

}  // namespace credo
