#include "stages/fusion/stuff/split.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "stages/fusion/stuff/model.hpp"

namespace credo {
namespace {

/// Looks, as far as they are news: of single points that are another thing's, and of a cluster that
/// is a thing of its own; and its points that must have had so many.
constexpr float kEnoughLooks = 3.0F;
constexpr float kEnoughOfPart = 2.0F;
constexpr double kShareOfPart = 0.6;
constexpr int kLeastPoints = 8;
/// So many points must lead from a piece to the main one behind what hides them.
constexpr int kLeastHidden = 3;
/// One look that shows a point in the thing's main cluster undoes so many that do not.
constexpr float kOfOneTogether = 3.0F;
// Carving.
constexpr float kLeastMissed = 0.1F;
constexpr float kMissedBeforeItself = 0.2F;
constexpr float kMissedLessAgreeing = 0.5F;

bool is_one_of(LabelCode label, std::span<LabelCode const> labels) {
  return std::ranges::find(labels, label) != labels.end();
}

/// What of a piece was never seen before counts as the rest of it does. As the camera comes nearer,
/// and with noise, so much of it is new in each frame that it would not be seen to be apart.
void count_new_with_the_rest(StuffModel& model, StuffLook const& look, LabelMap const& shown,
                             LabelCode piece) {
  float sum = 0.0F;
  float count = 0.0F;
  std::vector<std::size_t> fresh;
  for (std::size_t p = 0; p < model.points.size(); ++p) {
    if (look.points[p].state != PointState::kAgrees ||
        shown[static_cast<std::size_t>(look.points[p].block)] != piece) {
      continue;
    }
    if (model.points[p].weight > 1.0F) {
      sum += model.points[p].apart;
      count += 1.0F;
    } else {
      fresh.push_back(p);
    }
  }
  for (std::size_t const p : fresh) {
    model.points[p].apart = std::max(model.points[p].apart, sum / std::max(count, 1.0F));
  }
}

/// Calls `visit` with the place of each point in the 27 cells around that of the point, and in it.
template <typename Visit>
void visit_around(StuffModel const& model, std::size_t point, Visit const& visit) {
  for (std::int64_t const dx : {-1, 0, 1}) {
    for (std::int64_t const dy : {-1, 0, 1}) {
      std::uint64_t const first = neighbour_cell(model.cells[point], dx, dy, -1);
      auto at = std::ranges::lower_bound(model.cells, first);
      for (; at != model.cells.end() && *at <= first + 2; ++at) {
        visit(static_cast<std::size_t>(at - model.cells.begin()));
      }
    }
  }
}

/// What a look shows of a point, of which a piece and the main cluster are parts.
enum class Part : std::uint8_t { kNeither, kPiece, kMain, kHidden, kReached };

std::vector<Part> parts_of(StuffModel const& model, StuffLook const& look, LabelMap const& shown,
                           LabelCode main, LabelCode piece, std::span<LabelCode const> labels) {
  std::vector<Part> parts(model.points.size(), Part::kNeither);
  for (std::size_t p = 0; p < model.points.size(); ++p) {
    PointLook const& point = look.points[p];
    if (point.state == PointState::kAgrees) {
      LabelCode const label = shown[static_cast<std::size_t>(point.block)];
      parts[p] = label == piece ? Part::kPiece : label == main ? Part::kMain : Part::kNeither;
    } else if (point.state == PointState::kOccluded &&
               !is_one_of(shown[static_cast<std::size_t>(point.block)], labels)) {
      parts[p] = Part::kHidden;
    }
  }
  return parts;
}

/// Whether a piece goes on to the main cluster behind something else, as the model has it, rather
/// than touching it in sight.
bool is_cut_off(StuffModel const& model, std::vector<Part> parts) {
  std::vector<std::size_t> reached;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (parts[p] == Part::kPiece) {
      reached.push_back(p);
    }
  }
  int in_sight = 0;
  int hidden = 0;
  while (!reached.empty()) {
    std::size_t const p = reached.back();
    reached.pop_back();
    bool touches = false;
    visit_around(model, p, [&](std::size_t q) {
      touches = touches || parts[q] == Part::kMain;
      if (parts[q] == Part::kHidden) {
        parts[q] = Part::kReached;
        reached.push_back(q);
      }
    });
    in_sight += touches && parts[p] == Part::kPiece ? 1 : 0;
    hidden += touches && parts[p] == Part::kReached ? 1 : 0;
  }
  return hidden >= kLeastHidden && hidden > in_sight;
}

/// The pieces that something else cuts off from the main cluster.
std::vector<LabelCode> cut_off(StuffModel const& model, StuffLook const& look,
                               LabelMap const& shown, LabelCode main,
                               std::span<LabelCode const> labels) {
  std::vector<LabelCode> pieces;
  for (LabelCode const label : labels) {
    if (label != main && is_cut_off(model, parts_of(model, look, shown, main, label, labels))) {
      pieces.push_back(label);
    }
  }
  return pieces;
}

}  // namespace

void count_misses(StuffModel& model, StuffLook const& look, LabelMap const& shown,
                  std::span<LabelCode const> labels, double news) {
  float const missed = std::max(static_cast<float>(news), kLeastMissed);
  for (std::size_t p = 0; p < model.points.size(); ++p) {
    PointLook const& point = look.points[p];
    float& count = model.points[p].missed;
    if (point.state == PointState::kAgrees) {
      count = std::max(0.0F, count - kMissedLessAgreeing);
    } else if (point.state == PointState::kSeenThrough) {
      bool const itself = is_one_of(shown[static_cast<std::size_t>(point.block)], labels);
      count += itself ? kMissedBeforeItself * missed : missed;
    }
  }
}

SplitModel split_model(StuffModel model, StuffLook const& look, LabelMap const& shown,
                       LabelCode main, std::span<LabelCode const> labels, double news) {
  auto const more = static_cast<float>(news);
  for (LabelCode const label : labels) {
    if (label != main) {
      count_new_with_the_rest(model, look, shown, label);
    }
  }
  std::vector<LabelCode> const together = cut_off(model, look, shown, main, labels);
  std::vector<LabelCode> shown_as(model.points.size(), kNoDepth);
  std::vector<std::uint8_t> gone(model.points.size(), 0);
  for (std::size_t p = 0; p < model.points.size(); ++p) {
    if (look.points[p].state != PointState::kAgrees) {
      continue;
    }
    shown_as[p] = shown[static_cast<std::size_t>(look.points[p].block)];
    bool const own = is_one_of(shown_as[p], labels);
    if ((!own && shown_as[p] < kFloor) || is_one_of(shown_as[p], together)) {
      continue;
    }
    SurfacePoint& point = model.points[p];
    point.apart =
        std::max(0.0F, point.apart + (shown_as[p] == main ? -kOfOneTogether * more : more));
    bool const anothers = !own && point.apart > kEnoughLooks * point.weight / kMostWeight;
    gone[p] = anothers ? 1 : 0;
  }
  SplitModel result;
  for (LabelCode const label : labels) {
    int points = 0;
    int apart = 0;
    for (std::size_t p = 0; p < model.points.size(); ++p) {
      bool const here = shown_as[p] == label;
      points += here ? 1 : 0;
      apart += here && model.points[p].apart > kEnoughOfPart ? 1 : 0;
    }
    if (label == main || is_one_of(label, together) || points < kLeastPoints ||
        apart <= kShareOfPart * points) {
      continue;
    }
    for (std::size_t p = 0; p < model.points.size(); ++p) {
      gone[p] = gone[p] != 0 || shown_as[p] == label ? 1 : 0;
    }
    result.parts.push_back(label);
  }
  result.model = without(std::move(model), gone);
  return result;
}

}  // namespace credo
