#pragma once

#include "core/segmentation.hpp"

namespace credo {

/// The same frame where the camera stood elsewhere: what it has in the world's frame is moved by
/// `T_new_old`, its correction too. A cluster's bounds are those of its moved box.
[[nodiscard]] Segmentation moved(Segmentation segmentation, Se3 const& T_new_old);

}  // namespace credo
