#pragma once

#include <functional>
#include <memory>

#include "core/belief.hpp"
#include "core/cloud.hpp"
#include "core/detection.hpp"
#include "core/frame.hpp"
#include "core/object_model.hpp"
#include "core/prior_file.hpp"
#include "core/segmentation.hpp"
#include "geometry/shapes/known_surface.hpp"
#include "geometry/shapes/object_shape.hpp"
#include "graph/pipeline_config.hpp"
#include "stages/capture/level.hpp"

namespace credo {

/// What the nodes compute. Each function is pure, so that it may run for several frames at once,
/// except `detection` and `fusion`, which are called for one frame at a time, in order. A throw
/// costs the frame. Tests put fakes in.
struct Stages {
  std::function<NormalMap(Frame const&)> normals;
  /// Begins the segmentation with the known objects of the belief seen.
  std::function<Segmentation(Frame const&, NormalMap const&, BeliefState const& seen)> detection;
  std::function<Segmentation(Frame const&, NormalMap const&, Segmentation)> planes;
  std::function<Segmentation(Frame const&, NormalMap const&, Segmentation)> clustering;
  /// The belief after the frame, from the belief after the frame before.
  std::function<BeliefState(BeliefState, Segmentation const&)> fusion;
};

/// What a run knows of objects beside the belief; shared by its stages, asked by several threads.
struct KnownObjects {
  ObjectModels models;
  ObjectShapes shapes;
  KnownSurfaces surfaces;
  /// None: nobody looks for objects.
  std::unique_ptr<Detector> detector;
};

/// The real stages. `detection` asks the detector, lets the gate choose and takes the objects'
/// points out.
///
/// With capture.independent_frames every frame is segmented with the prior, fused into it and
/// levelled by itself; only then `prior` is used and `level` is not. Ids still are never used
/// twice.
Stages make_stages(PipelineConfig const& config, WorldLevel const& level, Prior const& prior,
                   std::shared_ptr<KnownObjects const> const& known);

/// The first half of the method, for one frame: everything up to the belief.
Segmentation segment(Stages const& stages, Frame const& frame, BeliefState const& seen);

}  // namespace credo
