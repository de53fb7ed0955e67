#pragma once

#include <filesystem>
#include <string>

namespace credo::test {

/// The file of a frame in the layout with poses; `kind` is depth.png, color.png or pose.txt.
std::filesystem::path frame_file(std::filesystem::path const& folder, int frame,
                                 std::string const& kind);

/// A recording of so many equal frames: the floor that a level camera sees from 1 m above, 80 x 60.
void write_floor_dataset(std::filesystem::path const& folder, int frames);

/// The same as organised clouds NNNN.pcd.
void write_floor_clouds(std::filesystem::path const& folder, int frames);

}  // namespace credo::test
