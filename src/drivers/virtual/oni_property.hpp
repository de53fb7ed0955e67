#pragma once

#include <cstring>
#include <optional>

#include "drivers/openni_driver_api.hpp"

namespace credo {

/// Hands a property's value to OpenNI2; what it has room for is in `size`, and then what it got.
template <typename T>
OniStatus answer(T const& value, void* data, int* size) {
  if (*size < static_cast<int>(sizeof(T))) {
    return ONI_STATUS_BAD_PARAMETER;
  }
  std::memcpy(data, &value, sizeof(T));
  *size = static_cast<int>(sizeof(T));
  return ONI_STATUS_OK;
}

/// What a client wants a property to be; none where that is not of its type's size.
template <typename T>
std::optional<T> asked_for(void const* data, int size) {
  if (size != static_cast<int>(sizeof(T))) {
    return std::nullopt;
  }
  T value;
  std::memcpy(&value, data, sizeof(T));
  return value;
}

}  // namespace credo
