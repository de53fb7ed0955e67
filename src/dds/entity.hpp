#pragma once

#include <cstdint>

namespace credo {

/// A handle of Cyclone DDS that is deleted with its owner; 0 holds none.
class DdsEntity {
public:
  DdsEntity() = default;
  explicit DdsEntity(std::int32_t handle) : handle_(handle) {}
  DdsEntity(DdsEntity const&) = delete;
  DdsEntity& operator=(DdsEntity const&) = delete;
  DdsEntity(DdsEntity&& other) noexcept;
  DdsEntity& operator=(DdsEntity&& other) noexcept;
  ~DdsEntity();

  [[nodiscard]] std::int32_t handle() const { return handle_; }

private:
  std::int32_t handle_ = 0;
};

}  // namespace credo
