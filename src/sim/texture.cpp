#include "sim/texture.hpp"

#include <cmath>
#include <cstddef>

namespace credo {
namespace {

constexpr double kDarkShade = 0.72;
constexpr double kDarkestNoise = 0.6;
/// A small shift keeps a face that lies on a border of cells in one of them.
constexpr double kOffBorder = 1e-4;

/// Lets each bit of a number change half of the others (the finalizer of MurmurHash3, Appleby).
std::uint32_t mixed(std::uint32_t x) {
  x = (x ^ (x >> 16U)) * 0x85ebca6bU;
  x = (x ^ (x >> 13U)) * 0xc2b2ae35U;
  return x ^ (x >> 16U);
}

/// From 0 to 1, of a lattice point.
double lattice_value(Eigen::Vector3d const& cell, std::uint32_t seed) {
  std::uint32_t hash = seed;
  for (double const coordinate : cell) {
    hash = mixed(hash ^ static_cast<std::uint32_t>(static_cast<std::int64_t>(coordinate)));
  }
  return hash / 4294967295.0;
}

/// From 0 to 1, of a point in cells.
double value_noise(Eigen::Vector3d const& p, std::uint32_t seed) {
  Eigen::Vector3d const cell = p.array().floor();
  Eigen::Array3d const share = p - cell;
  Eigen::Array3d const smooth = share * share * (3.0 - 2.0 * share);
  double value = 0.0;
  for (unsigned corner = 0; corner < 8; ++corner) {
    Eigen::Array3d const step(corner & 1U, (corner >> 1U) & 1U, (corner >> 2U) & 1U);
    Eigen::Array3d const weight = step * smooth + (1.0 - step) * (1.0 - smooth);
    value += weight.prod() * lattice_value(cell + step.matrix(), seed);
  }
  return value;
}

double two_shades(double cell) {
  return std::fmod(cell, 2.0) != 0.0 ? kDarkShade : 1.0;
}

}  // namespace

double texture_shade(SceneTexture const& texture, std::uint32_t seed,
                     Eigen::Vector3d const& p_thing) {
  Eigen::Vector3d const p = p_thing / texture.size_m;
  switch (texture.kind) {
    case SceneTexture::Kind::kPlain:
      break;
    case SceneTexture::Kind::kChecker: {
      Eigen::Vector3d const cell = (p.array() + kOffBorder).floor();
      return two_shades(cell.sum());
    }
    case SceneTexture::Kind::kStripes:
      return two_shades(std::floor((p.x() + p.y()) / std::sqrt(2.0) + kOffBorder));
    case SceneTexture::Kind::kNoise:
      return kDarkestNoise + (1.0 - kDarkestNoise) * value_noise(p, seed);
  }
  return 1.0;
}

std::uint32_t texture_seed(std::string const& name) {
  // FNV-1a (Fowler, Noll, Vo); std::hash may differ between machines.
  std::uint32_t hash = 2166136261U;
  for (char const letter : name) {
    hash = (hash ^ static_cast<unsigned char>(letter)) * 16777619U;
  }
  return hash;
}

}  // namespace credo
