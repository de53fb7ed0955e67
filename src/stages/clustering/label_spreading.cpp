#include "stages/clustering/label_spreading.hpp"

#include <cstddef>
#include <vector>

#include "geometry/reachability/reachability.hpp"

namespace credo {
namespace {

struct NewLabel {
  std::size_t pixel = 0;
  LabelCode label = kUnassigned;
};

bool has_label(LabelCode code) {
  return code != kNoDepth && code != kUnassigned;
}

// The label of the nearest labelled neighbour, or kUnassigned.
LabelCode label_of_nearest(OrganizedCloud const& cloud, LabelMap const& labels, std::size_t pixel,
                           float radius_m) {
  Pixel const center = labels.pixel(pixel);
  LabelCode label = kUnassigned;
  float nearest = radius_m * radius_m;
  for (int v = center.v - 1; v <= center.v + 1; ++v) {
    for (int u = center.u - 1; u <= center.u + 1; ++u) {
      if (!labels.contains({u, v}) || !has_label(labels[{u, v}])) {
        continue;
      }
      Eigen::Vector3f const step = cloud.at({u, v}) - cloud.at(pixel);
      float const distance = ordered_squared_norm(step.x(), step.y(), step.z());
      bool const first_at_limit = label == kUnassigned && distance == nearest;
      if (distance < nearest || first_at_limit) {
        nearest = distance;
        label = labels[{u, v}];
      }
    }
  }
  return label;
}

}  // namespace

LabelMap spread_labels(OrganizedCloud const& cloud, NormalMap const& normals, LabelMap labels,
                       float radius_m, int max_steps) {
  std::vector<std::size_t> waiting;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == kUnassigned && !normals.valid(i)) {
      waiting.push_back(i);
    }
  }
  std::vector<NewLabel> taken;
  for (int step = 0; step < max_steps; ++step) {
    taken.clear();
    std::erase_if(waiting, [&](std::size_t pixel) {
      LabelCode const label = label_of_nearest(cloud, labels, pixel, radius_m);
      if (label != kUnassigned) {
        taken.push_back({.pixel = pixel, .label = label});
      }
      return label != kUnassigned;
    });
    if (taken.empty()) {
      break;
    }
    for (NewLabel const& next : taken) {
      labels[next.pixel] = next.label;
    }
  }
  return labels;
}

}  // namespace credo
