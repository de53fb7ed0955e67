#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "core/frame.hpp"
#include "core/grid.hpp"
#include "core/se3.hpp"
#include "sim/scene.hpp"
#include "sim/scene_time.hpp"

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

/// What the ray through a pixel hits first.
struct PixelHit {
  /// Position in Scene::things; none where nothing is hit.
  std::optional<std::size_t> thing;
  /// Along the optical axis, in range or not.
  double depth_m = std::numeric_limits<double>::infinity();
};

/// The things of a scene as it stands at one time, in a tree built once (Embree). Each ray is
/// followed in doubles, into the equations of bodies and to the triangles of meshes: depth is exact
/// to float precision and the same on every machine. A body that the camera is inside of is not
/// seen; a mesh is seen from both sides.
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

  [[nodiscard]] SceneCamera const& camera() const;
  /// As they stand at the caster's time.
  [[nodiscard]] PresentThings const& things() const;

  /// One ray through the centre of each pixel. The same at any number of threads.
  [[nodiscard]] RenderedView render(Se3 const& T_world_camera) const;

  /// The same rays through some pixels, which may lie outside the picture, one after the other; of
  /// `only`, as if that thing were alone.
  [[nodiscard]] std::vector<PixelHit> look(Se3 const& T_world_camera,
                                           std::vector<Pixel> const& pixels,
                                           std::optional<std::size_t> only = {}) const;

private:
  struct World;
  std::unique_ptr<World> world_;
};

}  // namespace credo
