#include "detector/scenes/scene_of_frame.hpp"

#include <optional>

#include "stages/normals/normals.hpp"
#include "stages/segments/things.hpp"

namespace credo {

SearchScene scene_of(Frame const& frame) {
  NormalMap const normals = estimate_normals(frame.cloud_camera, frame.intrinsics, {});
  // Colour is left out: the models have none.
  Segments const segments =
      segment_things(frame.cloud_camera.z, {}, frame.intrinsics, std::nullopt, {});
  return prepare_scene(frame.cloud_camera.z, frame.intrinsics, normals, segments);
}

}  // namespace credo
