#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "support/temp_folder.hpp"

namespace credo::test {

/// How a program ended.
struct Ended {
  /// Its exit code; 128 + the signal where one killed it.
  int code = -1;
  std::string out;
  std::string err;
};

/// A program that runs beside the test. Killed at the end where it still does.
class Program {
public:
  explicit Program(std::vector<std::string> arguments);
  Program(Program const&) = delete;
  Program& operator=(Program const&) = delete;
  Program(Program&&) = delete;
  Program& operator=(Program&&) = delete;
  ~Program();

  void send(int signal) const;
  Ended wait();

private:
  TempFolder folder_;
  pid_t pid_ = -1;
};

/// The real `credo` with these arguments, run to its end.
Ended credo(std::vector<std::string> arguments);
/// The command line of it, for Program.
std::vector<std::string> credo_command(std::vector<std::string> arguments);

std::string read_text(std::filesystem::path const& path);
std::vector<std::string> read_lines(std::filesystem::path const& path);

}  // namespace credo::test
