#include "doctor/openni_install.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <fstream>
#include <utility>

#include "doctor/text.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;

constexpr char const* kKinectDriver = "libcredo_freenect.so.0";
/// What libfreenect's own sources build.
constexpr char const* kOtherKinectDriver = "libFreenectDriver.so.0";

constexpr char const* kGetKinectDriver =
    "build it and run with it: make drivers && LD_LIBRARY_PATH=build/openni2 credo doctor; or "
    "install it: sudo cmake --install build";

/// Repository in [Drivers]; empty where there is none. OpenNI2 takes no blanks around the sign.
std::string repository_in(fs::path const& ini) {
  constexpr char const* kKey = "Repository=";
  std::ifstream file(ini);
  bool in_drivers = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("[")) {
      in_drivers = line.starts_with("[Drivers]");
    } else if (in_drivers && line.starts_with(kKey)) {
      return line.substr(std::string(kKey).size());
    }
  }
  return "";
}

bool is_module_name(std::string const& name) {
  return name.starts_with("lib") && name.ends_with(".so.0");
}

OpenniModule look_at(fs::path const& file) {
  OpenniModule module;
  module.name = file.filename();
  std::error_code error;
  if (fs::is_symlink(file, error) && !fs::exists(file, error)) {
    module.dangles_to = fs::read_symlink(file, error);
    return module;
  }
  // dlerror keeps a text for each thread.
  // NOLINTBEGIN(concurrency-mt-unsafe)
  void* const handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    module.trouble = dlerror();
  } else {
    module.trouble = dlsym(handle, "oniDriverCreate") == nullptr ? "is no driver of OpenNI2" : "";
    dlclose(handle);
  }
  // NOLINTEND(concurrency-mt-unsafe)
  return module;
}

bool loads(std::vector<OpenniModule> const& modules, char const* name) {
  return std::ranges::any_of(
      modules, [&](OpenniModule const& module) { return module.name == name && module.loads(); });
}

std::string advice_for(OpenniModule const& module) {
  std::string const missing = ": cannot open shared object file";
  if (module.trouble.find(missing) != std::string::npos) {
    std::string const library = module.trouble.substr(0, module.trouble.find(missing));
    return "find and install the package that has " + library + ": apt-file search " + library +
           "; or build again: make drivers";
  }
  return module.name.starts_with("libcredo_")
             ? "build it again: make drivers"
             : "install it again: sudo apt install --reinstall libopenni2-0; then make drivers";
}

void judge_modules(OpenniInstall const& install, Section& section) {
  std::vector<std::string> good;
  for (OpenniModule const& module : install.modules) {
    if (module.loads()) {
      good.push_back(module.name);
    } else if (!module.dangles_to.empty()) {
      section.error(module.name, "is a link to " + module.dangles_to + ", which is not there",
                    advice_for(module));
    } else {
      section.error(module.name, "cannot be loaded: " + module.trouble, advice_for(module));
    }
  }
  std::string const folder =
      install.drivers.string() + (install.drivers_of_ini ? " (of /etc/openni2/OpenNI.ini)" : "");
  if (good.empty()) {
    section.error("drivers", "none in " + folder + ": OpenNI2 does not start without",
                  install.drivers_of_ini
                      ? "take the line Repository= out of /etc/openni2/OpenNI.ini"
                      : "sudo apt install --reinstall libopenni2-0; then make drivers");
  } else {
    section.ok("drivers", joined(good) + " in " + folder);
  }
}

}  // namespace

bool OpenniInstall::has_kinect_driver() const {
  return loads(modules, kKinectDriver) || loads(modules, kOtherKinectDriver);
}

OpenniInstall read_openni_install(OpenniLibraryFile library, fs::path const& root) {
  OpenniInstall install;
  install.library = std::move(library);
  std::string const repository = repository_in(root / "etc/openni2/OpenNI.ini");
  install.drivers_of_ini = !repository.empty();
  install.drivers = install.library.path.parent_path() /
                    (repository.empty() ? std::string("OpenNI2/Drivers") : repository);
  std::error_code error;
  for (auto const& entry : fs::directory_iterator(install.drivers, error)) {
    if (is_module_name(entry.path().filename())) {
      install.modules.push_back(look_at(entry.path()));
    }
  }
  std::ranges::sort(install.modules, {}, &OpenniModule::name);
  return install;
}

std::vector<Finding> openni_findings(OpenniInstall const& install, bool kinect_is_there) {
  Section section("OpenNI2");
  section.ok("library", install.library.path.string() + ", version " + install.library.version);
  judge_modules(install, section);
  bool const ours = loads(install.modules, kKinectDriver);
  if (ours && loads(install.modules, kOtherKinectDriver)) {
    section.warning("Kinect driver",
                    std::string("two of them, ") + kKinectDriver + " and " + kOtherKinectDriver +
                        ", may open the same Kinect",
                    "keep one: sudo rm " + (install.drivers / kOtherKinectDriver).string());
  } else if (install.has_kinect_driver()) {
    section.ok("Kinect driver", ours ? kKinectDriver : kOtherKinectDriver);
  } else if (kinect_is_there) {
    section.error("Kinect driver", "none: OpenNI2 will not see the Kinect that is plugged in",
                  kGetKinectDriver);
  } else {
    section.warning("Kinect driver", "none: OpenNI2 would not see a Kinect", kGetKinectDriver);
  }
  return section.take();
}

}  // namespace credo
