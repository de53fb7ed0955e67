#pragma once

#include <cstdint>

#include "core/frame.hpp"
#include "core/segmentation.hpp"
#include "dds/participant.hpp"

namespace credo {

/// Writes what a frame showed to its topic (idl/credo/segmentation.idl), where anyone listens.
class SegmentationWriter {
public:
  explicit SegmentationWriter(Participant const& participant);

  /// `revision` is of the belief after the frame. False where DDS did not take it at once.
  bool write(Segmentation const& segmentation, CameraIntrinsics const& intrinsics,
             std::uint64_t revision);

private:
  std::string source_;
  DdsEntity writer_;
};

}  // namespace credo
