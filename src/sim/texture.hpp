#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "sim/scene.hpp"

namespace credo {

/// The share of its colour that a thing shows at a point of its surface, in its own frame: 1, or
/// down to 0.6 where its texture is dark. It lies in the thing as in a block that it is cut from.
///  - checker: cubes of the size in two shades; stripes: upright sheets of it, at 45 degrees to x
///    and y, so that they run up each side and across the top
///  - noise: blotches of about the size, a smooth function of random values on a lattice (value
///    noise) that `seed` chooses
/// The size must be positive but for plain.
double texture_shade(SceneTexture const& texture, std::uint32_t seed,
                     Eigen::Vector3d const& p_thing);

/// A seed that a name always has, on every machine.
std::uint32_t texture_seed(std::string const& name);

}  // namespace credo
