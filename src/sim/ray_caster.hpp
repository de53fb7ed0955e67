#pragma once

#include <cstdint>
#include <memory>

#include "core/frame.hpp"
#include "core/grid.hpp"
#include "core/se3.hpp"
#include "sim/scene.hpp"

namespace credo {

/// What a noise-free camera sees.
struct RenderedView {
  /// Depth along the optical axis [m]; 0 where nothing is in range.
  Grid<float> depth_m;
  Grid<Rgb> color;
  /// Position in Scene::things; -1 where nothing is hit, in range or not.
  Grid<std::int32_t> thing;
};

/// The geometry of a scene, built once (Embree). Boxes, tables and spheres are exact; cylinders are
/// prisms of 96 sides, at most 0.06 % of their radius inside the true surface.
class RayCaster {
public:
  explicit RayCaster(Scene const& scene);
  RayCaster(RayCaster const&) = delete;
  RayCaster& operator=(RayCaster const&) = delete;
  RayCaster(RayCaster&&) = delete;
  RayCaster& operator=(RayCaster&&) = delete;
  ~RayCaster();

  /// One ray through the centre of each pixel. The same at any number of threads.
  [[nodiscard]] RenderedView render(Se3 const& T_world_camera) const;

private:
  struct World;
  std::unique_ptr<World> world_;
};

}  // namespace credo
