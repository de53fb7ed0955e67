#pragma once

namespace credo {

/// Memory of this process that is in RAM now, in MB (10^6 bytes); 0 where /proc does not tell.
[[nodiscard]] double resident_mb();
/// The most it ever was.
[[nodiscard]] double peak_resident_mb();
/// Processor time of all threads of this process so far, user and system.
[[nodiscard]] double cpu_seconds();

}  // namespace credo
