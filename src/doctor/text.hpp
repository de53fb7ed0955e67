#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace credo {

/// With so many digits after the point.
inline std::string fixed_text(double value, int decimals) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(decimals) << value;
  return text.str();
}

inline std::string percent_text(double share) {
  return fixed_text(100.0 * share, share > 0.0 && share < 0.01 ? 1 : 0) + " %";
}

/// "045e:02ae", as lsusb writes it.
inline std::string usb_id_text(std::uint16_t vendor, std::uint16_t product) {
  std::ostringstream text;
  text << std::hex << std::setfill('0') << std::setw(4) << vendor << ':' << std::setw(4) << product;
  return text.str();
}

inline std::string joined(std::vector<std::string> const& texts) {
  std::string all;
  for (std::string const& text : texts) {
    all += (all.empty() ? "" : ", ") + text;
  }
  return all;
}

/// The first line of a file of the kernel's; none where it cannot be read.
inline std::optional<std::string> first_line(std::filesystem::path const& path) {
  std::ifstream file(path);
  std::string line;
  return std::getline(file, line) ? std::optional(line) : std::nullopt;
}

}  // namespace credo
