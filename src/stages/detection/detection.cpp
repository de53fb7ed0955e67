#include "stages/detection/detection.hpp"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "geometry/pose_fusion.hpp"

namespace credo {
namespace {

/// A detection and an object of its type.
struct Pair {
  std::size_t object = 0;
  std::size_t detection = 0;
  PoseMatch match;
};

Symmetry symmetry_of(ObjectBelief const& object, ObjectModels const& models) {
  auto const model = models.find(object.type);
  return model != models.end() ? model->second.symmetry : Symmetry{};
}

/// The gate's limit on the squared distance, by degrees of freedom.
class Gate {
public:
  explicit Gate(DetectionConfig const& config)
      : limit_with_axis_(limit(config, 5)), limit_(limit(config, 6)) {}

  [[nodiscard]] double limit_for(PoseMatch const& match) const {
    return match.degrees_of_freedom == 5 ? limit_with_axis_ : limit_;
  }
  [[nodiscard]] bool passes(PoseMatch const& match) const {
    return match.squared_distance <= limit_for(match);
  }

private:
  static double limit(DetectionConfig const& config, double degrees_of_freedom) {
    return boost::math::quantile(boost::math::chi_squared(degrees_of_freedom),
                                 config.gate_quantile);
  }

  double limit_with_axis_;
  double limit_;
};

void check(Detection const& detection) {
  PoseDistribution const& pose = detection.pose_camera;
  bool const finite = pose.mean.matrix().allFinite() && pose.covariance.allFinite();
  if (!finite || Eigen::LLT<Matrix6d>(pose.covariance).info() != Eigen::Success) {
    throw std::runtime_error(
        "the detector gave a " + detection.type + " whose " +
        (finite ? "covariance is not positive definite" : "pose or covariance is not finite"));
  }
}

std::vector<Pair> pairs_of(BeliefState const& seen,
                           std::vector<PoseDistribution> const& poses_world,
                           std::vector<Detection> const& detections, ObjectModels const& models) {
  std::vector<Pair> pairs;
  for (std::size_t o = 0; o < seen.objects.size(); ++o) {
    ObjectBelief const& object = seen.objects[o];
    Symmetry const symmetry = symmetry_of(object, models);
    for (std::size_t d = 0; d < detections.size(); ++d) {
      if (detections[d].type == object.type) {
        pairs.push_back({o, d, match_pose(object.pose_world, poses_world[d], symmetry)});
      }
    }
  }
  std::ranges::sort(pairs, {}, [](Pair const& pair) {
    return std::tuple(pair.match.squared_distance + pair.match.log_determinant, pair.object,
                      pair.detection);
  });
  return pairs;
}

ObjectObservation observation_of(ObjectBelief const& object, Pair const& pair,
                                 Detection const& detection, PoseDistribution const& pose_world,
                                 ObjectModels const& models) {
  ObjectObservation observation;
  observation.label = static_cast<LabelCode>(kFirstObject + pair.object);
  observation.object = pair.object;
  observation.object_id = object.id;
  observation.type = object.type;
  observation.pose_world = pose_world;
  observation.errors_repeat = detection.errors_repeat;
  observation.symmetry = symmetry_of(object, models);
  return observation;
}

/// `nearest`: to the nearest object, if any has its type.
RefusedDetection refusal_of(Detection const& detection, PoseDistribution const& pose_world,
                            Pair const* nearest, BeliefState const& seen, Gate const& gate) {
  RefusedDetection refused;
  refused.type = detection.type;
  refused.pose_world = pose_world;
  refused.errors_repeat = detection.errors_repeat;
  refused.squared_distance = std::numeric_limits<double>::infinity();
  if (nearest != nullptr) {
    refused.object_id = seen.objects[nearest->object].id;
    refused.squared_distance = nearest->match.squared_distance;
    refused.max_squared_distance = gate.limit_for(nearest->match);
  }
  return refused;
}

}  // namespace

FieldList fields(DetectionConfig& config) {
  return {
      {"gate_quantile",
       &config.gate_quantile,
       {0.5, 1.0 - 1e-9},
       "",
       "a detection counts within this quantile of where its object's pose distribution expects "
       "it"},
  };
}

std::vector<DetectionRequest> detection_requests(BeliefState const& seen,
                                                 Se3 const& T_world_camera) {
  Se3 const T_camera_world = T_world_camera.inverse();
  std::vector<DetectionRequest> requests;
  requests.reserve(seen.objects.size());
  for (ObjectBelief const& object : seen.objects) {
    requests.push_back({object.id, object.type, transformed(T_camera_world, object.pose_world)});
  }
  return requests;
}

Segmentation match_detections(Segmentation segmentation, BeliefState const& seen,
                              std::vector<Detection> const& detections, ObjectModels const& models,
                              DetectionConfig const& config) {
  std::vector<PoseDistribution> poses_world;
  for (Detection const& detection : detections) {
    check(detection);
    poses_world.push_back(transformed(segmentation.T_world_camera, detection.pose_camera));
  }
  Gate const gate(config);
  std::vector<Pair> const pairs = pairs_of(seen, poses_world, detections, models);
  std::vector<Pair const*> of_object(seen.objects.size(), nullptr);
  std::vector<Pair const*> nearest(detections.size(), nullptr);
  std::vector<bool> taken(detections.size(), false);
  for (Pair const& pair : pairs) {
    Pair const*& near = nearest[pair.detection];
    if (near == nullptr || pair.match.squared_distance < near->match.squared_distance) {
      near = &pair;
    }
    if (of_object[pair.object] == nullptr && !taken[pair.detection] && gate.passes(pair.match)) {
      of_object[pair.object] = &pair;
      taken[pair.detection] = true;
    }
  }
  for (Pair const* pair : of_object) {
    if (pair != nullptr) {
      segmentation.objects.push_back(observation_of(seen.objects[pair->object], *pair,
                                                    detections[pair->detection],
                                                    poses_world[pair->detection], models));
    }
  }
  for (std::size_t d = 0; d < detections.size(); ++d) {
    if (!taken[d]) {
      segmentation.refused.push_back(
          refusal_of(detections[d], poses_world[d], nearest[d], seen, gate));
    }
  }
  segmentation.objects_looked_for = true;
  return segmentation;
}

}  // namespace credo
