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
  /// Lit, with no shadows; dark where nothing is hit.
  Grid<Rgb> color;
  /// Position in Scene::things; -1 where nothing is hit, in range or not.
  Grid<std::int32_t> thing;
  /// Of the angle between the ray and the surface's normal; 0 where nothing is hit.
  Grid<float> incidence_cosine;
};

/// The bodies of a scene as it stands at one time, in a tree built once (Embree). Each ray is
/// followed into the bodies' equations in doubles: depth is exact to float precision and the same
/// on every machine. A body that the camera is inside of is not seen.
class RayCaster {
public:
  /// Throws InputError for a scene that check_scene refuses.
  /// The time is on the clock of the scene's events, and nothing to a scene without.
  explicit RayCaster(Scene const& scene, double time_s = 0.0);
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
