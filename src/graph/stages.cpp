#include "graph/stages.hpp"

#include <optional>
#include <utility>
#include <vector>

#include "geometry/pose_fusion.hpp"
#include "geometry/sight.hpp"
#include "stages/segments/settling.hpp"
#include "stages/segments/things.hpp"

namespace credo {
namespace {

using KnownObjectsPtr = std::shared_ptr<KnownObjects const>;

Segmentation begin_segmentation(Frame const& frame, WorldLevel const& level,
                                BeliefState const& seen) {
  Segmentation segmentation = unassigned_segmentation(
      frame, seen.T_world_told * level.T_world_source * frame.T_source_camera, seen.frame);
  segmentation.T_world_told = seen.T_world_told;
  segmentation.floor_at_zero = level.floor_found;
  return segmentation;
}

/// Where the observed objects most likely are: as belief and detection together tell.
std::vector<PoseDistribution> likeliest_poses(Segmentation const& segmentation,
                                              BeliefState const& seen) {
  std::vector<PoseDistribution> poses_world;
  for (ObjectObservation const& object : segmentation.objects) {
    poses_world.push_back(
        updated_pose(seen.objects[object.object].pose_world, object.pose_world, object.symmetry));
  }
  return poses_world;
}

/// None where nobody looked.
std::optional<std::vector<Detection>> detections_in(Frame const& frame,
                                                    std::vector<DetectionRequest> const& requests,
                                                    Detector& detector) {
  try {
    return detector.detect(frame, requests);
  } catch (NobodyLooked const&) {
    return std::nullopt;
  }
}

/// Method section 1, steps 2 and 3.
Segmentation find_objects(Frame const& frame, NormalMap const& normals, Segmentation segmentation,
                          BeliefState const& seen, KnownObjects const& known,
                          PipelineConfig const& config) {
  if (known.detector == nullptr || seen.objects.empty()) {
    return segmentation;
  }
  std::optional<std::vector<Detection>> const detections =
      detections_in(frame, detection_requests(seen, segmentation.T_world_camera), *known.detector);
  if (!detections.has_value()) {
    return segmentation;
  }
  segmentation =
      match_detections(std::move(segmentation), seen, *detections, known.models, config.detection);
  if (!config.region_growing.from_belief) {
    return grow_objects(frame, normals, std::move(segmentation), known.shapes,
                        config.region_growing);
  }
  std::vector<PoseDistribution> const poses_world = likeliest_poses(segmentation, seen);
  return grow_objects(frame, normals, std::move(segmentation), poses_world, known.shapes,
                      config.region_growing);
}

/// Which way is up is known where the level is.
Segmentation with_segments(Frame const& frame, Segmentation segmentation,
                           SegmentsConfig const& config) {
  std::optional<Eigen::Vector3d> up_camera;
  if (segmentation.floor_at_zero) {
    up_camera = segmentation.T_world_camera.rotation().inverse() * Eigen::Vector3d::UnitZ();
  }
  segmentation.segments = segment_things(frame, up_camera, config);
  return segmentation;
}

void make_independent(Stages& stages, PipelineConfig const& config, Prior const& prior,
                      KnownObjectsPtr const& known) {
  stages.detection = [config, prior, known](Frame const& frame, NormalMap const& normals,
                                            BeliefState const&) {
    // The level finder takes shared frames; this one outlives the call.
    FramePtr const borrowed(FramePtr{}, &frame);
    WorldLevel const level = find_level({&borrowed, 1}, config.pose);
    BeliefState const seen = prior_belief(prior, level.T_world_source * frame.T_source_camera);
    return find_objects(frame, normals, begin_segmentation(frame, level, seen), seen, *known,
                        config);
  };
  stages.fusion = [config, prior, known](BeliefState const& latest,
                                         Segmentation const& segmentation) {
    BeliefState fresh = prior_belief(prior, segmentation.T_world_camera);
    fresh.next_wall_id = latest.next_wall_id;
    fresh.next_stuff_id = latest.next_stuff_id;
    return fuse(std::move(fresh), segmentation, config.fusion, known->surfaces);
  };
}

}  // namespace

Stages make_stages(PipelineConfig const& config, WorldLevel const& level, Prior const& prior,
                   KnownObjectsPtr const& known) {
  Stages stages;
  stages.normals = [config](Frame const& frame) {
    return estimate_normals(frame.cloud_camera, frame.intrinsics, config.normals);
  };
  stages.detection = [config, level, known](Frame const& frame, NormalMap const& normals,
                                            BeliefState const& seen) {
    return find_objects(frame, normals, begin_segmentation(frame, level, seen), seen, *known,
                        config);
  };
  stages.planes = [config](Frame const& frame, NormalMap const& normals, Segmentation so_far) {
    if (config.segments.enabled) {
      so_far = settle_objects(with_segments(frame, std::move(so_far), config.segments));
    }
    return extract_planes(frame, normals, std::move(so_far), config.planes);
  };
  stages.clustering = [config](Frame const& frame, NormalMap const& normals, Segmentation so_far) {
    so_far = cluster_stuff(frame, normals, std::move(so_far), config.clustering);
    if (config.fusion.visibility || config.fusion.drift.enabled) {
      so_far.sight = sight_of(frame.cloud_camera.z, so_far.labels, frame.intrinsics);
    }
    if (config.fusion.drift.enabled) {
      so_far.sight.normals_camera = middle_normals(normals, so_far.sight);
    }
    return so_far;
  };
  stages.fusion = [config, known](BeliefState belief, Segmentation const& segmentation) {
    return fuse(std::move(belief), segmentation, config.fusion, known->surfaces);
  };
  if (config.capture.independent_frames) {
    make_independent(stages, config, prior, known);
  }
  return stages;
}

Segmentation segment(Stages const& stages, Frame const& frame, BeliefState const& seen) {
  NormalMap const normals = stages.normals(frame);
  Segmentation segmentation = stages.detection(frame, normals, seen);
  segmentation = stages.planes(frame, normals, std::move(segmentation));
  return stages.clustering(frame, normals, std::move(segmentation));
}

}  // namespace credo
