#include "graph/stages.hpp"

#include <utility>

namespace credo {
namespace {

Segmentation begin_segmentation(Frame const& frame, WorldLevel const& level,
                                BeliefState const& seen) {
  Segmentation segmentation =
      unassigned_segmentation(frame, level.T_world_source * frame.T_source_camera, seen.frame);
  segmentation.floor_at_zero = level.floor_found;
  return segmentation;
}

void make_independent(Stages& stages, PipelineConfig const& config, BeliefPtr const& prior) {
  stages.detection = [config, prior](Frame const& frame, NormalMap const&, BeliefState const&) {
    // The level finder takes shared frames; this one outlives the call.
    FramePtr const borrowed(FramePtr{}, &frame);
    return begin_segmentation(frame, find_level({&borrowed, 1}, config.pose), *prior);
  };
  stages.fusion = [config, prior](BeliefState const& latest, Segmentation const& segmentation) {
    BeliefState fresh = *prior;
    fresh.next_wall_id = latest.next_wall_id;
    fresh.next_stuff_id = latest.next_stuff_id;
    return fuse(std::move(fresh), segmentation, config.fusion);
  };
}

}  // namespace

Stages make_stages(PipelineConfig const& config, WorldLevel const& level, BeliefPtr const& prior) {
  Stages stages;
  stages.normals = [config](Frame const& frame) {
    return estimate_normals(frame.cloud_camera, frame.intrinsics, config.normals);
  };
  stages.detection = [level](Frame const& frame, NormalMap const&, BeliefState const& seen) {
    return begin_segmentation(frame, level, seen);
  };
  stages.planes = [config](Frame const& frame, NormalMap const& normals, Segmentation so_far) {
    return extract_planes(frame, normals, std::move(so_far), config.planes);
  };
  stages.clustering = [config](Frame const& frame, NormalMap const& normals, Segmentation so_far) {
    return cluster_stuff(frame, normals, std::move(so_far), config.clustering);
  };
  stages.fusion = [config](BeliefState belief, Segmentation const& segmentation) {
    return fuse(std::move(belief), segmentation, config.fusion);
  };
  if (config.capture.independent_frames) {
    make_independent(stages, config, prior);
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
