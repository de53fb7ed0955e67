#include "core/prior_file.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "core/error.hpp"

namespace credo {
namespace {

Field deviations(std::string name, std::vector<double>& values, Range range, std::string unit,
                 std::string text) {
  NumbersTarget target{&values, 3, 3};
  target.one_for_all = true;
  return {std::move(name), target, range, std::move(unit), std::move(text)};
}

Eigen::Quaterniond orientation_of(PriorEntry const& entry, std::string const& who) {
  if (!entry.orientation_xyzw.empty() && !entry.rpy_deg.empty()) {
    throw InputError(who + ": give orientation_xyzw or rpy_deg, not both");
  }
  if (!entry.rpy_deg.empty()) {
    return rotation_of_rpy_deg({entry.rpy_deg[0], entry.rpy_deg[1], entry.rpy_deg[2]});
  }
  if (entry.orientation_xyzw.empty()) {
    return Eigen::Quaterniond::Identity();
  }
  std::vector<double> const& q = entry.orientation_xyzw;
  Eigen::Quaterniond rotation(q[3], q[0], q[1], q[2]);
  if (std::abs(rotation.norm() - 1.0) > 1e-2) {
    throw InputError(who + ": orientation_xyzw must be of unit length");
  }
  return rotation;
}

void need(bool given, std::string const& who, std::string const& what) {
  if (!given) {
    throw InputError(who + ": " + what + " is missing");
  }
}

PoseDistribution pose_of(PriorEntry const& entry, std::string const& who) {
  need(!entry.position_m.empty(), who, "position");
  need(!entry.sigma_position_m.empty(), who, "sigma_position_m");
  need(!entry.sigma_rotation_rad.empty(), who, "sigma_rotation_rad");
  PoseDistribution pose;
  pose.mean = Se3(orientation_of(entry, who),
                  {entry.position_m[0], entry.position_m[1], entry.position_m[2]});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    auto const k = static_cast<Eigen::Index>(axis);
    pose.covariance(k, k) = std::pow(entry.sigma_position_m[axis], 2);
    pose.covariance(k + 3, k + 3) = std::pow(entry.sigma_rotation_rad[axis], 2);
  }
  return pose;
}

}  // namespace

FieldList fields(PriorEntry& entry) {
  return {
      {"id", &entry.id, {}, "", "what the belief calls it; unique"},
      {"model", &entry.model, {}, "", "name of its model, or the model's file"},
      {"position", NumbersTarget{&entry.position_m, 3, 3}, {-1e4, 1e4}, "m", "of its origin"},
      {"orientation_xyzw",
       NumbersTarget{&entry.orientation_xyzw, 4, 4},
       {-1.1, 1.1},
       "",
       "unit quaternion"},
      {"rpy_deg",
       NumbersTarget{&entry.rpy_deg, 3, 3},
       {-360, 360},
       "deg",
       "turns about the fixed axes x, y, z, instead of orientation_xyzw"},
      // Below, nothing is known so well; and no square of it is lost beside another.
      deviations("sigma_position_m", entry.sigma_position_m, {1e-5, 1000}, "m",
                 "standard deviation along each axis"),
      deviations("sigma_rotation_rad", entry.sigma_rotation_rad, {1e-5, 100}, "rad",
                 "standard deviation about each axis"),
  };
}

FieldList fields(PriorFile& file) {
  return {
      choice("frame", file.frame, {"world", "camera"},
             "what poses are given in: the level world, or the first frame's camera"),
      list_of("objects", file.objects, "known objects"),
  };
}

Prior prior_of(PriorFile const& file, double probability, std::string const& where) {
  if (file.objects.size() > kMaxObjects) {
    throw InputError(where + ": " + std::to_string(file.objects.size()) +
                     " objects are more than " + std::to_string(kMaxObjects));
  }
  std::set<std::string> ids;
  Prior prior{file.frame, {}};
  for (std::size_t i = 0; i < file.objects.size(); ++i) {
    PriorEntry const& entry = file.objects[i];
    std::string const place = where + ": objects[" + std::to_string(i) + "]";
    need(!entry.id.empty(), place, "id");
    if (std::ranges::any_of(entry.id, [](unsigned char c) { return std::iscntrl(c) != 0; })) {
      throw InputError(place + ": id has a line break or another control character");
    }
    std::string const who = place + " (" + entry.id + ")";
    need(!entry.model.empty(), who, "model");
    if (!ids.insert(entry.id).second) {
      throw InputError(who + ": this id is used twice");
    }
    ObjectBelief object;
    object.id = entry.id;
    object.type = entry.model;
    object.log_odds = log_odds_of(probability);
    object.pose_world = pose_of(entry, who);
    object.prior_covariance = object.pose_world.covariance;
    prior.objects.push_back(std::move(object));
  }
  return prior;
}

BeliefState prior_belief(Prior const& prior, Se3 const& T_world_camera) {
  BeliefState belief;
  belief.objects = prior.objects;
  if (prior.frame == PriorFrame::kCamera) {
    for (ObjectBelief& object : belief.objects) {
      object.pose_world = transformed(T_world_camera, object.pose_world);
      object.prior_covariance = object.pose_world.covariance;
    }
  }
  return belief;
}

}  // namespace credo
