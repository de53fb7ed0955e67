#include "openni/openni_library_file.hpp"

#include <OpenNI.h>
#include <dlfcn.h>

namespace credo {

OpenniLibraryFile openni_library_file() {
  OpenniLibraryFile file;
  // By name: the address that a program itself sees may be that of its own jump table.
  Dl_info info{};
  void* const function = dlsym(RTLD_DEFAULT, "oniGetVersion");
  if (function != nullptr && dladdr(function, &info) != 0) {
    file.path = info.dli_fname;
  }
  openni::Version const version = openni::OpenNI::getVersion();
  file.version = std::to_string(version.major) + "." + std::to_string(version.minor) + "." +
                 std::to_string(version.maintenance) + "." + std::to_string(version.build);
  return file;
}

}  // namespace credo
