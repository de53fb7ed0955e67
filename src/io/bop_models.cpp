#include "io/bop_models.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iomanip>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/error.hpp"
#include "core/se3.hpp"
#include "io/mesh_file.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr double kMillimetre_m = 1e-3;
constexpr double kMaxShift_m = 2e-3;

Eigen::Quaterniond turn_of(Json const& entry) {
  Eigen::Matrix4d matrix;
  for (Eigen::Index i = 0; i < 16; ++i) {
    matrix(i / 4, i % 4) = entry.at(static_cast<std::size_t>(i)).get<double>();
  }
  Se3 const motion = Se3::from_matrix(matrix);
  if (motion.translation().norm() * kMillimetre_m > kMaxShift_m) {
    throw InputError("a symmetry shifts by more than 2 mm");
  }
  return motion.rotation();
}

SymmetryAxis axis_of(Json const& entry) {
  auto const vector = [&](char const* key) {
    auto const v = entry.at(key).get<std::array<double, 3>>();
    return Eigen::Vector3d(v[0], v[1], v[2]);
  };
  return {vector("axis").normalized(), vector("offset") * kMillimetre_m};
}

Symmetry symmetry_of(Json const& info) {
  Symmetry symmetry;
  if (info.contains("symmetries_continuous")) {
    SymmetryAxis axis = axis_of(info.at("symmetries_continuous").at(0));
    // Beside turns about the axis a discrete one can only be end for end.
    axis.both_ways =
        info.contains("symmetries_discrete") && !info.at("symmetries_discrete").empty();
    symmetry.axis = axis;
    return symmetry;
  }
  if (info.contains("symmetries_discrete")) {
    for (Json const& entry : info.at("symmetries_discrete")) {
      symmetry.rotations.push_back(turn_of(entry));
    }
  }
  return symmetry;
}

}  // namespace

std::vector<ObjectModel> read_bop_models(fs::path const& folder, std::string const& prefix) {
  fs::path const list = folder / "models_info.json";
  std::ifstream file(list);
  if (!file) {
    throw InputError(list.string() + ": cannot be read; a folder of BOP models has it");
  }
  std::map<int, ObjectModel> models;
  try {
    Json const infos = Json::parse(file);
    for (auto const& [number, info] : infos.items()) {
      int const id = std::stoi(number);
      std::ostringstream name;
      name << "obj_" << std::setw(6) << std::setfill('0') << id << ".ply";
      models[id] = {prefix + "_" + number,
                    read_mesh(folder / name.str(), LengthUnit::kMillimetre).mesh,
                    symmetry_of(info)};
    }
  } catch (InputError const& error) {
    throw InputError(list.string() + ": " + error.what());
  } catch (std::exception const& error) {
    throw InputError(list.string() + ": not a list of BOP models: " + error.what());
  }
  std::vector<ObjectModel> sorted;
  sorted.reserve(models.size());
  for (auto& [id, model] : models) {
    sorted.push_back(std::move(model));
  }
  return sorted;
}

}  // namespace credo
