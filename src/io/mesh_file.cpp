#include "io/mesh_file.hpp"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "io/ply_check.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;

using Triangle = std::array<std::uint32_t, 3>;

constexpr double kLargestM = 20.0;
constexpr double kSmallestM = 1e-3;

double metres_per(LengthUnit unit) {
  return unit == LengthUnit::kMetre ? 1.0 : 1e-3;
}

std::string name_of(LengthUnit unit) {
  return unit == LengthUnit::kMetre ? "m" : "mm";
}

/// A text of assimp's, whose lines and odd bytes become blanks.
std::string on_one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, ' ');
  std::istringstream words(text);
  std::string line;
  for (std::string word; words >> word;) {
    line += (line.empty() ? "" : " ") + word;
  }
  return line;
}

[[noreturn]] void refuse(std::string const& reason) {
  throw std::invalid_argument("is no mesh that can be read: " + on_one_line(reason));
}

/// Refuses what assimp's own steps do not survive: faces of no vertices, or of some that are not
/// there.
void check_faces(aiScene const& scene) {
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    aiMesh const& mesh = *scene.mMeshes[m];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      aiFace const& face = mesh.mFaces[f];
      if (face.mNumIndices == 0) {
        refuse("face " + std::to_string(f) + " has no vertices");
      }
      for (unsigned i = 0; i < face.mNumIndices; ++i) {
        if (face.mIndices[i] >= mesh.mNumVertices) {
          refuse("face " + std::to_string(f) + " names vertex " + std::to_string(face.mIndices[i]) +
                 " of " + std::to_string(mesh.mNumVertices));
        }
      }
    }
  }
}

/// The file's scene, owned by the importer. Only polygons are cut into triangles: whatever else
/// assimp could do to it moves vertices or joins what is merely near.
aiScene const& import(Assimp::Importer& importer, fs::path const& path) {
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  aiScene const* scene = importer.ReadFile(path.string(), 0);
  if (scene == nullptr) {
    refuse(importer.GetErrorString());
  }
  check_faces(*scene);
  scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    refuse(importer.GetErrorString());
  }
  return *scene;
}

/// Joins the triangles of a scene over vertices of one position each.
class SceneJoin {
public:
  SceneJoin(aiScene const& scene, double metres_per_unit) : scene_(scene) {
    add_node(*scene.mRootNode, Eigen::Affine3d(Eigen::Scaling(metres_per_unit)));
  }

  [[nodiscard]] TriangleMesh const& mesh() const { return mesh_; }

private:
  void add_node(aiNode const& node, Eigen::Affine3d const& parent_to_model) {
    using RowMajor = Eigen::Matrix<ai_real, 4, 4, Eigen::RowMajor>;
    Eigen::Affine3d node_to_parent;
    node_to_parent.matrix() = Eigen::Map<RowMajor const>(&node.mTransformation.a1).cast<double>();
    Eigen::Affine3d const node_to_model = parent_to_model * node_to_parent;
    for (unsigned m = 0; m < node.mNumMeshes; ++m) {
      add_mesh(*scene_.mMeshes[node.mMeshes[m]], node_to_model);
    }
    for (unsigned c = 0; c < node.mNumChildren; ++c) {
      add_node(*node.mChildren[c], node_to_model);
    }
  }

  void add_mesh(aiMesh const& mesh, Eigen::Affine3d const& node_to_model) {
    bool const mirrored = node_to_model.linear().determinant() < 0.0;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      aiFace const& face = mesh.mFaces[f];
      if (face.mNumIndices != 3) {
        continue;
      }
      Triangle triangle{};
      for (unsigned i = 0; i < 3; ++i) {
        aiVector3D const& p = mesh.mVertices[face.mIndices[i]];
        Eigen::Vector3f const p_model =
            (node_to_model * Eigen::Vector3d(p.x, p.y, p.z)).cast<float>();
        if (!p_model.allFinite()) {
          std::ostringstream text;
          text << "has a vertex that is not finite: " << p.x << ' ' << p.y << ' ' << p.z;
          throw std::invalid_argument(text.str());
        }
        triangle.at(i) = vertex_at(p_model);
      }
      if (mirrored) {
        std::swap(triangle[1], triangle[2]);
      }
      if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0]) {
        mesh_.triangles.push_back(triangle);
      }
    }
  }

  std::uint32_t vertex_at(Eigen::Vector3f const& p) {
    auto const next = static_cast<std::uint32_t>(mesh_.vertices.size());
    auto const [place, is_new] = index_of_.try_emplace({p.x(), p.y(), p.z()}, next);
    if (is_new) {
      mesh_.vertices.push_back(p);
    }
    return place->second;
  }

  aiScene const& scene_;
  TriangleMesh mesh_;
  std::map<std::array<float, 3>, std::uint32_t> index_of_;
};

std::size_t count_boundary_edges(std::vector<Triangle> const& triangles) {
  struct Edge {
    std::uint32_t low;
    std::uint32_t high;
    bool rising;
  };
  std::vector<Edge> edges;
  for (Triangle const& t : triangles) {
    for (auto const& [from, to] : {std::pair(t[0], t[1]), {t[1], t[2]}, {t[2], t[0]}}) {
      edges.push_back({std::min(from, to), std::max(from, to), from < to});
    }
  }
  auto const order = [](Edge const& a, Edge const& b) {
    return std::tie(a.low, a.high) < std::tie(b.low, b.high);
  };
  std::sort(edges.begin(), edges.end(), order);
  std::size_t count = 0;
  for (auto first = edges.begin(); first != edges.end();) {
    auto const last = std::upper_bound(first, edges.end(), *first, order);
    bool const closed = last - first == 2 && first->rising != std::next(first)->rising;
    count += closed ? 0 : 1;
    first = last;
  }
  return count;
}

/// Without triangles whose height is lost in the rounding of their coordinates, and without
/// vertices that no triangle is left to need.
TriangleMesh without_flat_triangles(TriangleMesh const& mesh) {
  float largest = 0.0F;
  for (Eigen::Vector3f const& p : mesh.vertices) {
    largest = std::max(largest, p.cwiseAbs().maxCoeff());
  }
  double const rounding_m = std::numeric_limits<float>::epsilon() * static_cast<double>(largest);
  auto const is_flat = [&](Triangle const& t) {
    Eigen::Vector3d const a = mesh.vertices[t[0]].cast<double>();
    Eigen::Vector3d const ab = mesh.vertices[t[1]].cast<double>() - a;
    Eigen::Vector3d const ac = mesh.vertices[t[2]].cast<double>() - a;
    double const longest_m = std::max({ab.norm(), ac.norm(), (ac - ab).norm()});
    return ab.cross(ac).norm() <= rounding_m * longest_m;
  };
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> new_index(mesh.vertices.size(), kUnused);
  TriangleMesh result;
  for (Triangle triangle : mesh.triangles) {
    if (is_flat(triangle)) {
      continue;
    }
    for (std::uint32_t& vertex : triangle) {
      std::uint32_t& index = new_index[vertex];
      if (index == kUnused) {
        index = static_cast<std::uint32_t>(result.vertices.size());
        result.vertices.push_back(mesh.vertices[vertex]);
      }
      vertex = index;
    }
    result.triangles.push_back(triangle);
  }
  return result;
}

void check_size(std::vector<Eigen::Vector3f> const& vertices, LengthUnit unit) {
  Eigen::AlignedBox3d box;
  for (Eigen::Vector3f const& p : vertices) {
    box.extend(p.cast<double>());
  }
  auto const fits = [](double size_m) { return size_m >= kSmallestM && size_m <= kLargestM; };
  double const size_m = box.sizes().maxCoeff();
  if (fits(size_m)) {
    return;
  }
  LengthUnit const other =
      unit == LengthUnit::kMetre ? LengthUnit::kMillimetre : LengthUnit::kMetre;
  std::ostringstream text;
  text << "is " << size_m << " m across in " << name_of(unit) << "; ";
  if (fits(size_m / metres_per(unit) * metres_per(other))) {
    text << "should its unit be " << name_of(other) << "?";
  } else {
    text << "must be between " << kSmallestM << " and " << kLargestM << " m: check its unit";
  }
  throw std::invalid_argument(text.str());
}

bool is_inside_out(TriangleMesh const& mesh) {
  Eigen::Vector3d const origin = mesh.vertices.front().cast<double>();
  double volume = 0.0;
  for (auto const& [a, b, c] : mesh.triangles) {
    volume += (mesh.vertices[a].cast<double>() - origin)
                  .dot((mesh.vertices[b].cast<double>() - origin)
                           .cross(mesh.vertices[c].cast<double>() - origin));
  }
  return volume < 0.0;
}

}  // namespace

LoadedMesh read_mesh(fs::path const& path, LengthUnit unit) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    throw InputError(path.string() + ": is a folder; a mesh is a file");
  }
  if (!std::ifstream(path)) {
    throw InputError(path.string() + ": mesh cannot be read");
  }
  check_ply(path);
  try {
    Assimp::Importer importer;
    TriangleMesh const joined = SceneJoin(import(importer, path), metres_per(unit)).mesh();
    LoadedMesh loaded{without_flat_triangles(joined), 0};
    loaded.boundary_edges = count_boundary_edges(loaded.mesh.triangles);
    if (loaded.mesh.triangles.empty()) {
      throw std::invalid_argument("has no triangles; a model needs faces");
    }
    check_size(loaded.mesh.vertices, unit);
    if (loaded.boundary_edges == 0 && is_inside_out(loaded.mesh)) {
      for (Triangle& triangle : loaded.mesh.triangles) {
        std::swap(triangle[1], triangle[2]);
      }
    }
    return loaded;
  } catch (std::exception const& error) {
    throw InputError(path.string() + ": " + error.what());
  }
}

}  // namespace credo
