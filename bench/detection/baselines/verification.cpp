#include "verification.hpp"

#include <pcl/common/common.h>
#include <pcl/common/time.h>
#include <pcl/features/normal_3d.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/pcl_config.h>
#include <pcl/recognition/hv/hv_go.h>
#include <pcl/recognition/impl/hv/occlusion_reasoning.hpp>

#include <iostream>
#include <stdexcept>

// PCL 1.13.0 turned a test round when it made it shorter: of each hypothesis it keeps the points
// whose normal is not finite, so none, and then all hypotheses are alike. Here its template is
// compiled anew, for points that its library has no such code for, with the test as it was meant.
#if PCL_VERSION_COMPARE(==, 1, 13, 0)
#define isNormalFinite(point) (!pcl::isNormalFinite(point))  // NOLINT: see above
#endif
#include <pcl/recognition/impl/hv/hv_go.hpp>
#undef isNormalFinite

namespace credo {
namespace {

/// The verification tells its times on the error stream.
class Silence {
public:
  Silence() : kept_(std::cerr.rdbuf(nullptr)) {}
  Silence(Silence const&) = delete;
  Silence& operator=(Silence const&) = delete;
  Silence(Silence&&) = delete;
  Silence& operator=(Silence&&) = delete;
  ~Silence() {
    std::cerr.rdbuf(kept_);
    std::cerr.clear();
  }

private:
  std::streambuf* kept_;
};

}  // namespace

std::vector<bool> verified(VerifiedCloud::Ptr const& things, VerifiedCloud::Ptr const& whole,
                           std::vector<VerifiedCloud::ConstPtr> hypotheses,
                           VerificationSettings const& settings) {
  constexpr float kNormals_m = 0.02F;
  Silence const silence;
  pcl::GlobalHypothesesVerification<pcl::PointXYZI, pcl::PointXYZI> verification;
  verification.setResolution(settings.resolution_m);
  verification.setInlierThreshold(settings.inlier_m);
  verification.setOcclusionThreshold(settings.occlusion_m);
  verification.setRegularizer(settings.outlier_weight);
  verification.setRadiusClutter(settings.clutter_radius_m);
  verification.setClutterRegularizer(settings.clutter_weight);
  verification.setDetectClutter(true);
  verification.setRadiusNormals(kNormals_m);
  verification.setSceneCloud(things);
  verification.setOcclusionCloud(whole);
  verification.addModels(hypotheses, true);
  std::vector<bool> mask(hypotheses.size(), false);
  try {
    verification.verify();
    verification.getMask(mask);
  } catch (std::length_error const&) {
    // Of no hypothesis it keeps a point: then it asks for a grid as large as all floats span.
  }
  return mask;
}

}  // namespace credo
