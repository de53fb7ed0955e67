#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <variant>

#include "io/dataset.hpp"
#include "io/mesh_file.hpp"
#include "stages/normals/normals.hpp"
#include "stages/region_growing/region_growing.hpp"
#include "support/linemod_cat.hpp"
#include "support/literal_region_growing.hpp"
#include "support/recordings.hpp"

namespace credo::test {
namespace {

using Eigen::Vector3d;

struct CatFrame {
  FramePtr frame;
  NormalMap normals;
  ObjectModels models;
  Segmentation segmentation;
};

CatFrame cat_frame() {
  CatFrame cat;
  OpenedSource opened = open_dataset(recordings() / "frames" / "linemod-cat", {}, {});
  cat.frame = std::get<FramePtr>(opened.source->next());
  cat.normals = estimate_normals(cat.frame->cloud_camera, cat.frame->intrinsics, {});
  LoadedMesh loaded =
      read_mesh(recordings() / "objects" / "lmo" / "obj_000006.ply", LengthUnit::kMillimetre);
  cat.models["cat"] = {"cat", std::move(loaded.mesh), {}};
  cat.segmentation = unassigned_segmentation(*cat.frame, Se3(), kPriorFrame);
  ObjectObservation seen;
  seen.type = "cat";
  seen.pose_world.mean = true_cat_pose();
  cat.segmentation.objects = {seen};
  return cat;
}

/// Depth of the mesh at each pixel: every triangle, every pixel of its rectangle. NaN elsewhere.
Grid<float> drawn_depth(TriangleMesh const& mesh, Se3 const& T_camera_model,
                        CameraIntrinsics const& camera, int width, int height) {
  Grid<float> depth(width, height, kNaN);
  for (auto const& triangle : mesh.triangles) {
    std::array<Vector3d, 3> c;
    Eigen::AlignedBox2d rectangle;
    for (std::size_t k = 0; k < 3; ++k) {
      c[k] = T_camera_model * mesh.vertices[triangle[k]].cast<double>();
      rectangle.extend(Eigen::Vector2d(camera.fx_px * c[k].x() / c[k].z() + camera.cx_px,
                                       camera.fy_px * c[k].y() / c[k].z() + camera.cy_px));
    }
    Eigen::Matrix3d corners;
    corners << c[0], c[1], c[2];
    Eigen::Matrix3d const inverse = corners.inverse();
    for (int v = static_cast<int>(rectangle.min().y()); v <= rectangle.max().y() + 1; ++v) {
      for (int u = static_cast<int>(rectangle.min().x()); u <= rectangle.max().x() + 1; ++u) {
        Vector3d const ray((u - camera.cx_px) / camera.fx_px, (v - camera.cy_px) / camera.fy_px, 1);
        Vector3d const weights = inverse * ray;
        auto const z = static_cast<float>(1.0 / weights.sum());
        if (weights.minCoeff() >= 0 && depth.contains({u, v}) && !(depth[Pixel{u, v}] <= z)) {
          depth[Pixel{u, v}] = z;
        }
      }
    }
  }
  return depth;
}

// Truth: pixels where the drawn mesh and the measured depth agree within what a Kinect and the
// dataset's pose may be off by. The rim has no normals here; it follows when labels are spread.
TEST(RegionRecordings, TheCatIsLabelledWhereItIs) {
  CREDO_REQUIRE_RECORDING("frames/linemod-cat");
  CatFrame const cat = cat_frame();
  Segmentation const result = grow_objects(*cat.frame, cat.normals, cat.segmentation,
                                           shapes_of(cat.models), RegionGrowingConfig{});
  Grid<float> const drawn =
      drawn_depth(std::get<TriangleMesh>(cat.models.at("cat").shape), true_cat_pose(),
                  cat.frame->intrinsics, result.labels.width(), result.labels.height());
  std::size_t truth = 0;
  std::size_t labelled = 0;
  std::size_t both = 0;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    bool const is_cat = std::abs(drawn[i] - cat.frame->cloud_camera.z[i]) < 0.02F;
    bool const is_labelled = result.labels[i] == kFirstObject;
    truth += is_cat ? 1U : 0U;
    labelled += is_labelled ? 1U : 0U;
    both += is_cat && is_labelled ? 1U : 0U;
  }
  ASSERT_GT(truth, 2000U);
  double const iou = static_cast<double>(both) / static_cast<double>(truth + labelled - both);
  RecordProperty("iou_percent", static_cast<int>(100 * iou));
  EXPECT_GT(iou, 0.75) << truth << " true, " << labelled << " labelled, " << both << " both";
}

TEST(RegionRecordings, TheCatIsWhatAlgorithmOneGives) {
  CREDO_REQUIRE_RECORDING("frames/linemod-cat");
  CatFrame const cat = cat_frame();
  for (bool const thesis : {false, true}) {
    RegionGrowingConfig config;
    config.seed_distance_m = thesis ? 0.0 : config.seed_distance_m;
    config.max_model_angle_rad = thesis ? 3.15 : config.max_model_angle_rad;
    config.max_distance_m = thesis ? 100 : config.max_distance_m;
    Segmentation const result =
        grow_objects(*cat.frame, cat.normals, cat.segmentation, shapes_of(cat.models), config);
    EXPECT_EQ(result.labels,
              literal_regions(*cat.frame, cat.normals, cat.segmentation, cat.models, config));
    EXPECT_GT(result.objects[0].pixel_count, 1500U);
  }
}

}  // namespace
}  // namespace credo::test
