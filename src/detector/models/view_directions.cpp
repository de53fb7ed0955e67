#include "detector/models/view_directions.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>

namespace credo {
namespace {

using Face = std::array<std::uint32_t, 3>;

constexpr int kCuts = 2;

std::vector<Eigen::Vector3f> icosahedron_corners() {
  auto const golden = std::numbers::phi_v<float>;
  std::vector<Eigen::Vector3f> corners;
  for (float const one : {-1.0F, 1.0F}) {
    for (float const phi : {-golden, golden}) {
      corners.emplace_back(0.0F, one, phi);
      corners.emplace_back(one, phi, 0.0F);
      corners.emplace_back(phi, 0.0F, one);
    }
  }
  return corners;
}

/// Three corners are a face where all are 2 apart, the length of an edge.
std::vector<Face> icosahedron_faces(std::vector<Eigen::Vector3f> const& corners) {
  auto const joined = [&](std::uint32_t i, std::uint32_t j) {
    return (corners[i] - corners[j]).norm() < 2.1F;
  };
  std::vector<Face> faces;
  for (std::uint32_t i = 0; i < corners.size(); ++i) {
    for (std::uint32_t j = i + 1; j < corners.size(); ++j) {
      for (std::uint32_t k = j + 1; k < corners.size(); ++k) {
        if (joined(i, j) && joined(j, k) && joined(i, k)) {
          faces.push_back({i, j, k});
        }
      }
    }
  }
  return faces;
}

}  // namespace

std::vector<Eigen::Vector3f> view_directions() {
  std::vector<Eigen::Vector3f> corners = icosahedron_corners();
  std::vector<Face> faces = icosahedron_faces(corners);
  for (int cut = 0; cut < kCuts; ++cut) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    auto const middle = [&](std::uint32_t i, std::uint32_t j) {
      auto const [known, is_new] =
          middles.try_emplace(std::minmax(i, j), static_cast<std::uint32_t>(corners.size()));
      if (is_new) {
        corners.emplace_back((corners[i].normalized() + corners[j].normalized()) / 2.0F);
      }
      return known->second;
    };
    std::vector<Face> finer;
    for (auto const& [a, b, c] : faces) {
      std::uint32_t const ab = middle(a, b);
      std::uint32_t const bc = middle(b, c);
      std::uint32_t const ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    faces = std::move(finer);
  }
  for (Eigen::Vector3f& corner : corners) {
    corner.normalize();
  }
  return corners;
}

}  // namespace credo
