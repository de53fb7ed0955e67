#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "core/capture_config.hpp"
#include "io/image.hpp"
#include "io/intrinsics.hpp"
#include "io/pcd.hpp"
#include "stages/normals/angles.hpp"
#include "stages/normals/normals.hpp"
#include "stages/normals/pca_normals.hpp"
#include "support/recordings.hpp"

namespace credo {
namespace {

using test::angle_deg;
using test::quantile;

// Nobody knows the true normals. PCL's of all points within 4 cm differ from those within 3 cm by
// noise and by the surface's bends: that is the scale for how far ours, of a square instead of a
// ball, may differ from those within 3 cm. Beside edges ours leave out what lies across, and PCL's
// do not; in the upper tail lie the creases, which ours keep and PCL's round off.
constexpr float kOpenMedian = 1.4F;
constexpr float kEdgeMedian = 1.8F;
constexpr float kOpenP90 = 2.0F;
constexpr float kEdgeP90 = 2.5F;
// Pixels without a normal of ours: slivers narrower than a window of two blocks.
constexpr double kOpenMissing = 0.01;
constexpr double kEdgeMissing = 0.06;

/// Angles to PCL's normal of all points within 3 cm: from ours, and from that within 4 cm.
struct Comparison {
  std::vector<float> ours_deg;
  std::vector<float> pca_deg;
  std::size_t missing = 0;

  [[nodiscard]] double missing_share() const {
    return static_cast<double>(missing) / static_cast<double>(missing + ours_deg.size());
  }
};

struct ComparedFrame {
  Comparison open;
  Comparison edge;
};

ComparedFrame compare(OrganizedCloud const& cloud, CameraIntrinsics const& intrinsics) {
  NormalMap const normals = estimate_normals(cloud, intrinsics, {});
  std::vector<std::size_t> pixels;
  for (std::size_t i = 0; i < cloud.size(); i += 97) {
    // Farther away a ball of 3 cm holds too few depth steps of a Kinect to be an oracle.
    if (cloud.valid(i) && cloud.z[i] < 2.0F) {
      pixels.push_back(i);
    }
  }
  auto const pca3 = test::pca_normals(cloud, pixels, 0.03);
  auto const pca4 = test::pca_normals(cloud, pixels, 0.04);
  ComparedFrame result;
  for (std::size_t k = 0; k < pixels.size(); ++k) {
    if (!pca3[k].allFinite() || !pca4[k].allFinite()) {
      continue;
    }
    bool const edge = test::beside_edge(cloud.z, cloud.z.pixel(pixels[k]), 6);
    Comparison& to = edge ? result.edge : result.open;
    if (!normals.valid(pixels[k])) {
      ++to.missing;
      continue;
    }
    to.ours_deg.push_back(angle_deg(normals.at(pixels[k]), pca3[k]));
    to.pca_deg.push_back(angle_deg(pca4[k], pca3[k]));
  }
  return result;
}

void expect_agreement(OrganizedCloud const& cloud, CameraIntrinsics const& intrinsics) {
  auto const [open, edge] = compare(cloud, intrinsics);
  ASSERT_GT(open.ours_deg.size(), 1000);
  ASSERT_GT(edge.ours_deg.size(), 200);
  EXPECT_LT(quantile(open.ours_deg, 0.5), kOpenMedian * quantile(open.pca_deg, 0.5));
  EXPECT_LT(quantile(edge.ours_deg, 0.5), kEdgeMedian * quantile(edge.pca_deg, 0.5));
  EXPECT_LT(quantile(open.ours_deg, 0.9), kOpenP90 * quantile(open.pca_deg, 0.9));
  EXPECT_LT(quantile(edge.ours_deg, 0.9), kEdgeP90 * quantile(edge.pca_deg, 0.9));
  EXPECT_LT(open.missing_share(), kOpenMissing);
  EXPECT_LT(edge.missing_share(), kEdgeMissing);
}

Grid<float> kitchen_depth(std::string const& number) {
  Grid<std::uint16_t> const counts =
      read_png16(test::recordings() / "kitchen" / ("frame-" + number + ".depth.png"));
  Grid<float> depth_m(counts.width(), counts.height());
  std::ranges::transform(counts, depth_m.begin(), [](std::uint16_t mm) {
    return mm == 65535 ? 0.0F : static_cast<float>(mm) * 0.001F;
  });
  return depth_m;
}

TEST(NormalsOfRecordings, KitchenAgreesWithPcaAsFarAsPcaWithItself) {
  CREDO_REQUIRE_RECORDING("kitchen");
  CameraIntrinsics const camera =
      read_intrinsics(test::recordings() / "kitchen" / "camera-intrinsics.txt");
  for (std::string const number : {"000000", "000150", "000300"}) {
    SCOPED_TRACE(number);
    expect_agreement(cloud_from_depth(kitchen_depth(number), camera), camera);
  }
}

/// A cloud of a camera that others calibrated, and the model of it that we assume.
struct RecordedCloud {
  OrganizedCloud cloud;
  CameraIntrinsics camera;
};

RecordedCloud read_recorded(std::filesystem::path const& file, CloudAxes axes) {
  std::filesystem::path const path = test::recordings() / file;
  constexpr double kFarthest_m = 10.0;
  return {read_pcd(path, axes, kFarthest_m).cloud_camera,
          read_intrinsics(path.parent_path() / "camera-intrinsics.txt")};
}

/// The normals rest on the depth alone: x and y of the cloud must be where the camera's model says.
void expect_pinhole(RecordedCloud const& recorded) {
  // Whether a pixel's centre is at its integer or half a pixel on is the recorder's convention.
  constexpr float kHalfAPixelEachWay_px = 0.75F;
  OrganizedCloud const& cloud = recorded.cloud;
  CameraIntrinsics const& k = recorded.camera;
  std::vector<float> aside_px;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.valid(i)) {
      Pixel const p = cloud.z.pixel(i);
      aside_px.push_back(
          static_cast<float>(std::hypot(k.fx_px * cloud.x[i] / cloud.z[i] + k.cx_px - p.u,
                                        k.fy_px * cloud.y[i] / cloud.z[i] + k.cy_px - p.v)));
    }
  }
  ASSERT_FALSE(aside_px.empty());
  EXPECT_LT(quantile(aside_px, 1.0), kHalfAPixelEachWay_px);
}

TEST(NormalsOfRecordings, TableTopsAgreeWithPcaAsFarAsPcaWithItself) {
  CREDO_REQUIRE_RECORDING("osd");
  for (char const* file : {"osd/learn0.pcd", "osd/learn33.pcd"}) {
    SCOPED_TRACE(file);
    RecordedCloud const recorded = read_recorded(file, CloudAxes::kOptical);
    expect_pinhole(recorded);
    expect_agreement(recorded.cloud, recorded.camera);
  }
}

TEST(NormalsOfRecordings, SingleFramesAgreeWithPcaAsFarAsPcaWithItself) {
  CREDO_REQUIRE_RECORDING("frames");
  RecordedCloud const milk =
      read_recorded("frames/milk/milk_cartoon_all_small_clorox.pcd", CloudAxes::kYUpZBack);
  expect_pinhole(milk);
  expect_agreement(milk.cloud, milk.camera);
  RecordedCloud const grabber =
      read_recorded("frames/grabber/frame_20121214T142255.814212.pcd", CloudAxes::kOptical);
  expect_pinhole(grabber);
  expect_agreement(grabber.cloud, grabber.camera);
}

}  // namespace
}  // namespace credo
