#include "stages/clustering/clustering.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "geometry/label_bits.hpp"
#include "geometry/reachability/reachability.hpp"
#include "stages/clustering/firm_pixels.hpp"
#include "stages/clustering/label_spreading.hpp"
#include "stages/clustering/stuff_clusters.hpp"

namespace credo {
namespace {

using Runs = std::vector<ComponentRun>;

void check(Frame const& frame, NormalMap const& normals, Segmentation const& segmentation) {
  Grid<float> const& depth = frame.cloud_camera.z;
  if (!depth.same_size(normals.z) || !depth.same_size(segmentation.labels)) {
    throw std::logic_error("cluster_stuff: a cloud of " + std::to_string(depth.width()) + "x" +
                           std::to_string(depth.height()) +
                           " pixels needs normals and labels of that size");
  }
  if (!segmentation.stuff.empty()) {
    throw std::logic_error("cluster_stuff: the segmentation already holds " +
                           std::to_string(segmentation.stuff.size()) + " clusters of stuff");
  }
}

// Of the pixels that nothing explains, those that join by distance and angle.
Runs reachable_components(Frame const& frame, NormalMap const& normals,
                          Segmentation const& segmentation, ClusteringConfig const& config) {
  LabelMap const& labels = segmentation.labels;
  Grid<std::uint8_t> active(labels.width(), labels.height());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    active[i] = static_cast<std::uint8_t>(labels[i] == kUnassigned);
  }
  return component_runs(frame.cloud_camera, normals, active,
                        {.radius_m = static_cast<float>(config.radius_m),
                         .max_angle_rad = static_cast<float>(config.max_angle_rad)});
}

// Of the pixels that nothing explains, those of one segment each; numbered from 0 in raster order.
Runs segment_components(Segmentation const& segmentation) {
  LabelMap const& labels = segmentation.labels;
  Grid<std::int32_t> const& segments = segmentation.segments.labels;
  std::vector<std::int32_t> number_of(segmentation.segments.pixel_counts.size() + 1, -1);
  std::int32_t count = 0;
  Runs runs;
  for (int v = 0; v < labels.height(); ++v) {
    std::span<LabelCode const> const label = labels.row(v);
    std::span<std::int32_t const> const segment = segments.row(v);
    for_each_run(label, segment, [&](std::size_t begin, std::size_t end) {
      if (label[begin] != kUnassigned || segment[begin] == 0) {
        return;
      }
      std::int32_t& number = number_of[static_cast<std::size_t>(segment[begin])];
      number = number < 0 ? count++ : number;
      runs.push_back({.v = v,
                      .begin = static_cast<int>(begin),
                      .end = static_cast<int>(end),
                      .component = number});
    });
  }
  return runs;
}

// Pixels of each component.
std::vector<std::size_t> sizes_of(Runs const& runs) {
  std::vector<std::size_t> sizes;
  for (ComponentRun const& run : runs) {
    auto const id = static_cast<std::size_t>(run.component);
    if (id == sizes.size()) {
      sizes.push_back(0);
    }
    sizes[id] += static_cast<std::size_t>(run.end - run.begin);
  }
  return sizes;
}

// The label of each component: those that are large enough, the largest if there are too many, by
// first pixel.
std::vector<LabelCode> labels_of(std::vector<std::size_t> const& sizes, std::size_t min_pixels) {
  std::vector<std::size_t> kept(sizes.size());
  std::iota(kept.begin(), kept.end(), 0U);
  std::erase_if(kept, [&](std::size_t id) { return sizes[id] < min_pixels; });
  if (kept.size() > kMaxStuff) {
    std::stable_sort(kept.begin(), kept.end(),
                     [&](std::size_t a, std::size_t b) { return sizes[a] > sizes[b]; });
    kept.resize(kMaxStuff);
    std::sort(kept.begin(), kept.end());
  }
  std::vector<LabelCode> labels(sizes.size(), kUnassigned);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    labels[kept[i]] = static_cast<LabelCode>(kFirstStuff + i);
  }
  return labels;
}

// Takes what has no piece of so many pixels that holds together out of the labels and the runs:
// specks that a known object, the floor or a wall has left of its segment are no thing. The others
// are numbered anew.
void drop_specks(std::size_t min_pixels, std::vector<LabelCode>& label_of_component,
                 std::vector<StuffRun>& runs, LabelMap& labels) {
  auto const clusters =
      static_cast<std::size_t>(std::ranges::count_if(label_of_component, is_stuff));
  std::vector<LabelCode> renamed(clusters, kUnassigned);
  for (StuffRun const& run : runs) {
    if (run.piece_px >= min_pixels) {
      renamed[run.label - std::size_t{kFirstStuff}] = run.label;
    }
  }
  LabelCode next = kFirstStuff;
  for (LabelCode& label : renamed) {
    label = label == kUnassigned ? label : next++;
  }
  auto const rename = [&](LabelCode& label) {
    label = is_stuff(label) ? renamed[label - std::size_t{kFirstStuff}] : label;
  };
  std::ranges::for_each(label_of_component, rename);
  for (StuffRun& run : runs) {
    LabelCode const before = run.label;
    rename(run.label);
    if (run.label != before) {
      std::fill(labels.begin() + static_cast<std::ptrdiff_t>(run.pixels.begin),
                labels.begin() + static_cast<std::ptrdiff_t>(run.pixels.end), run.label);
    }
  }
  std::erase_if(runs, [](StuffRun const& run) { return run.label == kUnassigned; });
}

// What of the clusters lies on another, as the segments have it.
void tell_what_lies_on_what(Runs const& runs, std::vector<LabelCode> const& label_of_component,
                            Segments const& segments, std::vector<StuffCluster>& stuff) {
  if (segments.lies_on.empty()) {
    return;
  }
  std::vector<LabelCode> label_of(segments.pixel_counts.size() + 1, kUnassigned);
  for (ComponentRun const& run : runs) {
    label_of[static_cast<std::size_t>(segments.labels[{run.begin, run.v}])] =
        label_of_component[static_cast<std::size_t>(run.component)];
  }
  for (std::size_t segment = 1; segment < label_of.size(); ++segment) {
    LabelCode const base = label_of[static_cast<std::size_t>(segments.lies_on[segment - 1])];
    if (is_stuff(label_of[segment]) && is_stuff(base)) {
      stuff[label_of[segment] - std::size_t{kFirstStuff}].lies_on = base;
    }
  }
}

}  // namespace

FieldList fields(ClusteringConfig& config) {
  return {
      {"radius_m", &config.radius_m, {0.001, 1}, "m", "points join within this distance"},
      {"max_angle_rad",
       &config.max_angle_rad,
       {0, 3.14},
       "rad",
       "... if their normals differ by less than this"},
      {"min_pixels", &config.min_pixels, {1, 1e7}, "pixels", "smaller clusters are ignored"},
      {"spread_px",
       &config.spread_px,
       {0, 1000},
       "pixels",
       "pixels without a normal take the label of what they touch, up to this far"},
      {"point_spacing_m",
       &config.point_spacing_m,
       {0.001, 1},
       "m",
       "spacing of a cluster's points in the belief"},
  };
}

Segmentation cluster_stuff(Frame const& frame, NormalMap const& normals, Segmentation segmentation,
                           ClusteringConfig const& config) {
  check(frame, normals, segmentation);
  LabelMap& labels = segmentation.labels;
  bool const has_segments = !segmentation.segments.labels.empty();
  Runs const runs = has_segments ? segment_components(segmentation)
                                 : reachable_components(frame, normals, segmentation, config);
  auto const min_pixels = static_cast<std::size_t>(std::max(config.min_pixels, 1));
  std::vector<LabelCode> label = labels_of(sizes_of(runs), min_pixels);
  for (ComponentRun const& run : runs) {
    std::fill_n(labels.row(run.v).begin() + run.begin, run.end - run.begin,
                label[static_cast<std::size_t>(run.component)]);
  }
  if (!has_segments) {
    labels = spread_labels(frame.cloud_camera, normals, std::move(labels),
                           static_cast<float>(config.radius_m), config.spread_px);
  }
  // Of segments, points as many as cells need; the thesis' clusters have all of them.
  PixelSampling const sampling{static_cast<float>(config.point_spacing_m),
                               has_segments ? static_cast<float>(frame.intrinsics.fx_px) : 0.0F,
                               Eigen::Vector3f::Zero()};
  std::vector<StuffRun> stuff =
      has_segments ? firm_runs(frame.cloud_camera.z, labels) : stuff_runs(labels);
  if (has_segments) {
    drop_specks(min_pixels, label, stuff, labels);
  }
  segmentation.stuff =
      stuff_clusters(frame.cloud_camera, stuff, sampling, segmentation.T_world_camera);
  tell_what_lies_on_what(runs, label, segmentation.segments, segmentation.stuff);
  segmentation.segments = {};
  return segmentation;
}

}  // namespace credo
