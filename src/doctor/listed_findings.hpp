#pragma once

#include <string>
#include <vector>

#include "doctor/finding.hpp"
#include "doctor/openni_install.hpp"
#include "doctor/usb_bus.hpp"
#include "openni/sensor_list.hpp"

namespace credo {

/// What OpenNI2 lists, and what is on the bus and not listed.
std::vector<Finding> listed_findings(std::vector<SensorInfo> const& listed, UsbState const& usb,
                                     OpenniInstall const& install);

}  // namespace credo
