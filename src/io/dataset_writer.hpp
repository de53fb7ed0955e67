#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "core/frame.hpp"
#include "core/label.hpp"

namespace credo {

/// Writes frames as a dataset that open_dataset reads back: TUM RGB-D (depth/ and rgb/ as PNG,
/// depth.txt, rgb.txt, groundtruth.txt) with camera-intrinsics.txt, and beside it truth/ and
/// truth.jsonl. Depth is rounded to 0.2 mm, beyond 13.1 m it is lost; whole millimetres, colour,
/// stamps and poses come back as they were. Every failure to write throws InputError that names
/// the file.
class DatasetWriter {
public:
  /// Makes the folder. Throws InputError where it has frames already: two datasets in one folder
  /// would read as one.
  explicit DatasetWriter(std::filesystem::path folder);

  /// Frames in order. The first settles the intrinsics.
  void write(Frame const& frame);
  void write_truth(FrameIndex frame, std::string const& json_line, LabelMap const& labels);

private:
  void append(std::ofstream& list, std::string const& name, std::string const& line) const;

  std::filesystem::path folder_;
  std::ofstream depth_;
  std::ofstream color_;
  std::ofstream poses_;
  std::ofstream truth_;
};

}  // namespace credo
