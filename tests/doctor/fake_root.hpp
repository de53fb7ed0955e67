#pragma once

#include <filesystem>
#include <string>

#include "support/temp_folder.hpp"

namespace credo::test {

/// A folder that stands for /, with what a test lays into it.
class FakeRoot {
public:
  [[nodiscard]] std::filesystem::path const& path() const { return folder_.path(); }

  void write(std::string const& file, std::string const& text) const {
    std::filesystem::create_directories((path() / file).parent_path());
    write_text(path() / file, text);
  }
  void link(std::string const& file, std::string const& target) const {
    std::filesystem::create_directories((path() / file).parent_path());
    std::filesystem::create_symlink(target, path() / file);
  }

  /// A device on bus 1, with a node that may be used.
  void plug_in(std::string const& port, std::string const& vendor, std::string const& product,
               int number, std::string const& speed = "480") const {
    std::string const device = "sys/bus/usb/devices/" + port + "/";
    write(device + "idVendor", vendor + "\n");
    write(device + "idProduct", product + "\n");
    write(device + "busnum", "1\n");
    write(device + "devnum", std::to_string(number) + "\n");
    write(device + "speed", speed + "\n");
    std::string const digits = std::to_string(number);
    write("dev/bus/usb/001/" + std::string(3 - digits.size(), '0') + digits, "");
  }
  /// The kernel's driver of a device's first interface.
  void bind(std::string const& port, std::string const& driver) const {
    link("sys/bus/usb/devices/" + port + ":1.0/driver", "../../drivers/" + driver);
  }

private:
  TempFolder folder_;
};

}  // namespace credo::test
