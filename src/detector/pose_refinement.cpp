#include "detector/pose_refinement.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "detector/edge_contacts.hpp"
#include "detector/scene_projection.hpp"

namespace credo {
namespace {

using Vector6f = Eigen::Matrix<float, 6, 1>;
using Matrix6f = Eigen::Matrix<float, 6, 6>;

constexpr float kLeastNormalCosine = 0.5F;
constexpr int kFewestPoints = 6;
/// Where points say nothing of a direction, no step is taken along it.
constexpr float kDamping = 1e-3F;

/// A point of the model and what it falls on.
struct Contact {
  Eigen::Vector3f point;
  Eigen::Vector3f normal;
  /// Of the scene's surface before the model's, along its normal.
  float residual_m = 0.0F;
};

class Contacts {
public:
  Contacts(SearchModel const& model, SearchScene const& scene, float gate_m)
      : model_(model), scene_(scene), project_(scene), gate_m_(gate_m) {}

  [[nodiscard]] std::optional<Contact> at(CameraPose const& pose, std::uint16_t i) const {
    Contact contact;
    contact.point = pose * model_.points_model[i];
    Pixel pixel;
    if (!project_.at(contact.point, pixel)) {
      return std::nullopt;
    }
    ScenePixel const& seen = scene_.pixels[pixel];
    if (seen.depth_m <= 0.0F || std::abs(seen.depth_m - contact.point.z()) > gate_m_ ||
        scene_.is_background(seen, model_.diameter_m)) {
      return std::nullopt;
    }
    contact.normal = pose.rotation * model_.normals_model[i];
    if (seen.has_normal() && seen.normal_camera().dot(contact.normal) < kLeastNormalCosine) {
      return std::nullopt;
    }
    contact.residual_m = contact.normal.dot(scene_.point_at(pixel) - contact.point);
    return contact;
  }

private:
  SearchModel const& model_;
  SearchScene const& scene_;
  SceneProjection project_;
  float gate_m_;
};

/// How a distance along `direction` at `point` changes with a shift and a turn about `centre`.
Vector6f gradient(Eigen::Vector3f const& point, Eigen::Vector3f const& direction,
                  Eigen::Vector3f const& centre) {
  Vector6f row;
  row << direction, (point - centre).cross(direction);
  return row;
}

/// The normal equations of one step.
struct Equations {
  Matrix6f information = Matrix6f::Zero();
  Vector6f pull = Vector6f::Zero();
  int contacts = 0;

  void add(Vector6f const& row, float residual_m, float weight) {
    information.noalias() += weight * row * row.transpose();
    pull += weight * residual_m * row;
    ++contacts;
  }
};

/// So much of the surface's weight has the silhouette, if all of it is found.
constexpr float kEdgeShare = 0.5F;

void add_edges(SearchModel const& model, SearchScene const& scene, CameraPose const& pose,
               ModelView const& view, float scale_m, Equations& equations) {
  if (view.outline.empty()) {
    return;
  }
  float const of_each =
      kEdgeShare * static_cast<float>(equations.contacts) / static_cast<float>(view.outline.size());
  Eigen::Vector3f const centre = pose * model.centre_model;
  for (OutlinePair const& pair : view.outline) {
    EdgeLook const look = look_at_edge(model, scene, pose, pair);
    if (look.verdict == EdgeVerdict::kFound) {
      EdgeContact const& contact = look.contact;
      float const in_deviations = contact.residual_m / (2.0F * contact.deviation_m);
      float const weight =
          std::min(1.0F, scale_m / contact.deviation_m) / (1.0F + in_deviations * in_deviations);
      equations.add(gradient(contact.point, contact.direction, centre), contact.residual_m,
                    of_each * weight);
    }
  }
}

CameraPose moved(CameraPose const& pose, Eigen::Vector3f const& centre, Vector6f const& step) {
  Eigen::Vector3f const phi = step.tail<3>();
  float const angle = phi.norm();
  Eigen::Matrix3f const turn = angle > 0.0F
                                   ? Eigen::AngleAxisf(angle, phi / angle).toRotationMatrix()
                                   : Eigen::Matrix3f(Eigen::Matrix3f::Identity());
  return {turn * pose.rotation, turn * (pose.translation_m - centre) + centre + step.head<3>()};
}

}  // namespace

CameraPose refined(SearchModel const& model, SearchScene const& scene, CameraPose const& start,
                   RefinementConfig const& config) {
  CameraPose pose = start;
  Contacts const contacts(model, scene, config.gate_m);
  Eigen::Vector3f const first_centre = pose * model.centre_model;
  ModelView const& view = model.view_from(-(pose.rotation.transpose() * first_centre));
  std::size_t const count = std::min(config.points, view.visible.size());
  float const length_m = model.radius_m;
  for (int iteration = 0; iteration < config.iterations; ++iteration) {
    Eigen::Vector3f const centre = pose * model.centre_model;
    float const scale_m = 1.5F * depth_deviation_m(centre.z());
    Equations equations;
    for (std::size_t k = 0; k < count; ++k) {
      if (auto const contact = contacts.at(pose, view.visible[k])) {
        float const in_scales = contact->residual_m / scale_m;
        equations.add(gradient(contact->point, contact->normal, centre), contact->residual_m,
                      1.0F / (1.0F + in_scales * in_scales));
      }
    }
    if (equations.contacts < kFewestPoints) {
      return pose;
    }
    add_edges(model, scene, pose, view, scale_m, equations);
    float const damping = kDamping * static_cast<float>(equations.contacts);
    Matrix6f& information = equations.information;
    information.diagonal().head<3>().array() += damping;
    information.diagonal().tail<3>().array() += damping * length_m * length_m;
    Vector6f const step = information.ldlt().solve(equations.pull);
    if (!step.allFinite()) {
      return pose;
    }
    pose = moved(pose, centre, step);
  }
  // Products of rotations in floats drift.
  pose.rotation = Eigen::Quaternionf(pose.rotation).normalized().toRotationMatrix();
  return pose;
}

namespace {

/// The silhouette tells of shifts along surfaces. Its errors have more in common than those of
/// surfaces: so many of its points are worth one.
constexpr double kEdgeWorth = 0.3;

void add_edge_evidence(SearchModel const& model, SearchScene const& scene, CameraPose const& pose,
                       ModelView const& view, PoseEvidence& evidence) {
  for (OutlinePair const& pair : view.outline) {
    EdgeLook const look = look_at_edge(model, scene, pose, pair);
    EdgeContact const& contact = look.contact;
    if (look.verdict != EdgeVerdict::kFound ||
        std::abs(contact.residual_m) > 3.0F * contact.deviation_m) {
      continue;
    }
    Vector6d const row =
        (gradient(contact.point, contact.direction, pose.translation_m) / contact.deviation_m)
            .cast<double>();
    evidence.information += kEdgeWorth * row * row.transpose();
  }
}

}  // namespace

PoseEvidence evidence_of(SearchModel const& model, SearchScene const& scene, CameraPose const& pose,
                         std::size_t points) {
  Eigen::Vector3f const centre = pose * model.centre_model;
  Contacts const contacts(model, scene, 2.0F * depth_tolerance_m(centre.z()));
  ModelView const& view = model.view_from(-(pose.rotation.transpose() * centre));
  PoseEvidence evidence;
  for (std::size_t k = 0; k < std::min(points, view.visible.size()); ++k) {
    auto const contact = contacts.at(pose, view.visible[k]);
    if (!contact) {
      continue;
    }
    float const deviation = depth_deviation_m(contact->point.z());
    float const in_deviations = contact->residual_m / deviation;
    float const weight = 1.0F / (1.0F + in_deviations * in_deviations / 4.0F);
    Vector6d const row =
        (gradient(contact->point, contact->normal, pose.translation_m) / deviation).cast<double>();
    evidence.information += static_cast<double>(weight) * row * row.transpose();
    evidence.mean_squared_residual += static_cast<double>(in_deviations * in_deviations);
    ++evidence.points;
  }
  add_edge_evidence(model, scene, pose, view, evidence);
  if (evidence.points > 0) {
    evidence.mean_squared_residual /= evidence.points;
  }
  return evidence;
}

}  // namespace credo
