#include "doctor/openni_install.hpp"

#include <gtest/gtest.h>

#include "doctor/fake_root.hpp"
#include "doctor/finding_matchers.hpp"

namespace credo::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

namespace fs = std::filesystem;

/// A library in `lib` that is not there: only its place counts.
OpenniInstall install_in(FakeRoot const& root) {
  return read_openni_install({root.path() / "lib/libOpenNI2.so.0", "2.2.0.33"}, root.path());
}

OpenniInstall with_modules(std::vector<OpenniModule> modules) {
  return {{"/usr/lib/libOpenNI2.so.0", "2.2.0.33"}, "/usr/lib/OpenNI2/Drivers", false, modules};
}

TEST(OpenniInstall, TakesWhatOpenniTakes) {
  FakeRoot const root;
  for (char const* name : {"libb.so.0", "liba.so.0", "liba.so", "a.so.0", "liba.so.0.bak"}) {
    root.write(std::string("lib/OpenNI2/Drivers/") + name, "");
  }
  OpenniInstall const install = install_in(root);
  EXPECT_EQ(install.drivers, root.path() / "lib/OpenNI2/Drivers");
  EXPECT_FALSE(install.drivers_of_ini);
  EXPECT_THAT(install.modules, ElementsAre(Field(&OpenniModule::name, "liba.so.0"),
                                           Field(&OpenniModule::name, "libb.so.0")));
}

TEST(OpenniInstall, TheIniNamesAnotherFolder) {
  struct Case {
    char const* ini;
    fs::path drivers;
  };
  FakeRoot const root;
  for (Case const& c : {
           Case{"[Log]\nVerbosity=3\n[Drivers]\nRepository=/opt/drivers\n", "/opt/drivers"},
           Case{"[Drivers]\nRepository=../drivers\n", root.path() / "lib/../drivers"},
           Case{"[Drivers]\n;Repository=/opt/drivers\n", root.path() / "lib/OpenNI2/Drivers"},
           // As Debian's 2.2.0.33 was seen to read it.
           Case{"[Drivers]\nRepository = /opt/drivers\n", root.path() / "lib/OpenNI2/Drivers"},
           Case{"[Other]\nRepository=/opt/drivers\n", root.path() / "lib/OpenNI2/Drivers"},
       }) {
    root.write("etc/openni2/OpenNI.ini", c.ini);
    EXPECT_EQ(install_in(root).drivers, c.drivers) << c.ini;
  }
}

TEST(OpenniInstall, WhatCannotBeLoadedSaysWhy) {
  FakeRoot const root;
  root.write("lib/OpenNI2/Drivers/libbroken.so.0", "no library");
  root.link("lib/OpenNI2/Drivers/libgone.so.0", "/nowhere/libgone.so.0");
  // A library, but no driver.
  root.link("lib/OpenNI2/Drivers/libother.so.0", "/lib/x86_64-linux-gnu/libm.so.6");
  OpenniInstall const install = install_in(root);
  ASSERT_EQ(install.modules.size(), 3U);
  EXPECT_THAT(install.modules[0].trouble, HasSubstr("file too short"));
  EXPECT_EQ(install.modules[1].dangles_to, "/nowhere/libgone.so.0");
  if (fs::exists("/lib/x86_64-linux-gnu/libm.so.6")) {
    EXPECT_EQ(install.modules[2].trouble, "is no driver of OpenNI2");
  }
  auto const findings = openni_findings(install, false);
  EXPECT_THAT(findings, Contains(error("libbroken.so.0", "file too short", "reinstall")));
  EXPECT_THAT(findings, Contains(error("libgone.so.0", "a link to /nowhere/libgone.so.0",
                                       "reinstall libopenni2-0")));
  EXPECT_THAT(findings, Contains(error("drivers", "none in", "reinstall")));
}

TEST(OpenniInstall, AllIsWell) {
  OpenniInstall const install =
      with_modules({{"libPS1080.so.0", "", ""}, {"libcredo_freenect.so.0", "", ""}});
  EXPECT_TRUE(install.has_kinect_driver());
  EXPECT_THAT(openni_findings(install, true),
              ElementsAre(ok("library", "/usr/lib/libOpenNI2.so.0, version 2.2.0.33"),
                          ok("drivers",
                             "libPS1080.so.0, libcredo_freenect.so.0 in "
                             "/usr/lib/OpenNI2/Drivers"),
                          ok("Kinect driver")));
}

TEST(OpenniInstall, AKinectsDriverIsMissedWhereAKinectIs) {
  OpenniInstall const install = with_modules({{"libPS1080.so.0", "", ""}});
  EXPECT_THAT(troubles(openni_findings(install, true)),
              ElementsAre(error("Kinect driver", "none", "make drivers")));
  EXPECT_THAT(troubles(openni_findings(install, false)),
              ElementsAre(warning("Kinect driver", "none", "make drivers")));
}

TEST(OpenniInstall, ADriverThatDoesNotLoadIsNone) {
  OpenniInstall const install = with_modules(
      {{"libPS1080.so.0", "", ""},
       {"libcredo_freenect.so.0",
        "libfreenect.so.0.5: cannot open shared object file: No such file or directory", ""}});
  EXPECT_FALSE(install.has_kinect_driver());
  EXPECT_THAT(troubles(openni_findings(install, true)),
              ElementsAre(error("libcredo_freenect.so.0", "cannot open shared object file",
                                "apt-file search libfreenect.so.0.5"),
                          error("Kinect driver", "none")));
}

TEST(OpenniInstall, OfTwoKinectDriversOneIsTooMany) {
  OpenniInstall const both =
      with_modules({{"libFreenectDriver.so.0", "", ""}, {"libcredo_freenect.so.0", "", ""}});
  EXPECT_THAT(troubles(openni_findings(both, true)),
              ElementsAre(warning("Kinect driver", "two of them",
                                  "rm /usr/lib/OpenNI2/Drivers/libFreenectDriver.so.0")));
  OpenniInstall const other = with_modules({{"libFreenectDriver.so.0", "", ""}});
  EXPECT_THAT(troubles(openni_findings(other, true)), IsEmpty());
}

TEST(OpenniInstall, AFolderOfTheInisOwnWithoutDrivers) {
  OpenniInstall install = with_modules({});
  install.drivers_of_ini = true;
  EXPECT_THAT(openni_findings(install, false),
              Contains(error("drivers", "(of /etc/openni2/OpenNI.ini)", "Repository=")));
}

// The one that this test runs with.
TEST(OpenniInstall, TheLibraryOfThisProcess) {
  OpenniLibraryFile const file = openni_library_file();
  EXPECT_EQ(file.path.filename(), "libOpenNI2.so.0");
  EXPECT_TRUE(fs::exists(file.path));
  EXPECT_THAT(file.version, testing::MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+\\.[0-9]+"));
  EXPECT_THAT(read_openni_install(file).modules,
              Contains(AllOf(Field(&OpenniModule::name, "libOniFile.so.0"),
                             Field(&OpenniModule::trouble, ""))));
}

}  // namespace
}  // namespace credo::test
