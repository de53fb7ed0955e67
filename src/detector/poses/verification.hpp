#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/grid.hpp"
#include "detector/models/search_model.hpp"
#include "detector/poses/camera_pose.hpp"
#include "detector/scenes/search_scene.hpp"
#include "geometry/depth_patch.hpp"

namespace credo {

/// What a rendered model says to the scene, pixel by pixel.
enum class PixelVerdict : std::uint8_t {
  /// No surface of the model, or nothing is known of it.
  kNone,
  /// The scene is as deep as the model.
  kIn,
  /// On a plane larger than the model: it may be the plane alone.
  kBackground,
  /// The scene is seen through the model.
  kSeenThrough,
  /// A plane larger than the model stands before it: the model would be under a table, or behind a
  /// screen.
  kBehindPlane,
  /// Something stands before it.
  kOccluded,
  kUnmeasured,
};

/// How well a pose explains a scene, from a picture of all of the model.
struct Verification {
  int in_px = 0;
  int background_px = 0;
  int seen_through_px = 0;
  int behind_plane_px = 0;
  /// Of them, those behind a plane before which the model is, too: it would be sunk into a table.
  int sunk_px = 0;
  int occluded_px = 0;
  int no_depth_px = 0;
  /// Mean distance, over blocks of 8x8 pixels, of their mean depths, in halves of the sensor's
  /// deviation, each 4 at most: noise averages out, another shape does not.
  float block_misfit = 0.0F;
  /// How much less the depths stray from the model's than from a plane's, as the logarithm of a
  /// ratio; 0 for what is flat: a plane fits anything flat.
  float relief = 0.0F;
  /// Of the segments that it touches, the share that it explains.
  float explained = 0.0F;
  /// Share of its silhouette where the surface goes on beyond it.
  float outline_open = 0.0F;
  /// Share of the nearest view's silhouette, as far as it is not hidden, at which the scene's
  /// surface ends, too; drawn to a half where little of it is seen.
  float edges_found = 0.0F;
  /// Of the picture of the model alone, within the image, that is in or on background.
  float visible_fraction = 0.0F;
  /// That the pose is right, by all of the above.
  float log_odds = 0.0F;
  /// Pixels that it explains, as positions in the scene's grid, rising.
  std::vector<std::uint32_t> explained_px;

  /// What it explains of the picture, less what it gets wrong.
  [[nodiscard]] int net_px() const { return in_px - seen_through_px; }
  [[nodiscard]] int shown_px() const {
    return in_px + background_px + seen_through_px + behind_plane_px + occluded_px + no_depth_px;
  }
};

/// Pixels that other objects explain already; they hide what is behind and within them.
using ClaimedPixels = Grid<std::uint8_t>;

/// The log-odds beside a pose of the same object in the same place that explains so much: of a mug
/// whose handle is seen, those with the handle behind it explain the cup as well, and no handle.
/// Unchanged where it explains no less.
[[nodiscard]] float log_odds_beside(Verification const& verification, int most_net_px);

/// Renders the model and holds it against the scene. `claimed` is empty, or as large as the image.
[[nodiscard]] Verification verified(SearchModel const& model, SearchScene const& scene,
                                    CameraPose const& pose, ClaimedPixels const& claimed);

}  // namespace credo
