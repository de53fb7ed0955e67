#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "doctor/finding.hpp"
#include "openni/openni_library_file.hpp"

namespace credo {

/// A file that OpenNI2 takes for a driver.
struct OpenniModule {
  std::string name;
  /// Why it cannot be loaded; else empty.
  std::string trouble;
  /// A link whose target is not there; else empty.
  std::string dangles_to;

  [[nodiscard]] bool loads() const { return trouble.empty() && dangles_to.empty(); }
};

/// What OpenNI2 will load.
struct OpenniInstall {
  OpenniLibraryFile library;
  std::filesystem::path drivers;
  /// The folder is that of /etc/openni2/OpenNI.ini, not the usual one.
  bool drivers_of_ini = false;
  /// By name.
  std::vector<OpenniModule> modules;

  /// Whether a driver for the Kinect is among those that load.
  [[nodiscard]] bool has_kinect_driver() const;
};

/// The drivers as Debian's 2.2.0.33 finds them: lib*.so.0 in OpenNI2/Drivers beside the library,
/// or in the folder that Repository in [Drivers] of etc/openni2/OpenNI.ini below `root` names,
/// relative to the library or absolute; no environment variable says otherwise. Loads each for a
/// moment.
OpenniInstall read_openni_install(OpenniLibraryFile library,
                                  std::filesystem::path const& root = "/");

/// `kinect_is_there`: on the bus; its driver is then not to be missed.
std::vector<Finding> openni_findings(OpenniInstall const& install, bool kinect_is_there);

}  // namespace credo
