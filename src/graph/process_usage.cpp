#include "graph/process_usage.hpp"

#include <sys/resource.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <fstream>
#include <sstream>
#include <string>

namespace credo {
namespace {

/// A line of /proc/self/status such as "VmRSS:     12345 kB".
double status_mb(std::string const& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(key)) {
      double kib = 0.0;
      std::istringstream(line.substr(key.size())) >> kib;
      return kib * 1024.0 * 1e-6;
    }
  }
  return 0.0;
}

double seconds(timeval const& time) {
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
}

}  // namespace

double resident_mb() {
  return status_mb("VmRSS:");
}

double peak_resident_mb() {
  return status_mb("VmHWM:");
}

void give_back_free_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace credo
