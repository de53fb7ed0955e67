#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "detector/models/search_model.hpp"
#include "detector/poses/camera_pose.hpp"
#include "detector/poses/verification.hpp"
#include "detector/scenes/search_scene.hpp"

namespace credo {

/// How well some of a model's points, at a pose, agree with a scene.
class PoseScore {
public:
  PoseScore(SearchModel const& model, SearchScene const& scene);
  /// Beside other objects, which must outlive the score as well: a surface that they explain
  /// (`explained` is empty, or as large as the image) speaks against a pose that lies on it as much
  /// as one that is seen through.
  PoseScore(SearchModel const& model, SearchScene const& scene, ClaimedPixels const& explained);

  /// Of the first `points` that the nearest view shows: those whose depth and normal agree, less
  /// those that the scene is seen through, over those that are not hidden; less what of the
  /// silhouette lies within one surface. At most 1; a pose that is not before the camera, or
  /// from which a one-sided model shows nothing, has kWorst.
  [[nodiscard]] float operator()(CameraPose const& pose, std::size_t points) const;

  /// The same without the silhouette, of few points: for a first choice among thousands.
  [[nodiscard]] float rough(CameraPose const& pose, std::size_t points) const;

  static constexpr float kWorst = -10.0F;

private:
  [[nodiscard]] bool background(ScenePixel const& pixel) const {
    return pixel.plane != kNoPlane && large_plane_[pixel.plane];
  }
  [[nodiscard]] bool is_explained(Pixel pixel) const {
    return explained_ != nullptr && (*explained_)[pixel] != 0;
  }
  /// The view of a pose; null where it is not before the camera, or shows nothing.
  [[nodiscard]] ModelView const* view_of(CameraPose const& pose) const;
  [[nodiscard]] float fit(ModelView const& view, CameraPose const& pose, std::size_t points) const;
  [[nodiscard]] float outline_loss(ModelView const& view, CameraPose const& pose) const;

  SearchModel const& model_;
  SearchScene const& scene_;
  /// None where nothing is.
  ClaimedPixels const* explained_ = nullptr;
  /// By position in SearchScene::planes.
  std::vector<bool> large_plane_;
};

}  // namespace credo
