#include "tools/model_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "io/ply_writer.hpp"
#include "support/temp_folder.hpp"

namespace credo::test {
namespace {

namespace fs = std::filesystem;

/// An environment variable, as it was before at the end.
class Variable {
public:
  Variable(char const* name, char const* value) : name_(name) {
    if (char const* before = std::getenv(name); before != nullptr) {
      before_ = before;
    }
    set(value);
  }
  Variable(Variable const&) = delete;
  Variable& operator=(Variable const&) = delete;
  Variable(Variable&&) = delete;
  Variable& operator=(Variable&&) = delete;
  ~Variable() { set(before_ ? before_->c_str() : nullptr); }

private:
  void set(char const* value) { value != nullptr ? setenv(name_, value, 1) : unsetenv(name_); }
  char const* name_;
  std::optional<std::string> before_;
};

TEST(ModelFiles, TheCacheIsTheUsersOwn) {
  Variable const home("HOME", "/home/ada");
  {
    Variable const cache("XDG_CACHE_HOME", "/var/ada");
    EXPECT_EQ(model_cache("auto"), "/var/ada/credo");
  }
  for (char const* none : {static_cast<char const*>(nullptr), "", "not/absolute"}) {
    Variable const cache("XDG_CACHE_HOME", none);
    EXPECT_EQ(model_cache("auto"), "/home/ada/.cache/credo");
    Variable const homeless("HOME", nullptr);
    EXPECT_EQ(model_cache("auto"), "");
  }
}

TEST(ModelFiles, TheCacheIsWhereItIsTold) {
  EXPECT_EQ(model_cache("/srv/models"), "/srv/models");
  EXPECT_EQ(model_cache("models"), "models");
  EXPECT_EQ(model_cache(""), "");
}

class BareMesh : public ::testing::Test {
protected:
  BareMesh() {
    TriangleMesh sheet;
    sheet.vertices = {{0, 0, 0}, {0.1F, 0, 0}, {0, 0.1F, 0}};
    sheet.triangles = {{0, 1, 2}};
    write_ply(folder_ / "sail.ply", sheet);
  }

  TempFolder folder_;
  std::vector<std::string> warnings_;
};

TEST_F(BareMesh, IsAModelByItself) {
  ObjectModel const model = load_model(folder_ / "sail.ply", warnings_);
  EXPECT_EQ(model.name, "sail");
  EXPECT_TRUE(model.one_sided);
  EXPECT_EQ(std::get<TriangleMesh>(model.shape).triangles.size(), 1U);
  EXPECT_THAT(warnings_, ::testing::ElementsAre(::testing::HasSubstr("is open (3 edges")));
}

TEST_F(BareMesh, WhatAFileSaysOfItCounts) {
  write_text(folder_ / "a.yaml", "mesh: sail.ply\n");
  write_text(folder_ / "b.yml", "name: genoa\nmesh: sail.ply\none_sided: true\n");
  EXPECT_FALSE(load_model(folder_ / "a.yaml", warnings_).one_sided);
  EXPECT_EQ(load_model(folder_ / "b.yml", warnings_).name, "genoa");
  EXPECT_TRUE(load_model(folder_ / "b.yml", warnings_).one_sided);
}

TEST_F(BareMesh, IsCopiedWithAFileThatTellsOfIt) {
  copy_model(folder_ / "sail.ply", folder_ / "copy", "boat");
  ObjectModel const model = load_model(folder_ / "copy/boat.yaml", warnings_);
  EXPECT_TRUE(model.one_sided);
  EXPECT_EQ(std::get<TriangleMesh>(model.shape).triangles.size(), 1U);
}

}  // namespace
}  // namespace credo::test
