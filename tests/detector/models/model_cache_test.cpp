// Prepared models that were kept are those that were made, to the bit, and a bad file is no harm.
#include "detector/models/model_cache.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "detector/bpa_detector.hpp"
#include "detector/models/model_archive.hpp"
#include "detector/views.hpp"
#include "io/sha256.hpp"
#include "support/meshes.hpp"
#include "support/temp_folder.hpp"

namespace credo::test {
namespace {

namespace fs = std::filesystem;

ObjectModel ring() {
  return {"ring", wavy_ring(24, 12), {}};
}

/// An open mesh, like a roof.
ObjectModel roof(bool one_sided) {
  TriangleMesh mesh;
  mesh.vertices = {{-0.1F, -0.1F, 0}, {-0.1F, 0.1F, 0}, {0, -0.1F, 0.06F},
                   {0, 0.1F, 0.06F},  {0.1F, -0.1F, 0}, {0.1F, 0.1F, 0}};
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {2, 4, 3}, {3, 4, 5}};
  return {"roof", mesh, {}, one_sided};
}

void expect_same(PreparedModel const& a, PreparedModel const& b) {
  EXPECT_EQ(a.model.one_sided, b.model.one_sided);
  EXPECT_EQ(a.model.centre_model, b.model.centre_model);
  EXPECT_EQ(a.model.radius_m, b.model.radius_m);
  EXPECT_EQ(a.model.diameter_m, b.model.diameter_m);
  EXPECT_EQ(a.model.surface_m2, b.model.surface_m2);
  EXPECT_EQ(a.model.points_model, b.model.points_model);
  EXPECT_EQ(a.model.normals_model, b.model.normals_model);
  EXPECT_EQ(a.model.spacing_m, b.model.spacing_m);
  EXPECT_EQ(a.model.vertices_model, b.model.vertices_model);
  EXPECT_EQ(a.model.triangles, b.model.triangles);
  ASSERT_EQ(a.model.facets.size(), b.model.facets.size());
  for (std::size_t i = 0; i < a.model.facets.size(); ++i) {
    Facet const& one = a.model.facets[i];
    Facet const& other = b.model.facets[i];
    EXPECT_EQ(one.normal, other.normal);
    EXPECT_EQ(one.centre_m, other.centre_m);
    EXPECT_EQ(one.along, other.along);
    EXPECT_EQ(one.half_length_m, other.half_length_m);
    EXPECT_EQ(one.half_width_m, other.half_width_m);
    EXPECT_EQ(one.points, other.points);
    EXPECT_EQ(one.segment, other.segment);
  }
  ASSERT_EQ(a.model.views.size(), b.model.views.size());
  for (std::size_t v = 0; v < a.model.views.size(); ++v) {
    ModelView const& one = a.model.views[v];
    ModelView const& other = b.model.views[v];
    EXPECT_EQ(one.to_camera_model, other.to_camera_model);
    EXPECT_EQ(one.visible, other.visible);
    EXPECT_EQ(one.area_m2, other.area_m2);
    ASSERT_EQ(one.outline.size(), other.outline.size());
    for (std::size_t i = 0; i < one.outline.size(); ++i) {
      EXPECT_EQ(one.outline[i].inside_model, other.outline[i].inside_model);
      EXPECT_EQ(one.outline[i].outside_model, other.outline[i].outside_model);
      EXPECT_EQ(one.outline[i].inside_m, other.outline[i].inside_m);
    }
  }
  EXPECT_EQ(a.pairs.references(), b.pairs.references());
  EXPECT_EQ(a.pairs.step_m(), b.pairs.step_m());
  EXPECT_EQ(a.pairs.size(), b.pairs.size());
  // What is not told apart above is in the archive.
  EXPECT_EQ(archived(a), archived(b));
}

std::vector<fs::path> files_in(fs::path const& folder) {
  std::vector<fs::path> files;
  for (auto const& entry : fs::directory_iterator(folder)) {
    files.push_back(entry.path());
  }
  return files;
}

class ModelCache : public ::testing::Test {
protected:
  /// The one file that is there.
  [[nodiscard]] fs::path file() const {
    std::vector<fs::path> const files = files_in(folder());
    EXPECT_EQ(files.size(), 1U);
    return files.at(0);
  }
  [[nodiscard]] fs::path folder() const { return folder_ / "a/cache"; }

  TempFolder folder_;
};

TEST_F(ModelCache, WhatIsKeptIsWhatWasMade) {
  for (ObjectModel const& object : {bracket(), ring(), roof(false), roof(true)}) {
    PreparedModel const made = prepared(object);
    expect_same(*kept_or_prepared(object, folder()), made);
    std::size_t const files = files_in(folder()).size();
    auto const kept = kept_or_prepared(object, folder());
    expect_same(*kept, made);
    EXPECT_EQ(kept->model.name, object.name);
    EXPECT_EQ(files_in(folder()).size(), files) << "one file a model, and nothing beside it";
  }
  EXPECT_EQ(files_in(folder()).size(), 4U);
}

TEST_F(ModelCache, TheSecondTimeTheFileIsRead) {
  // What cannot be told from the model's results: another archive under the right sum is taken.
  ObjectModel const object = bracket();
  std::ignore = kept_or_prepared(object, folder());
  std::vector<unsigned char> const other = archived(prepared(ring()));
  write_text(file(), "credo model " + cache_key(object) + " " + sha256_of(other) + "\n" +
                         std::string(other.begin(), other.end()));
  expect_same(*kept_or_prepared(object, folder()), prepared(ring()));
}

TEST_F(ModelCache, NameAndSymmetryAreTheModelsOwn) {
  ObjectModel object = bracket();
  std::ignore = kept_or_prepared(object, folder());
  object.name = "stand";
  object.symmetry.axis = SymmetryAxis{};
  auto const kept = kept_or_prepared(object, folder());
  EXPECT_EQ(files_in(folder()).size(), 1U);
  EXPECT_EQ(kept->model.name, "stand");
  EXPECT_TRUE(kept->model.symmetry.axis.has_value());
}

TEST_F(ModelCache, EveryDifferenceThatCountsHasItsOwnKey) {
  ObjectModel const plain = roof(false);
  auto const key_of = [&](auto const& change) {
    ObjectModel other = plain;
    change(std::get<TriangleMesh>(other.shape));
    return cache_key(other);
  };
  std::string const key = cache_key(plain);
  EXPECT_EQ(key.size(), 64U);
  EXPECT_EQ(key_of([](TriangleMesh&) {}), key);
  EXPECT_NE(key_of([](TriangleMesh& mesh) { mesh.vertices[5].z() += 1e-6F; }), key);
  EXPECT_NE(key_of([](TriangleMesh& mesh) { std::swap(mesh.triangles[0], mesh.triangles[1]); }),
            key);
  EXPECT_NE(key_of([](TriangleMesh& mesh) { mesh.triangles.pop_back(); }), key);
  EXPECT_NE(cache_key(roof(true)), key);
  // The same bytes, cut elsewhere into corners and triangles.
  EXPECT_NE(key_of([](TriangleMesh& mesh) {
              std::array<std::uint32_t, 3> bits;
              std::memcpy(bits.data(), mesh.vertices.back().data(), sizeof bits);
              mesh.vertices.pop_back();
              mesh.triangles.insert(mesh.triangles.begin(), bits);
            }),
            key);
}

TEST_F(ModelCache, ADamagedFileIsMadeAnew) {
  ObjectModel const object = roof(true);
  PreparedModel const made = prepared(object);
  std::ignore = kept_or_prepared(object, folder());
  std::string const good = text_of(file());
  std::vector<std::string> bad = {"",
                                  "credo",
                                  good + "x",
                                  good.substr(0, good.size() - 1),
                                  good.substr(0, 141),
                                  good.substr(0, 140),
                                  "x" + good.substr(1)};
  for (double const share : {0.0, 0.0001, 0.001, 0.3, 0.7, 0.99999}) {
    std::string damaged = good;
    char& byte = damaged[static_cast<std::size_t>(share * static_cast<double>(good.size()))];
    byte = static_cast<char>(byte ^ 4);
    bad.push_back(std::move(damaged));
  }
  for (std::string const& text : bad) {
    fs::path const path = file();
    write_text(path, text);
    expect_same(*kept_or_prepared(object, folder()), made);
    EXPECT_EQ(text_of(file()), good) << "it is replaced";
  }
}

TEST_F(ModelCache, AnothersFileUnderTheNameIsMadeAnew) {
  ObjectModel const object = bracket();
  std::ignore = kept_or_prepared(object, folder());
  std::ignore = kept_or_prepared(ring(), folder());
  fs::path const of_bracket = folder() / (cache_key(object) + ".model");
  fs::path const of_ring = folder() / (cache_key(ring()) + ".model");
  fs::copy_file(of_ring, of_bracket, fs::copy_options::overwrite_existing);
  expect_same(*kept_or_prepared(object, folder()), prepared(object));
}

TEST_F(ModelCache, WhereNothingCanBeWrittenItIsMadeEachTime) {
  ObjectModel const object = roof(false);
  write_text(folder_ / "file", "no folder");
  for (fs::path const& place : {folder_ / "file", folder_ / "file/below", fs::path("/proc/none")}) {
    expect_same(*kept_or_prepared(object, place), prepared(object));
  }
  EXPECT_EQ(text_of(folder_ / "file"), "no folder");
  // A folder stands where the file would be.
  fs::create_directories(folder() / (cache_key(object) + ".model") / "in it");
  expect_same(*kept_or_prepared(object, folder()), prepared(object));
  EXPECT_EQ(files_in(folder()).size(), 1U) << "nothing is left beside it";
}

TEST_F(ModelCache, WithoutAFolderNothingIsKept) {
  fs::path const before = fs::current_path();
  fs::current_path(folder_.path());
  expect_same(*kept_or_prepared(bracket(), {}), prepared(bracket()));
  EXPECT_TRUE(files_in(folder_.path()).empty());
  fs::current_path(before);
}

TEST_F(ModelCache, WithoutASurfaceIsAnErrorAndNotKept) {
  ObjectModel const ghost{"ghost", TriangleMesh{}, {}};
  EXPECT_THROW(std::ignore = kept_or_prepared(ghost, folder()), InputError);
  EXPECT_FALSE(fs::exists(folder()));
}

TEST_F(ModelCache, WhatIsFoundIsTheSame) {
  ObjectModels models;
  models.emplace("bracket", bracket());
  BpaConfig config;
  config.search = ObjectSearch::kGlobal;
  std::vector<DetectionRequest> const requests = {
      {"b", "bracket", {Se3(Eigen::Quaterniond::Identity(), {0, 0, 1}), Matrix6d::Identity()}}};
  FramePtr const frame = bracket_on_desk(0.4, {SensorModel::kDisparity}).frame;
  BpaDetector made(models, config);
  std::vector<Detection> const expected = made.detect(*frame, requests);
  ASSERT_EQ(expected.size(), 1U);
  for (int time = 0; time < 2; ++time) {
    BpaDetector kept(prepare_models(models, folder()), config);
    std::vector<Detection> const found = kept.detect(*frame, requests);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].pose_camera.mean.matrix(), expected[0].pose_camera.mean.matrix());
    EXPECT_EQ(found[0].pose_camera.covariance, expected[0].pose_camera.covariance);
    EXPECT_EQ(found[0].score, expected[0].score);
  }
  EXPECT_EQ(file().extension(), ".model");
}

/// How much of everything a prepared model holds.
struct Amounts {
  std::size_t points;
  std::size_t facets;
  std::size_t triangles;
  std::size_t references;
  double visible;
  double outline;
  double pairs;
};

void expect_amounts(PreparedModel const& prepared, Amounts const& expected) {
  SearchModel const& model = prepared.model;
  EXPECT_EQ(model.points_model.size(), expected.points);
  EXPECT_EQ(model.facets.size(), expected.facets);
  EXPECT_EQ(model.triangles.size(), expected.triangles);
  EXPECT_EQ(prepared.pairs.references().size(), expected.references);
  double visible = 0.0;
  double outline = 0.0;
  for (ModelView const& view : model.views) {
    visible += static_cast<double>(view.visible.size());
    outline += static_cast<double>(view.outline.size());
  }
  // Last bits, which are the mathematical library's, may move one over a border.
  constexpr double kShare = 1e-3;
  EXPECT_NEAR(visible, expected.visible, kShare * expected.visible);
  EXPECT_NEAR(outline, expected.outline, kShare * expected.outline);
  EXPECT_NEAR(static_cast<double>(prepared.pairs.size()), expected.pairs, kShare * expected.pairs);
}

// A kept file must not outlive a change of what preparing gives. Whoever changes that sees this
// fail: raise kPreparationVersion, then put the new amounts here.
TEST_F(ModelCache, TheVersionIsRaisedWithWhatPreparingGives) {
  EXPECT_EQ(kPreparationVersion, 3);
  expect_amounts(prepared(bracket()), {2082, 4, 36, 315, 124619, 10353, 294004});
  expect_amounts(prepared(ring()), {2288, 0, 576, 400, 134775, 10298, 964946});
  expect_amounts(prepared(roof(true)), {1747, 2, 4, 240, 127444, 6596, 287846});
}

TEST_F(ModelCache, AnArchiveOfAnyOtherLengthIsNone) {
  std::vector<unsigned char> const good = archived(prepared(roof(true)));
  ASSERT_TRUE(unarchived(good).has_value());
  for (std::size_t const size :
       {std::size_t{0}, std::size_t{1}, good.size() / 3, good.size() / 2, good.size() - 1}) {
    EXPECT_FALSE(unarchived(std::span(good).first(size)).has_value()) << size;
  }
  std::vector<unsigned char> longer = good;
  longer.push_back(0);
  EXPECT_FALSE(unarchived(longer).has_value());
}

}  // namespace
}  // namespace credo::test
