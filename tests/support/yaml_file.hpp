#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "config/yaml_config.hpp"
#include "core/error.hpp"
#include "support/temp_folder.hpp"

namespace credo::test {

/// What is read from a file of this text, by fields(T&).
template <typename T>
T read_yaml(std::filesystem::path const& file, std::string const& yaml,
            std::vector<std::string> const& overrides = {}) {
  write_text(file, yaml);
  T value;
  load_config(fields(value), {file}, overrides);
  return value;
}

/// What is wrong with the file by what `work` throws, its name told as FILE; empty where all is
/// well.
template <typename Work>
std::string error_in(std::filesystem::path const& file, Work const& work) {
  try {
    work();
  } catch (InputError const& error) {
    std::string text = error.what();
    std::string const name = file.string();
    for (std::size_t at = 0; (at = text.find(name)) != std::string::npos;) {
      text.replace(at, name.size(), "FILE");
    }
    return text;
  }
  return {};
}

}  // namespace credo::test
