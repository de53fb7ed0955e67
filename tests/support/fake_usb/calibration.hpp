#pragma once

#include <cstdint>

#include "support/fake_usb/packets.hpp"

namespace credo::test::fake_usb {

/// What a Kinect answers when it is asked for its calibration.
///
/// Registration: how far each depth pixel moves, as a polynomial in differences.
Bytes registration_parameters();
/// Lines that the colour image has more than the depth image: none.
Bytes padding_parameters();
/// Raw value of a depth at the reference plane.
Bytes shift_parameters();
/// The reference plane, in a block with much else.
Bytes fixed_parameters();

}  // namespace credo::test::fake_usb
