#pragma once

#include <optional>
#include <string>
#include <vector>

namespace credo::freenect {

/// The Kinects on the bus at a time.
struct Presence {
  /// Of those that can be read, in the order of the bus.
  std::vector<std::string> serials;
  /// Plugged in, but not to be read: no permission, mostly.
  int unreadable = 0;
};

struct PresenceChanges {
  std::vector<std::string> came;
  std::vector<std::string> went;
  /// Where their number has become another.
  std::optional<int> unreadable;
};

/// What is known of the bus, from one look to the next.
class PresenceRecord {
public:
  /// Remembers what is there now, and tells what is new. A serial counts once.
  PresenceChanges update(Presence const& now);
  /// A Kinect that went between two looks; it comes again where the next look finds it.
  void forget(std::string const& serial);

private:
  Presence known_;
};

}  // namespace credo::freenect
