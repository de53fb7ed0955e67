#pragma once

#include <libfreenect.h>

#include "drivers/freenect/presence.hpp"

namespace credo::freenect {

/// Looks which Kinects are plugged in, by a context of libfreenect of its own. One thread at a
/// time.
class Bus {
public:
  /// Where libfreenect does not start, nothing is ever plugged in.
  Bus();
  Bus(Bus const&) = delete;
  Bus& operator=(Bus const&) = delete;
  Bus(Bus&&) = delete;
  Bus& operator=(Bus&&) = delete;
  ~Bus();

  Presence look();

private:
  freenect_context* context_ = nullptr;
};

/// What any context of libfreenect sees.
Presence look_at_bus(freenect_context* context);

}  // namespace credo::freenect
