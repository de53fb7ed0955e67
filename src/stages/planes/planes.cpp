#include "stages/planes/planes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "geometry/cell_sums.hpp"
#include "geometry/segment_shares.hpp"
#include "geometry/thinning.hpp"
#include "stages/planes/pixel_boxes.hpp"
#include "stages/planes/plane_pixels.hpp"
#include "stages/planes/plane_sample.hpp"
#include "stages/planes/segment_pieces.hpp"

namespace credo {
namespace {

/// So many tolerances from the plane is near enough for what is on its segment anyway.
constexpr float kNear = 3.0F;

/// What every step looks at. Planes are searched for where the depths are: in the camera frame.
struct View {
  OrganizedCloud const& cloud;
  NormalMap const& normals;
  Se3 const& T_world_camera;
  PlanesConfig const& config;
  PlaneTolerance tolerance;
  PixelBoxes boxes;
  SegmentPieces pieces;
  /// All pixels with depth.
  CountedPixels valid;
};

/// A plane with its pixels.
struct PixelPlane {
  Plane camera;
  /// The same plane in the world frame.
  Plane world;
  CountedPixels inliers;
};

PlaneTolerance tolerance_of(PlanesConfig const& config) {
  constexpr double kRightAngle = 1.5707963;
  return {static_cast<float>(config.inlier_distance_m), static_cast<float>(config.noise_sigmas),
          config.max_angle_rad < kRightAngle ? static_cast<float>(std::cos(config.max_angle_rad))
                                             : 0.0F};
}

CountedPixels unassigned_pixels(LabelMap const& labels, Segments const& segments) {
  CountedPixels pixels = pixels_where(
      labels.size(), [codes = labels.data()](std::size_t i) { return codes[i] == kUnassigned; });
  if (std::ranges::all_of(segments.lies_on, [](std::int32_t base) { return base == 0; })) {
    return pixels;
  }
  // What lies on a surface is near to its plane, but nothing of it.
  CountedPixels lying{PixelSet(labels.size()), 0};
  pixels.pixels.for_each([&](std::size_t i) {
    std::int32_t const segment = segments.labels[i];
    if (segment != 0 && segments.lies_on[static_cast<std::size_t>(segment - 1)] != 0) {
      lying.insert(i);
    }
  });
  pixels.remove(lying);
  return pixels;
}

CountedPixels pixels_with_depth(LabelMap const& labels) {
  return pixels_where(labels.size(),
                      [codes = labels.data()](std::size_t i) { return codes[i] != kNoDepth; });
}

/// Those of the pixels that belong to a plane.
CountedPixels inliers_among(View const& view, Plane const& plane_camera, PixelSet const& pixels,
                            PlaneTolerance const& tolerance) {
  return plane_inliers(plane_camera, view.cloud, view.normals,
                       view.boxes.near(plane_camera, pixels, tolerance), tolerance);
}

/// What no plane has taken yet (thesis algorithm 2). Planes are found and fitted on a sample of it,
/// then every pixel is asked.
class RemainingPoints {
public:
  RemainingPoints(View const& view, CountedPixels pixels)
      : view_(view), pixels_(std::move(pixels)), eligible_(view.pieces.counts(pixels_.pixels)) {}

  /// Fits what a floor or wall has taken to the segments: all of those that it holds most of, as
  /// far as they keep near, and nothing of those that it holds little of.
  void settle(PixelPlane& plane) {
    if (view_.pieces.empty()) {
      return;
    }
    std::vector<std::uint32_t> const held = view_.pieces.counts(plane.inliers.pixels);
    auto const share = [&](std::size_t segment) {
      return segment == 0
                 ? 0.5
                 : static_cast<double>(held[segment]) / static_cast<double>(eligible_[segment]);
    };
    CountedPixels const back = view_.pieces.where(
        plane.inliers.pixels, [&](std::size_t segment) { return share(segment) <= kHardlyShare; });
    CountedPixels near = view_.pieces.where(
        pixels_.pixels, [&](std::size_t segment) { return share(segment) >= kMostlyShare; });
    PlaneTolerance const wide{kNear * view_.tolerance.fixed_m, kNear * view_.tolerance.noise_sigmas,
                              0.0F};
    near = inliers_among(view_, plane.camera, near.pixels, wide);
    pixels_.remove(near);
    plane.inliers.remove(back);
    plane.inliers.insert(near);
    pixels_.insert(back);
    std::vector<std::uint32_t> const taken = view_.pieces.counts(plane.inliers.pixels);
    std::ranges::transform(eligible_, taken, eligible_.begin(), std::minus());
  }

  /// Takes the largest plane out; none once it has fewer pixels than a plane must have.
  std::optional<PixelPlane> take_largest(std::uint32_t seed) {
    PlanesConfig const& config = view_.config;
    auto const least = static_cast<std::size_t>(config.min_plane_pixels);
    if (pixels_.count < least) {
      return std::nullopt;
    }
    refresh_sample();
    std::optional<FoundPlane> const found =
        find_largest_plane(sample_, {config.sampling, config.max_angle_rad, config.confidence,
                                     config.max_hypotheses, config.scoring_points, seed});
    if (!found) {
      return std::nullopt;
    }
    CountedPixels inliers = inliers_among(view_, found->plane, pixels_.pixels, view_.tolerance);
    if (inliers.count < least) {
      return std::nullopt;
    }
    pixels_.remove(inliers);
    sample_.remove(found->inliers);
    return oriented(found->plane, std::move(inliers));
  }

private:
  /// Planes thin the sample out: once half of it has gone, what remains is sampled anew.
  void refresh_sample() {
    auto const most = static_cast<std::size_t>(view_.config.sample_points);
    if (2 * sample_.size() >= std::min(most, pixels_.count)) {
      return;
    }
    sample_ = sample_of(pixels_, most, view_.cloud, view_.normals, view_.tolerance);
  }

  /// With the normal up.
  [[nodiscard]] PixelPlane oriented(Plane const& camera, CountedPixels inliers) const {
    Plane const world = transformed(view_.T_world_camera, camera);
    bool const up = world.normal.z() >= 0.0;
    return {up ? camera : camera.flipped(), up ? world : world.flipped(), std::move(inliers)};
  }

  View const& view_;
  CountedPixels pixels_;
  /// Of each segment, how many pixels neither floor nor wall nor object has taken.
  std::vector<std::uint32_t> eligible_;
  PlaneSearchPoints sample_;
};

/// Height above z = 0 of a pixel.
class Heights {
public:
  explicit Heights(View const& view)
      : cloud_(view.cloud),
        up_(view.T_world_camera.rotation().toRotationMatrix().row(2).cast<float>()),
        camera_m_(static_cast<float>(view.T_world_camera.translation().z())) {}

  [[nodiscard]] float operator()(std::size_t pixel) const {
    return up_.dot(cloud_.at(pixel)) + camera_m_;
  }

private:
  OrganizedCloud const& cloud_;
  Eigen::Vector3f up_;
  float camera_m_;
};

/// Thesis 3.2: horizontal, and at z = 0.
bool is_floor(View const& view, PixelPlane const& plane) {
  PlanesConfig const& config = view.config;
  Eigen::Vector3d const& n = plane.world.normal;
  if (std::abs(n.x()) > config.floor_max_normal_xy ||
      std::abs(n.y()) > config.floor_max_normal_xy ||
      std::abs(n.z() - 1.0) > config.floor_max_normal_z_gap) {
    return false;
  }
  Heights const height_m(view);
  double sum_m = 0.0;
  plane.inliers.pixels.for_each(
      [&](std::size_t i) { sum_m += static_cast<double>(std::abs(height_m(i))); });
  return sum_m <= config.floor_max_mean_height_m * static_cast<double>(plane.inliers.count);
}

/// Those near enough to z = 0.
CountedPixels low_pixels(View const& view, CountedPixels pixels) {
  if (view.config.floor_max_height_m == 0.0) {
    return pixels;
  }
  auto const most_m = static_cast<float>(view.config.floor_max_height_m);
  Heights const height_m(view);
  CountedPixels high{PixelSet(view.cloud.size()), 0};
  pixels.pixels.for_each([&](std::size_t i) {
    if (std::abs(height_m(i)) > most_m) {
      high.pixels.insert(i);
      ++high.count;
    }
  });
  pixels.remove(high);
  return pixels;
}

/// Height from the lowest to the highest pixel, without the outermost per cent at either end.
double vertical_extent_m(View const& view, PixelPlane const& plane) {
  Heights const height_m(view);
  std::vector<float> heights;
  heights.reserve(plane.inliers.count);
  plane.inliers.pixels.for_each([&](std::size_t i) { heights.push_back(height_m(i)); });
  auto const cut = static_cast<std::ptrdiff_t>(heights.size() / 100);
  auto const top = static_cast<std::ptrdiff_t>(heights.size()) - 1 - cut;
  std::nth_element(heights.begin(), heights.begin() + cut, heights.end());
  float const low_m = heights[static_cast<std::size_t>(cut)];
  std::nth_element(heights.begin(), heights.begin() + top, heights.end());
  return static_cast<double>(heights[static_cast<std::size_t>(top)] - low_m);
}

/// Thesis 3.2: vertical, with nearly nothing beyond it.
bool is_wall(View const& view, PixelPlane const& plane) {
  PlanesConfig const& config = view.config;
  Eigen::Vector3d const n = plane.world.normal.cwiseAbs();
  if (!(n.z() < config.wall_max_normal_z) ||
      !(std::max(n.x(), n.y()) > config.wall_min_normal_xy) ||
      plane.inliers.count < static_cast<std::size_t>(config.wall_min_pixels)) {
    return false;
  }
  SideCounts const sides = count_sides(plane.camera, view.cloud, view.valid.pixels, view.tolerance);
  double const allowed =
      std::max(static_cast<double>(config.wall_max_points_beyond),
               config.wall_max_share_beyond * static_cast<double>(plane.inliers.count));
  // The camera is at the origin.
  bool const faces_camera = plane.camera.signed_distance_m(Eigen::Vector3d::Zero()) >= 0.0;
  std::size_t const behind = faces_camera ? sides.back : sides.front;
  std::size_t const beyond =
      config.wall_beyond == WallBeyond::kBehind ? behind : std::min(sides.front, sides.back);
  return static_cast<double>(beyond) <= allowed &&
         vertical_extent_m(view, plane) >= config.wall_min_extent_m;
}

/// Writes the label on the plane's pixels and returns their world points, thinned.
PointList label_pixels(View const& view, PixelPlane const& plane, LabelCode code,
                       LabelMap& labels) {
  CellSums cells(static_cast<float>(view.config.point_spacing_m), view.T_world_camera);
  auto const run_of = [](Grid<float> const& grid, std::size_t begin, std::size_t end) {
    return std::span<float const>(grid.data() + begin, end - begin);
  };
  plane.inliers.pixels.for_each_run([&](std::size_t begin, std::size_t end) {
    std::fill(labels.data() + begin, labels.data() + end, code);
    cells.add({run_of(view.cloud.x, begin, end), run_of(view.cloud.y, begin, end),
               run_of(view.cloud.z, begin, end)});
  });
  PointList points;
  cells.append_means(0, points);
  return points;
}

void add_floor(View const& view, PixelPlane plane, Segmentation& segmentation) {
  plane.inliers = low_pixels(view, std::move(plane.inliers));
  PointList added = label_pixels(view, plane, kFloor, segmentation.labels);
  if (!segmentation.floor) {
    segmentation.floor = FloorObservation{plane.world, std::move(added), plane.inliers.count};
    return;
  }
  // A later plane that passes too is more of the same floor; the largest one's fit stays.
  FloorObservation& floor = *segmentation.floor;
  floor.points_world.insert(floor.points_world.end(), added.begin(), added.end());
  floor.points_world =
      thin_points(floor.points_world, static_cast<float>(view.config.point_spacing_m));
  floor.pixel_count += plane.inliers.count;
}

void add_wall(View const& view, PixelPlane const& plane, Segmentation& segmentation) {
  WallObservation wall;
  wall.label = static_cast<LabelCode>(kFirstWall + segmentation.walls.size());
  bool const faces_camera = plane.world.signed_distance_m(view.T_world_camera.translation()) >= 0.0;
  wall.plane_world = faces_camera ? plane.world : plane.world.flipped();
  wall.points_world = label_pixels(view, plane, wall.label, segmentation.labels);
  wall.pixel_count = plane.inliers.count;
  segmentation.walls.push_back(std::move(wall));
}

/// Of some pixels, those in segments that nothing has, or that these are most of; of all without
/// segments.
CountedPixels whole_segments(View const& view, CountedPixels pixels,
                             CountedPixels const& unassigned) {
  if (view.pieces.empty()) {
    return pixels;
  }
  std::vector<std::uint32_t> const all = view.pieces.counts(unassigned.pixels);
  std::vector<std::uint32_t> const some = view.pieces.counts(pixels.pixels);
  pixels.remove(view.pieces.where(pixels.pixels, [&](std::size_t segment) {
    return segment != 0 && some[segment] < kMostlyShare * all[segment];
  }));
  return pixels;
}

/// Noise turns normals before it moves points: with an angle to pass, a wall far away is full of
/// holes. And a plane that was neither floor nor wall may have taken some of theirs. So pixels that
/// nothing has explained join floor or wall where they all but lie in it, whatever their normals;
/// the planes themselves stay as fitted.
void fill_holes(View const& view, std::vector<std::pair<LabelCode, Plane>> const& found,
                Segmentation& segmentation) {
  constexpr float kAllBut = 0.5F;
  PlaneTolerance const close{kAllBut * view.tolerance.fixed_m,
                             kAllBut * view.tolerance.noise_sigmas, 0.0F};
  CountedPixels unassigned = unassigned_pixels(segmentation.labels, segmentation.segments);
  for (auto const& [label, plane_camera] : found) {
    CountedPixels joining = inliers_among(view, plane_camera, unassigned.pixels, close);
    joining = whole_segments(view, std::move(joining), unassigned);
    if (label == kFloor) {
      joining = low_pixels(view, std::move(joining));
    }
    joining.pixels.for_each([&, code = label](std::size_t i) { segmentation.labels[i] = code; });
    unassigned.remove(joining);
  }
}

}  // namespace

Segmentation extract_planes(Frame const& frame, NormalMap const& normals, Segmentation segmentation,
                            PlanesConfig const& config) {
  View const view{frame.cloud_camera,
                  normals,
                  segmentation.T_world_camera,
                  config,
                  tolerance_of(config),
                  PixelBoxes(frame.cloud_camera),
                  SegmentPieces(segmentation.segments),
                  pixels_with_depth(segmentation.labels)};
  RemainingPoints remaining(view, unassigned_pixels(segmentation.labels, segmentation.segments));
  std::vector<std::pair<LabelCode, Plane>> found;
  for (int k = 0; k < config.max_planes; ++k) {
    std::optional<PixelPlane> plane = remaining.take_largest(
        static_cast<std::uint32_t>(config.seed) + static_cast<std::uint32_t>(k));
    if (!plane) {
      break;
    }
    if (segmentation.floor_at_zero && is_floor(view, *plane)) {
      remaining.settle(*plane);
      add_floor(view, *plane, segmentation);
      found.emplace_back(kFloor, plane->camera);
    } else if (segmentation.walls.size() < kMaxWalls && is_wall(view, *plane)) {
      remaining.settle(*plane);
      add_wall(view, *plane, segmentation);
      found.emplace_back(segmentation.walls.back().label, plane->camera);
    }
  }
  if (view.tolerance.min_cosine > 0.0F) {
    fill_holes(view, found, segmentation);
  }
  return segmentation;
}

}  // namespace credo
