#include "belief_table.hpp"

#include <spdlog/fmt/fmt.h>

#include <cmath>

#include "rounding.hpp"

namespace credo {
namespace {

std::string place(Eigen::Vector3d const& p) {
  return fmt::format("{:>7.2f}{:>7.2f}{:>7.2f}", rounded(p.x(), 2), rounded(p.y(), 2),
                     rounded(p.z(), 2));
}

std::string row(std::string const& kind, std::string const& name, double probability,
                Eigen::Vector3d const& position_m, std::string const& rest) {
  return fmt::format("  {:<12}{:<14}{:>6.3f} {}  {}\n", kind, name, probability, place(position_m),
                     rest);
}

std::string object_row(ObjectSummary const& object) {
  // Of the least sure direction of its position.
  double const sigma_m = std::sqrt(object.covariance.diagonal().head<3>().maxCoeff());
  return row(object.type, object.id, object.probability, object.position_m,
             fmt::format("{}, within {:.3f} m", to_string(object.evidence), sigma_m));
}

std::string stuff_row(StuffSummary const& stuff) {
  Eigen::Vector3f const size_m = stuff.max_m - stuff.min_m;
  return row("stuff", fmt::format("#{}", stuff.id), stuff.probability,
             stuff.centroid_m.cast<double>(),
             fmt::format("{}, {} times, {:.2f} x {:.2f} x {:.2f} m", to_string(stuff.evidence),
                         stuff.history_count, size_m.x(), size_m.y(), size_m.z()));
}

std::string wall_row(WallSummary const& wall) {
  Eigen::Vector2d const& a = wall.segment_start_m;
  Eigen::Vector2d const& b = wall.segment_end_m;
  return fmt::format("  {:<12}{:<14}({:.2f}, {:.2f}) to ({:.2f}, {:.2f}), {:.2f} m\n", "wall",
                     fmt::format("#{}", wall.id), rounded(a.x(), 2), rounded(a.y(), 2),
                     rounded(b.x(), 2), rounded(b.y(), 2), (b - a).norm());
}

}  // namespace

std::string belief_table(std::string const& source, BeliefSummary const& belief) {
  std::string table = fmt::format(
      "{}  frame {}  {:.3f} s  {}\n", source, number(belief.frame),
      static_cast<double>(belief.stamp_ns) * 1e-9,
      belief.floor ? fmt::format("floor at {:.3f} m", rounded(belief.floor->height_m, 3))
                   : "no floor");
  table +=
      fmt::format("  {:<12}{:<14}{:>6} {:>7}{:>7}{:>7}\n", "what", "id", "p", "x m", "y m", "z m");
  for (ObjectSummary const& object : belief.objects) {
    table += object_row(object);
  }
  for (StuffSummary const& stuff : belief.stuff) {
    table += stuff_row(stuff);
  }
  for (WallSummary const& wall : belief.walls) {
    table += wall_row(wall);
  }
  return table;
}

}  // namespace credo
