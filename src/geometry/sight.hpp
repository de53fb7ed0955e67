#pragma once

#include "core/cloud.hpp"
#include "core/frame.hpp"
#include "core/grid.hpp"
#include "core/label.hpp"
#include "core/sight.hpp"

namespace credo {

/// The frame in blocks of such a size that about 160 of them make up a row. Pixels to the right and
/// at the bottom that fill no block are left out. Depth that is not positive and finite counts as
/// none. Images of different sizes throw std::logic_error.
[[nodiscard]] Sight sight_of(Grid<float> const& depth_m, LabelMap const& labels,
                             CameraIntrinsics const& intrinsics);

/// Of each block's middle pixel. Normals of a smaller image than the sight's throw
/// std::logic_error.
[[nodiscard]] NormalMap middle_normals(NormalMap const& normals_camera, Sight const& sight);

}  // namespace credo
