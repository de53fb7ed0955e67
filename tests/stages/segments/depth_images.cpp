#include "stages/segments/depth_images.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace credo::test {

Grid<float> depth_of_quanta(int width, int height, std::function<double(Pixel)> const& quanta) {
  Grid<float> depth_m(width, height);
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    double const value = quanta(depth_m.pixel(i));
    depth_m[i] = value > 0.0 ? static_cast<float>(1.0 / (value * kQuantum_per_m)) : 0.0F;
  }
  return depth_m;
}

Grid<float> random_planes(int width, int height, unsigned seed) {
  constexpr double kPlaneOf_px2 = 3000.0;
  struct Piece {
    double u;
    double v;
    double quanta;
    double per_u;
    double per_v;
  };
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  std::vector<Piece> pieces(
      static_cast<std::size_t>(2.0 + width * static_cast<double>(height) / kPlaneOf_px2));
  for (Piece& piece : pieces) {
    piece = {part(random) * width, part(random) * height, 150.0 + 250.0 * part(random),
             2.0 * part(random) - 1.0, 2.0 * part(random) - 1.0};
  }
  std::normal_distribution<double> noise(0.0, 0.7);
  std::bernoulli_distribution hole(0.02);
  return depth_of_quanta(width, height, [&](Pixel p) {
    // Of the plane that begins next to it or, where that is nearer to the camera, of another one
    // beside: so planes meet in creases as well as in steps.
    double nearest = std::numeric_limits<double>::infinity();
    double value = 0.0;
    double value_before = 0.0;
    for (Piece const& piece : pieces) {
      double const distance = std::hypot(p.u - piece.u, p.v - piece.v);
      if (distance < nearest) {
        nearest = distance;
        value_before = value;
        value = piece.quanta + piece.per_u * (p.u - piece.u) + piece.per_v * (p.v - piece.v);
      }
    }
    return hole(random) ? 0.0 : std::max(value, value_before) + noise(random);
  });
}

Grid<float> depth_noise(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> depth(0.5F, 5.0F);
  std::bernoulli_distribution hole(0.1);
  Grid<float> depth_m(width, height);
  for (float& z : depth_m) {
    z = hole(random) ? 0.0F : depth(random);
  }
  return depth_m;
}

Grid<float> checkerboard(int width, int height, int cell_px) {
  Grid<float> depth_m(width, height);
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    Pixel const p = depth_m.pixel(i);
    depth_m[i] = (p.u / cell_px + p.v / cell_px) % 2 == 0 ? 1.0F : 1.5F;
  }
  return depth_m;
}

Grid<float> grooved_wall(int width, int height) {
  constexpr int kCell_px = 16;
  constexpr int kPlate_px = 10;
  return depth_of_quanta(width, height, [](Pixel p) {
    int const u = p.u % kCell_px;
    int const v = p.v % kCell_px;
    bool const in_plate = u > 0 && v > 0 && u <= kPlate_px && v <= kPlate_px;
    bool const in_groove = !in_plate && u <= kPlate_px + 1 && v <= kPlate_px + 1;
    return in_groove ? 290.0 : 300.0;
  });
}

}  // namespace credo::test
