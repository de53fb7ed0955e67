#include "stages/fusion/surroundings.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "stages/fusion/existence.hpp"
#include "stages/fusion/findings.hpp"
#include "stages/fusion/points.hpp"
#include "stages/fusion/sight_view.hpp"

namespace credo {
namespace {

constexpr std::size_t kMostPoints = 1000;

PointCounts look_at(PointList const& points_world, SightView const& view) {
  PointCounts counts;
  std::size_t const stride = (points_world.size() + kMostPoints - 1) / kMostPoints;
  for (std::size_t i = 0; i < points_world.size(); i += stride) {
    ++counts[view.look_at(points_world[i])];
  }
  return counts;
}

void begin(SurfaceBelief& surface, Look const& now, FusionConfig const& config) {
  surface.log_odds = log_odds_of(config.new_probability);
  surface.last_look = now;
  surface.evidence = Evidence::kSeen;
  surface.why = {};
  surface.why.visible_share = 1.0;
  surface.why.news = 1.0;
}

void look_again(SurfaceBelief& surface, PointCounts const& counts, bool is_shown, Look const& now,
                FusionConfig const& config) {
  std::optional<Finding> const finding = finding_of(counts, surface.most_agreeing, is_shown);
  Eigen::Vector3d const middle = centroid_of(*surface.points);
  double const news = novelty(view_change(surface.last_look, now), middle, config.existence);
  surface.why = account_of(counts, surface.most_agreeing);
  surface.evidence = evidence_of(counts, finding);
  if (finding) {
    believe(surface, *finding, now, news, config.existence);
  }
  surface.most_agreeing =
      std::max(surface.most_agreeing, static_cast<double>(counts[PointState::kAgrees]));
}

bool is_forgotten(SurfaceBelief const& surface, ExistenceConfig const& config) {
  return probability_of(surface.log_odds) < config.min_probability;
}

Look look_of(Segmentation const& segmentation) {
  return {segmentation.stamp_ns, segmentation.T_world_camera.translation()};
}

}  // namespace

SurroundingsLook look_around(std::optional<FloorBelief> const& floor,
                             std::vector<WallBelief> const& walls,
                             Segmentation const& segmentation) {
  SightView const view(segmentation.sight, segmentation.T_world_camera);
  SurroundingsLook look;
  if (floor) {
    look.floor = look_at(*floor->points, view);
  }
  for (WallBelief const& wall : walls) {
    look.walls.push_back({wall.id, look_at(*wall.points, view)});
  }
  return look;
}

std::optional<FloorBelief> believed_floor(std::optional<FloorBelief> floor,
                                          std::optional<PointCounts> const& look,
                                          Segmentation const& segmentation,
                                          FusionConfig const& config) {
  if (!floor) {
    return floor;
  }
  if (look) {
    look_again(*floor, *look, segmentation.floor.has_value(), look_of(segmentation), config);
  } else {
    begin(*floor, look_of(segmentation), config);
  }
  return is_forgotten(*floor, config.existence) ? std::nullopt : std::move(floor);
}

std::vector<WallBelief> believed_walls(std::vector<WallBelief> walls,
                                       std::vector<WallLook> const& looks,
                                       Segmentation const& segmentation,
                                       FusionConfig const& config) {
  Look const now = look_of(segmentation);
  for (WallBelief& wall : walls) {
    auto const look = std::ranges::find(looks, wall.id, &WallLook::id);
    if (look != looks.end()) {
      look_again(wall, look->points, wall.label.has_value(), now, config);
    } else {
      begin(wall, now, config);
    }
  }
  std::erase_if(walls,
                [&](WallBelief const& wall) { return is_forgotten(wall, config.existence); });
  return walls;
}

void take_for_granted(BeliefState& belief, Segmentation const& segmentation,
                      FusionConfig const& config) {
  auto const evidence = [](bool seen) { return seen ? Evidence::kSeen : Evidence::kNotSeen; };
  if (belief.floor) {
    belief.floor->log_odds = log_odds_of(config.prior_probability);
    belief.floor->evidence = evidence(segmentation.floor.has_value());
  }
  for (WallBelief& wall : belief.walls) {
    wall.log_odds = log_odds_of(config.prior_probability);
    wall.evidence = evidence(wall.label.has_value());
  }
}

}  // namespace credo
