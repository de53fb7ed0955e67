#pragma once

namespace credo {

/// Memory of this process that is in RAM now, in MB (10^6 bytes); 0 where /proc does not tell.
[[nodiscard]] double resident_mb();
/// The most it ever was.
[[nodiscard]] double peak_resident_mb();
/// Gives free memory back to the system, as far as the C library (glibc) can; elsewhere nothing
/// happens. What many threads free again and again lies scattered over its arenas, which grow to
/// the most that all of them ever held at once. Takes milliseconds, in which others that ask for
/// memory may wait.
void give_back_free_memory();
/// Processor time of all threads of this process so far, user and system.
[[nodiscard]] double cpu_seconds();

}  // namespace credo
