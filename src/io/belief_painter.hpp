#pragma once

#include <Eigen/Core>
#include <map>
#include <string>

#include "core/belief.hpp"
#include "core/frame.hpp"
#include "core/outline.hpp"
#include "core/segmentation.hpp"
#include "io/canvas.hpp"
#include "io/palette.hpp"

namespace credo {

/// The colours of the stuff that a frame shows and the belief knows: those of its ids, so that
/// segmentation and belief agree.
std::map<LabelCode, Rgb> colors_of_stuff(BeliefState const& belief);

/// Draws what a frame shows and what a belief holds into one view of the world, in the thesis'
/// colours. `outlines` outlive it.
class BeliefPainter {
public:
  /// Points are squares of 2 point_px - 1 pixels.
  BeliefPainter(View const& view, Canvas& canvas, Outlines const& outlines, int point_px = 1);

  /// Lines a metre apart on the floor, six metres around `centre`.
  void metre_grid(Eigen::Vector3d const& centre);
  /// Cyan, every third pixel of every third row: what is neither floor, wall nor stuff.
  void cloud(Frame const& frame, LabelMap const& labels, Se3 const& T_world_camera);
  /// All of the frame's points in the camera's colours; grey where it has none.
  void cloud_in_color(Frame const& frame, Se3 const& T_world_camera);
  /// All of the frame's points in the colours of their labels, known objects as the cloud.
  void segmentation(Frame const& frame, LabelMap const& labels, BeliefState const& belief);
  /// Floor red, walls pink with their segments on the floor, stuff paler as its probability falls.
  void surroundings(BeliefState const& belief);
  /// Known objects at their mean poses, by their positions in the belief, paler likewise.
  void objects(BeliefState const& belief);
  /// `share` of each line is drawn, as dots. A type without an outline is shown by its axes.
  void outline(std::string const& type, Se3 const& pose, Rgb color, double share);
  /// Its axes.
  void camera(Se3 const& T_world_camera);

private:
  void points(PointList const& list, Rgb color);
  void axes(Se3 const& pose, double length_m, Rgb color);

  View view_;
  Splats splats_;
  Outlines const& outlines_;
  int point_px_;
};

}  // namespace credo
