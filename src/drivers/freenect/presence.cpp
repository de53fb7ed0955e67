#include "drivers/freenect/presence.hpp"

#include <algorithm>

namespace credo::freenect {
namespace {

bool contains(std::vector<std::string> const& serials, std::string const& serial) {
  return std::ranges::find(serials, serial) != serials.end();
}

}  // namespace

PresenceChanges PresenceRecord::update(Presence const& now) {
  PresenceChanges changes;
  for (std::string const& serial : now.serials) {
    if (!contains(known_.serials, serial) && !contains(changes.came, serial)) {
      changes.came.push_back(serial);
    }
  }
  for (std::string const& serial : known_.serials) {
    if (!contains(now.serials, serial) && !contains(changes.went, serial)) {
      changes.went.push_back(serial);
    }
  }
  if (now.unreadable != known_.unreadable) {
    changes.unreadable = now.unreadable;
  }
  known_ = now;
  return changes;
}

void PresenceRecord::forget(std::string const& serial) {
  std::erase(known_.serials, serial);
}

}  // namespace credo::freenect
