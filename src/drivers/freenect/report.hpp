#pragma once

#include <exception>
#include <stdexcept>
#include <string>

#include "drivers/openni_driver_api.hpp"

namespace credo::freenect {

/// To OpenNI's getExtendedError().
inline void append_error(oni::driver::DriverServices& services, std::string const& text) {
  services.errorLoggerAppend("%s", text.c_str());  // NOLINT(cppcoreguidelines-pro-type-vararg)
}

/// Does what may throw KinectError; its text becomes OpenNI's, for its getExtendedError().
template <typename Action>
OniStatus reported(oni::driver::DriverServices& services, Action&& action) {
  try {
    action();
    return ONI_STATUS_OK;
  } catch (std::exception const& error) {
    append_error(services, error.what());
    return ONI_STATUS_ERROR;
  }
}

inline void log_warning(oni::driver::DriverServices& services, std::string const& line) {
  constexpr int kWarning = 2;
  services.log(kWarning, __FILE__, __LINE__, "credo.freenect", line.c_str());
}

/// Hands a property's value out, where there is room for it.
template <typename T>
OniStatus answer(T const& value, void* data, int* size) {
  if (*size < static_cast<int>(sizeof(T))) {
    return ONI_STATUS_BAD_PARAMETER;
  }
  *static_cast<T*>(data) = value;
  *size = static_cast<int>(sizeof(T));
  return ONI_STATUS_OK;
}

/// A property's value as it was handed in; throws std::invalid_argument where it is cut.
template <typename T>
T const& given(void const* data, int size) {
  if (size < static_cast<int>(sizeof(T))) {
    throw std::invalid_argument("a property's value is cut short");
  }
  return *static_cast<T const*>(data);
}

}  // namespace credo::freenect
