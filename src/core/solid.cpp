#include "core/solid.hpp"

namespace credo {

BoxSolid box_on_base(Eigen::Vector3d const& size_m) {
  double const x = 0.5 * size_m.x();
  double const y = 0.5 * size_m.y();
  return {{-x, -y, 0}, {x, y, size_m.z()}};
}

std::vector<Solid> table_on_base(TableSize const& size) {
  double const x = 0.5 * size.top_m.x();
  double const y = 0.5 * size.top_m.y();
  double const underside = size.height_m - size.thickness_m;
  double const leg = size.leg_m;
  std::vector<Solid> solids = {BoxSolid{{-x, -y, underside}, {x, y, size.height_m}}};
  for (double const leg_x : {-x, x - leg}) {
    for (double const leg_y : {-y, y - leg}) {
      solids.emplace_back(BoxSolid{{leg_x, leg_y, 0}, {leg_x + leg, leg_y + leg, underside}});
    }
  }
  return solids;
}

}  // namespace credo
