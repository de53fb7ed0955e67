#include "core/belief.hpp"

#include <stdexcept>

namespace credo {

char const* to_string(Evidence evidence) {
  switch (evidence) {
    case Evidence::kSeen:
      return "seen";
    case Evidence::kSeenThrough:
      return "seen_through";
    case Evidence::kOccluded:
      return "occluded";
    case Evidence::kOutOfView:
      return "out_of_view";
    case Evidence::kNotSeen:
      return "not_seen";
  }
  throw std::logic_error("Evidence: no such value");
}

}  // namespace credo
