#pragma once

#include <cstdint>
#include <vector>

#include "core/frame.hpp"
#include "core/grid.hpp"
#include "geometry/depth_registration.hpp"

namespace credo {

/// Whether depth and colour at the same pixel are of the same place.
enum class Registration : std::uint8_t { kUndecided, kRegistered, kUnregistered };

/// A mean over parts of the image, -1 to 1, and how many standard errors it is off zero.
struct RegistrationScore {
  double mean = 0.0;
  double significance = 0.0;
};

/// What the images say so far.
struct RegistrationEvidence {
  /// Parts of the image with edges enough to count, of 80.
  int parts = 0;
  /// Colour changes more at depth edges where they are delivered (above 0), or where they would be
  /// if they still had to be registered (below).
  RegistrationScore delivered;
  /// It changes more at them as delivered than 8 px beside.
  RegistrationScore as_delivered;
  /// It changes more at them once registered than 8 px beside.
  RegistrationScore once_registered;
};

/// Tells from the images alone whether a sensor's depth is registered to its colour, whatever the
/// device says of it: where something ends in depth, its colour mostly ends, too.
///
/// At the outermost pixels of what stands in front, the change of colour across the edge is
/// compared between the place as delivered, the place where the calibration would put it if depth
/// were the depth camera's own, and places beside these. Each part of the image has one vote, its
/// mean over time: edges that stay where they are do not count anew with each frame. A decision
/// takes 5 standard errors between the two, and 3 of the better one above what is beside it; so
/// scenes without edges, without colour, or with colours that have nothing to do with depth stay
/// undecided. So does depth that is off in another way than the calibration tells.
class RegistrationCheck {
public:
  /// Of the sizes of image that are added. Throws std::logic_error unless focal lengths are
  /// positive.
  explicit RegistrationCheck(DepthCalibration const& calibration = kinect_calibration());

  /// Looks at every fifth frame until it is decided, then at none, and tells what is known. Depth
  /// in metres, not positive or NaN where there is none. Images that are empty or differ in size
  /// say nothing.
  Registration add(Grid<float> const& depth_m, Grid<Rgb> const& color);

  [[nodiscard]] RegistrationEvidence evidence() const;

private:
  /// Sums over the depth edges in one part of the image.
  struct Part {
    int edges = 0;
    double delivered = 0.0;
    double as_delivered = 0.0;
    double once_registered = 0.0;
  };

  [[nodiscard]] Registration judged() const;
  [[nodiscard]] RegistrationScore score(double Part::*sum) const;
  void look(Grid<float> const& depth_m, Grid<Rgb> const& color);

  DepthCalibration calibration_;
  std::vector<Part> parts_;
  std::int64_t frames_ = 0;
  Registration decision_ = Registration::kUndecided;
};

}  // namespace credo
