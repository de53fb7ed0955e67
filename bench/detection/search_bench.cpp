// What looking for one object costs, and how often it is found, on made table tops at full
// resolution: everywhere, and near an expectation, there beside PCL's point-to-plane ICP from the
// same start. CPU time of one thread. CREDO_DATA names the folder of recordings.
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/registration/icp.h>
#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "../cpu_time.hpp"
#include "detector/models/prepared_model.hpp"
#include "detector/scenes/scene_of_frame.hpp"
#include "detector/search/global_search.hpp"
#include "detector/search/tracking.hpp"
#include "eval/true_model.hpp"
#include "geometry/random_draws.hpp"
#include "views.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kScenes = 10;
/// What is less seen is nothing to follow.
constexpr double kLeastFollowed = 0.5;
/// A pose followed is right within these.
constexpr double kRight_m = 0.010;
constexpr double kRight_rad = 0.17;

/// How far an expectation is off, in the mean of squares along each axis.
struct Expectation {
  char const* name;
  double sigma_m;
  double sigma_rad;
};
constexpr std::array<Expectation, 2> kExpectations = {
    Expectation{"followed, 5 mm and 0.03 rad off", 0.005, 0.03},
    Expectation{"expected, 15 mm and 0.1 rad off", 0.015, 0.10}};

struct Row {
  std::vector<double> cpu_ms;
  int right = 0;
};
/// In the order of their names.
using Rows = std::map<std::string, Row>;

void time_into(Row& row, std::function<bool()> const& work) {
  double const before_ms = thread_cpu_ms();
  bool const right = work();
  row.cpu_ms.push_back(thread_cpu_ms() - before_ms);
  row.right += right ? 1 : 0;
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

void print(Rows const& rows) {
  fmt::print("{:<48} {:>5} {:>9} {:>8} {:>8}\n", "CPU ms of one thread", "n", "median", "95 %",
             "right");
  for (auto const& [name, row] : rows) {
    fmt::print("{:<48} {:>5} {:>9.2f} {:>8.2f} {:>6.0f} %\n", name, row.cpu_ms.size(),
               median(row.cpu_ms), quantile(row.cpu_ms, 0.95),
               100.0 * row.right / static_cast<double>(row.cpu_ms.size()));
  }
}

PoseDistribution expected_at(Se3 const& truth, Expectation const& off, std::mt19937_64& random) {
  PoseDistribution expected;
  expected.covariance.diagonal() << Eigen::Vector3d::Constant(off.sigma_m * off.sigma_m),
      Eigen::Vector3d::Constant(off.sigma_rad * off.sigma_rad);
  Vector6d error;
  for (int i = 0; i < 6; ++i) {
    error[i] = (i < 3 ? off.sigma_m : off.sigma_rad) * draw_normal(random);
  }
  expected.mean = boxplus(truth, error);
  return expected;
}

using Cloud = pcl::PointCloud<pcl::PointNormal>;

Cloud::Ptr cloud_of(SearchScene const& scene) {
  auto cloud = std::make_shared<Cloud>();
  for (int v = 0; v < scene.pixels.height(); ++v) {
    for (int u = 0; u < scene.pixels.width(); ++u) {
      ScenePixel const& pixel = scene.pixels[{u, v}];
      if (pixel.depth_m > 0.0F && pixel.has_normal()) {
        pcl::PointNormal point;
        point.getVector3fMap() = scene.point_at({u, v});
        point.getNormalVector3fMap() = pixel.normal_camera();
        cloud->push_back(point);
      }
    }
  }
  return cloud;
}

/// PCL's tracker of a static cloud: what the model shows from there, to the nearest points of the
/// frame, 30 times.
class PclTracker {
public:
  explicit PclTracker(SearchScene const& scene)
      : cloud_(cloud_of(scene)), tree_(std::make_shared<pcl::search::KdTree<pcl::PointNormal>>()) {
    tree_->setInputCloud(cloud_);
  }
  [[nodiscard]] Se3 followed(SearchModel const& model, Se3 const& start) const {
    CameraPose const pose = camera_pose(start);
    Eigen::Vector3f const eye_model = -(pose.rotation.transpose() * pose.translation_m);
    auto source = std::make_shared<Cloud>();
    for (std::uint32_t const i : model.view_from(eye_model - model.centre_model).visible) {
      pcl::PointNormal point;
      point.getVector3fMap() = pose * model.points_model[i];
      point.getNormalVector3fMap() = pose.rotation * model.normals_model[i];
      source->push_back(point);
    }
    pcl::IterativeClosestPointWithNormals<pcl::PointNormal, pcl::PointNormal> icp;
    icp.setInputSource(source);
    icp.setSearchMethodTarget(tree_, true);
    icp.setInputTarget(cloud_);
    icp.setMaxCorrespondenceDistance(0.02);
    icp.setMaximumIterations(30);
    Cloud moved;
    icp.align(moved);
    Eigen::Matrix4d const motion = icp.getFinalTransformation().cast<double>();
    Eigen::Quaterniond const turn(Eigen::Matrix3d(motion.topLeftCorner<3, 3>()));
    return Se3(turn.normalized(), motion.topRightCorner<3, 1>()) * start;
  }

private:
  Cloud::Ptr cloud_;
  pcl::search::KdTree<pcl::PointNormal>::Ptr tree_;
};

class Bench {
public:
  explicit Bench(std::vector<ObjectModel> const& models) {
    for (ObjectModel const& model : models) {
      named_.emplace(model.name, model);
      true_models_.emplace(model.name, TrueModel(model));
    }
    prepared_ = prepare_models(named_);
  }

  void look_at(TabletopScene const& tabletop, int number) {
    TableView const view = view_of(tabletop, named_, number);
    SearchScene scene;
    time_into(rows_["frame made ready"], [&] {
      scene = scene_of(*view.frame);
      return true;
    });
    PclTracker const pcl(scene);
    for (TrueInstance const& truth : view.truths) {
      if (truth.visible_fraction >= kLeastFollowed) {
        follow(truth, scene, pcl);
      }
    }
    for (auto const& [name, model] : prepared_) {
      search(name, *model, scene, view.truths);
    }
  }

  [[nodiscard]] Rows const& rows() const { return rows_; }

private:
  [[nodiscard]] bool is_right(TrueInstance const& truth, Se3 const& pose) const {
    TrueModel::PoseError const error = true_models_.at(truth.model).error(pose, truth.pose_camera);
    return error.translation_m <= kRight_m && error.rotation_rad <= kRight_rad;
  }

  void follow(TrueInstance const& truth, SearchScene const& scene, PclTracker const& pcl) {
    SearchModel const& model = prepared_.at(truth.model)->model;
    for (Expectation const& off : kExpectations) {
      PoseDistribution const expected = expected_at(truth.pose_camera, off, random_);
      time_into(rows_[std::string(off.name) + ": credo"], [&] {
        auto const found = search_near(model, scene, expected, 1, 2);
        return !found.empty() && is_right(truth, se3(found.front().pose));
      });
      time_into(rows_[std::string(off.name) + ": PCL's ICP"],
                [&] { return is_right(truth, pcl.followed(model, expected.mean)); });
    }
  }

  void search(std::string const& name, PreparedModel const& model, SearchScene const& scene,
              std::vector<TrueInstance> const& truths) {
    auto const truth = std::ranges::find(truths, name, &TrueInstance::model);
    bool const there = truth != truths.end() && truth->visible_fraction >= kLeastFollowed;
    time_into(rows_[there ? "everywhere, for what is there" : "everywhere, for what is not"], [&] {
      auto const found = search_everywhere(model.model, model.pairs, scene, 8);
      return there && !found.empty() && is_right(*truth, se3(found.front().pose));
    });
  }

  ObjectModels named_;
  std::map<std::string, TrueModel> true_models_;
  PreparedModels prepared_;
  Rows rows_;
  std::mt19937_64 random_{1};
};

int run() {
  char const* given = std::getenv("CREDO_DATA");  // NOLINT(concurrency-mt-unsafe): before threads
  fs::path const recordings = given != nullptr ? given : CREDO_DATA_DIR;
  if (!fs::exists(recordings / "objects/lmo")) {
    fmt::print("skipped: {}/objects/lmo is not there\n", recordings.string());
    return 0;
  }
  Bench bench(all_models(recordings));
  std::vector<TabletopScene> scenes = frozen_scenes(*tabletop_set("tuning-kinect"));
  scenes.resize(std::min(kScenes, scenes.size()));
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    fmt::print(stderr, "\r{} of {} scenes", i + 1, scenes.size());
    bench.look_at(scenes[i], static_cast<int>(i));
  }
  fmt::print(stderr, "\n");
  print(bench.rows());
  return 0;
}

}  // namespace
}  // namespace credo

int main() {
  try {
    return credo::run();
  } catch (std::exception const& error) {
    fmt::print(stderr, "credo_search_bench: {}\n", error.what());
    return 1;
  }
}
