#pragma once

#include "core/cloud.hpp"
#include "core/object_model.hpp"
#include "core/segmentation.hpp"
#include "stages/region_growing/region_growing.hpp"

namespace credo::test {

/// Algorithm 1 of the thesis, word for word, for each object in turn: the points inside the model
/// are its region and a queue; each point of the queue brings in all points within the radius and
/// the angle that are within the bounds and nobody's. Every point is tried against every other.
/// Slow, obvious, and the oracle of grow_objects.
LabelMap literal_regions(Frame const& frame, NormalMap const& normals,
                         Segmentation const& segmentation, ObjectModels const& models,
                         RegionGrowingConfig const& config);

}  // namespace credo::test
