#include "eval/birth_scorer.hpp"

#include <map>

#include "geometry/sight.hpp"
#include "geometry/thickness.hpp"

namespace credo {

void BirthScorer::add(BeliefSummary const& belief, LabelMap const& labels,
                      StuffBodies const& bodies, FrameTruth const& truth, ToldObjects const& told) {
  // As the belief looks at a frame, whose depth plays no part here.
  Grid<float> const no_depth(labels.width(), labels.height());
  std::map<LabelCode, double> const thickness =
      thickness_px(sight_of(no_depth, labels, CameraIntrinsics{}).labels);
  for (StuffSummary const& piece : belief.stuff) {
    if (!known_.insert(piece.id).second || !piece.label) {
      continue;
    }
    if (auto const found = thickness.find(*piece.label); found != thickness.end()) {
      births_.push_back(
          {belief.frame, piece.id, found->second, bodies.is_there(piece.id, truth, told)});
    }
  }
}

}  // namespace credo
