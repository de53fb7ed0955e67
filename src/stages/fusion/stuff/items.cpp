#include "stages/fusion/stuff/items.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "stages/fusion/existence.hpp"
#include "stages/fusion/findings.hpp"
#include "stages/fusion/stuff/cluster_owners.hpp"
#include "stages/fusion/stuff/hidden_things.hpp"
#include "stages/fusion/stuff/joined_names.hpp"
#include "stages/fusion/stuff/learning.hpp"
#include "stages/fusion/stuff/looks.hpp"
#include "stages/fusion/stuff/model.hpp"
#include "stages/fusion/stuff/moves.hpp"
#include "stages/fusion/stuff/one_with.hpp"
#include "stages/fusion/stuff/shown_in.hpp"
#include "stages/fusion/stuff/shown_planes.hpp"
#include "stages/fusion/stuff/shown_steps.hpp"

namespace credo {
namespace {

// How much of a look is news that takes for something known, or for another thing, what one look
// alone showed by itself.
constexpr double kOneToOne = 0.7;
// Another thing: of what is so large alone. Of what is smaller a look says too little.
constexpr int kLargeBlocks = 200;
// Merging.
constexpr double kLeastShown = 0.32;

class Fusing {
public:
  Fusing(FusedStuff known, Segmentation const& segmentation, KnownPlaces const& places,
         double elapsed_s, FusionConfig const& config)
      : known_(std::move(known)),
        segmentation_(segmentation),
        places_(places),
        planes_(segmentation),
        elapsed_s_(elapsed_s),
        config_(config),
        now_{segmentation.stamp_ns, segmentation.T_world_camera.translation()},
        view_(segmentation.sight, segmentation.T_world_camera),
        looks_(segmentation.sight, segmentation.T_world_camera, known_.stuff),
        steps_(segmentation.sight, looks_.owners()),
        clusters_(clusters_of(segmentation)),
        owners_(looks_.looks(), clusters_, places),
        news_(known_.stuff.size(), 0.0) {
    for (StuffBelief& item : known_.stuff) {
      item.joined_ids.clear();
      log_odds_before_.push_back(item.log_odds);
      models_before_.push_back(item.model);
    }
  }

  FusedStuff run() && {
    release_walkers();
    find_hidden();
    for (std::size_t i = 0; i < known_.stuff.size(); ++i) {
      update(i);
    }
    learn();
    move();
    merge();
    forget_what_left(known_.stuff, view_);
    for (Part const& part : parts_) {
      add(part.label - std::size_t{kFirstStuff}, part.log_odds);
    }
    std::erase_if(known_.stuff, [&](StuffBelief const& item) {
      return item.model == nullptr ||
             probability_of(item.log_odds) < config_.existence.min_probability;
    });
    add_new();
    // What got its name back came last.
    std::ranges::stable_sort(known_.stuff, {}, &StuffBelief::id);
    return std::move(known_);
  }

private:
  [[nodiscard]] StuffLook const& look(std::size_t item) const { return looks_.looks()[item]; }
  [[nodiscard]] SeenCluster const& cluster(LabelCode label) const {
    return clusters_[label - std::size_t{kFirstStuff}];
  }

  /// A cluster that is one with what stands behind a thing on its way, for the greater part of it,
  /// is not what stands there.
  void release_walkers() {
    for (std::size_t i = 0; i < look_count(); ++i) {
      bool const shows = std::ranges::any_of(look(i).shares, [&](ClusterShare const& share) {
        return is_stuff(share.label) && owners_.owner(share.label) == i;
      });
      if (shows || !is_on_its_way(known_.stuff[i])) {
        continue;
      }
      for (ClusterShare const& share : look(i).shares) {
        std::optional<std::size_t> const owner =
            is_stuff(share.label) ? owners_.owner(share.label) : std::nullopt;
        if (!owner || is_on_its_way(known_.stuff[*owner])) {
          continue;
        }
        std::size_t const c = share.label - std::size_t{kFirstStuff};
        SeenCluster rest = without_thing(clusters_[c], *owner, looks_.owners());
        if (2 * rest.blocks.size() > clusters_[c].blocks.size() &&
            may_have_walked_to(known_.stuff[i], look(i), c, rest)) {
          clusters_[c] = std::move(rest);
          owners_.release(share.label);
          released_.insert(share.label);
        }
      }
    }
  }

  /// What comes out from behind what hides a thing is taken for it.
  void find_hidden() {
    std::vector<bool> shows(look_count(), false);
    std::vector<std::size_t> free;
    for (std::size_t c = 0; c < clusters_.size(); ++c) {
      if (auto const owner = owners_.owner(static_cast<LabelCode>(kFirstStuff + c))) {
        shows[*owner] = true;
      } else if (is_unexplained(c) && !has_arrived(clusters_[c])) {
        free.push_back(c);
      }
    }
    came_out_ = what_comes_out(known_.stuff, looks_.looks(), clusters_, free, shows, view_);
    for (auto const& [item, label] : came_out_) {
      owners_.give(label, item);
    }
  }

  void update(std::size_t i) {
    StuffBelief& item = known_.stuff[i];
    StuffLook const& seen = look(i);
    std::vector<LabelCode> labels;
    double most = 0.0;
    item.label.reset();
    for (ClusterShare const& share : seen.shares) {
      if (is_stuff(share.label) && owners_.owner(share.label) == i) {
        labels.push_back(share.label);
        // Not by blocks: what stands nearer shows in more of them, whichever of the two it is.
        double const amount =
            amount_shown(*item.model, seen, segmentation_.sight.labels, share.label);
        if (!item.label || amount > most) {
          most = amount;
          item.label = share.label;
        }
      }
    }
    if (auto const part = came_out_.find(i); labels.empty() && part != came_out_.end()) {
      labels.push_back(part->second);
      item.label = part->second;
    }
    bool const matched = !labels.empty();
    std::optional<Finding> finding = finding_of(seen.counts, item.most_agreeing, matched);
    item.evidence = evidence_of(seen.counts, finding);
    if (finding && finding->verdict == Verdict::kSeen && !matched && shows_known(i)) {
      // What is there is floor, wall or known object, and no thing of its own.
      finding->verdict = Verdict::kGone;
      finding->stands = !shows_found_object(seen, segmentation_.sight.labels, places_);
      item.evidence = Evidence::kNotSeen;
    } else if (!matched && shows_on_walls(item, seen, owners_)) {
      // Whether it is the wall that shows, the frame does not tell.
      finding.reset();
      item.evidence = evidence_of(seen.counts, finding);
    }
    item.why = account_of(seen.counts, item.most_agreeing);
    Eigen::Vector3d const middle = item.latest().centroid_world.cast<double>();
    news_[i] = novelty(view_change(item.last_look, now_), middle, config_.existence);
    if (finding) {
      bool const one_to_one = finding->stands && item.history_count == 1 && item.one_with.empty();
      believe(item, *finding, now_, one_to_one ? std::max(news_[i], kOneToOne) : news_[i],
              config_.existence);
    } else if (is_on_its_way(item)) {
      lose_sight_of(item, elapsed_s_, config_.existence);
    }
    if (item.label) {
      lower_to(item, places_.most_log_odds_at(cluster(*item.label).points_world));
    }
    if (matched) {
      bool const moved = has_moved(seen.counts);
      count_look(item, moved);
      found_.push_back({.item = i,
                        .labels = std::move(labels),
                        .news = news_[i],
                        .is_elsewhere = moved && is_on_its_way(item)});
    }
    item.most_agreeing =
        std::max(item.most_agreeing, static_cast<double>(seen.counts[PointState::kAgrees]));
  }

  void learn() {
    learn_of(found_, known_.stuff,
             {looks_, segmentation_.sight.labels, clusters_, known_.stuff, log_odds_before_});
    for (FoundThing const& found : found_) {
      for (LabelCode const part : found.parts) {
        parts_.push_back({part, known_.stuff[found.item].log_odds});
      }
    }
  }

  /// Things that have gone from where they were, and stand elsewhere.
  void move() {
    std::vector<FreeCluster> free;
    for (std::size_t c = 0; c < clusters_.size(); ++c) {
      if (is_unexplained(c)) {
        free.push_back({c, has_arrived(clusters_[c])});
      }
    }
    for (Move const& found : moves(known_.stuff, looks_.looks(), clusters_, free, now_)) {
      StuffBelief& item = known_.stuff[found.item];
      SeenCluster const& seen = clusters_[found.cluster];
      item.label = static_cast<LabelCode>(kFirstStuff + found.cluster);
      item.evidence = Evidence::kSeen;
      item.verdict = Verdict::kSeen;
      // That it is not where it was says nothing against it.
      item.log_odds = log_odds_before_[found.item];
      item.why.moved = 0.0;
      raise_to(item, log_odds_of_new(seen));
      believe(item, {Verdict::kSeen, 1.0}, now_, news_[found.item], config_.existence);
      if (found.set_out) {
        count_arrival(item);
      }
      count_look(item, true);
      begin_model(item, seen);
      owners_.give(static_cast<LabelCode>(kFirstStuff + found.cluster), found.item);
    }
  }

  /// Large enough for a thing, nobody's, and not what things explain already.
  [[nodiscard]] bool is_unexplained(std::size_t c) const {
    SeenCluster const& seen = clusters_[c];
    auto const label = static_cast<LabelCode>(kFirstStuff + c);
    if (owners_.owner(label) || seen.blocks.size() < kLeastBlocksOfThing) {
      return false;
    }
    std::size_t explained = 0;
    for (std::size_t const block : seen.blocks) {
      std::int32_t const owner = looks_.owners()[block];
      if (owner < 0 || owners_.is_base_of(static_cast<std::size_t>(owner), label)) {
        continue;
      }
      auto const& shares = look(static_cast<std::size_t>(owner)).shares;
      auto const share = std::ranges::find(shares, label, &ClusterShare::label);
      explained +=
          share != shares.end() && share->agreement() >= kLeastAgreementOfCluster ? 1U : 0U;
    }
    return static_cast<double>(explained) <= kExplained * static_cast<double>(seen.blocks.size()) &&
           places_.share_known(seen.points_world, seen.lies_on < 0) <= kExplained &&
           places_.share_left_behind(seen.points_world) <= kExplained;
  }

  /// What shows in another thing's clusters is one with it, what shows as floor, wall or known
  /// object was that, unless it shows by itself as well.
  void merge() {
    for (std::size_t j = 0; j < look_count(); ++j) {
      StuffBelief& item = known_.stuff[j];
      if (item.model == nullptr) {
        continue;
      }
      if (!item.label && shows_known(j)) {
        if (shows_enough(j) && shows_as_known(item, news_[j]) && item.log_odds < 0.0) {
          forget(item);
        }
      } else if (std::optional<std::size_t> const host =
                     host_of(j, known_.stuff, looks_.looks(), owners_, released_)) {
        // Which a frame that shows the one behind the other does not say, whatever its clusters.
        if (shows_enough(j) && !steps_.stand_apart(j, *host) && are_one(j, *host)) {
          join(*host, j);
        }
      } else if (item.label) {
        shows_alone(item, known_.stuff, news_[j]);
      }
    }
  }

  /// Kept with the one that was known last, whichever shows in the other.
  [[nodiscard]] bool are_one(std::size_t j, std::size_t host) {
    std::uint32_t const first = known_.stuff[std::min(j, host)].id;
    StuffBelief& last = known_.stuff[std::max(j, host)];
    std::size_t const looks_before = last.history_count - (last.label ? 1U : 0U);
    bool const one_to_one =
        looks_before == 1 && last.one_with.empty() && look(j).blocks >= kLargeBlocks;
    double const news = one_to_one ? std::max(news_[j], kOneToOne) : news_[j];
    return shows_as_one(last, first, news * counts_as_one(look(j).blocks),
                        std::max(look(j).blocks, look(host).blocks));
  }

  /// Of a thing that is hardly in view nothing is learnt about what it is one with.
  [[nodiscard]] bool shows_enough(std::size_t j) const {
    return look(j).counts[PointState::kAgrees] > kLeastShown * known_.stuff[j].most_agreeing;
  }

  static void forget(StuffBelief& item) {
    item.model = nullptr;
    item.one_with.clear();
    item.names_kept.clear();
  }

  [[nodiscard]] bool shows_known(std::size_t j) const {
    return credo::shows_known(known_.stuff[j], look(j), planes_);
  }

  [[nodiscard]] std::size_t look_count() const { return looks_.looks().size(); }

  /// The one that is better known of what shows now keeps its name.
  void join(std::size_t a, std::size_t b) {
    if (amount_shown(*models_before_[a], look(a)) < amount_shown(*models_before_[b], look(b))) {
      std::swap(a, b);
    }
    become_one(known_.stuff[a], known_.stuff[b]);
    forget(known_.stuff[b]);
  }

  void add_new() {
    for (std::size_t c = 0; c < clusters_.size(); ++c) {
      double const most = places_.most_log_odds_at(clusters_[c].points_world);
      if (is_unexplained(c) && probability_of(most) >= config_.existence.min_probability) {
        add(c, std::min(most, log_odds_of_new(clusters_[c])));
        if (has_arrived(clusters_[c])) {
          count_arrival(known_.stuff.back());
        }
      }
    }
  }

  [[nodiscard]] double log_odds_of_new(SeenCluster const& seen) const {
    return birth_log_odds(seen.thickness_blocks, has_arrived(seen), config_.births,
                          config_.existence);
  }

  /// Where the frame before saw through.
  [[nodiscard]] bool has_arrived(SeenCluster const& seen) const {
    return places_.share_free_before(seen.points_world) > 0.5;
  }

  void add(std::size_t c, double log_odds) {
    auto const label = static_cast<LabelCode>(kFirstStuff + c);
    auto const old = name_of_old(known_.stuff, label, clusters_[c], view_);
    StuffBelief& item = known_.stuff.emplace_back();
    item.id = old ? old->id : known_.next_id++;
    item.log_odds = log_odds;
    item.label = label;
    item.history_count = old ? old->history_count + 1 : 1;
    item.last_look = now_;
    begin_model(item, clusters_[c]);
    item.why = account_of_new(*item.model);
  }

  /// A cluster that showed to be a thing of its own, and what is believed of that.
  struct Part {
    LabelCode label;
    double log_odds;
  };

  FusedStuff known_;
  Segmentation const& segmentation_;
  KnownPlaces const& places_;
  ShownPlanes planes_;
  double elapsed_s_;
  FusionConfig const& config_;
  Look now_;
  SightView view_;
  StuffLooks looks_;
  ShownSteps steps_;
  /// By label, from kFirstStuff on.
  std::vector<SeenCluster> clusters_;
  ClusterOwners owners_;
  /// Those that are what walks and what stands behind it in one.
  std::set<LabelCode> released_;
  /// How much of the frame is news about each thing.
  std::vector<double> news_;
  /// Of each thing, before the frame.
  std::vector<double> log_odds_before_;
  std::vector<std::shared_ptr<StuffModel const>> models_before_;
  std::vector<FoundThing> found_;
  std::vector<Part> parts_;
  /// What comes out from behind what hides a thing.
  std::map<std::size_t, LabelCode> came_out_;
};

}  // namespace

FusedStuff fused_items(FusedStuff known, Segmentation const& segmentation,
                       KnownPlaces const& places, double elapsed_s, FusionConfig const& config) {
  return Fusing(std::move(known), segmentation, places, elapsed_s, config).run();
}

}  // namespace credo
