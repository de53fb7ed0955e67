#pragma once

#include <string>

#include "sim/scene.hpp"

namespace credo {

/// A scene by name or file, with the models that its things name. Throws InputError where there is
/// none or it cannot be read; check_scene tells whether it can be.
Scene load_scene(std::string const& name_or_file);

}  // namespace credo
