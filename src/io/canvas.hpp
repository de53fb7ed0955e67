#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/frame.hpp"
#include "core/grid.hpp"
#include "core/se3.hpp"

namespace credo {

/// A rectangle of a picture, pixels.
struct Panel {
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;
};

/// A picture under construction.
class Canvas {
public:
  Canvas(int width, int height, Rgb background) : image_(width, height, background) {}

  /// Sets a pixel of a panel, (0, 0) its top left; outside of it nothing happens.
  void set(Panel const& panel, int x, int y, Rgb color) {
    if (x >= 0 && y >= 0 && x < panel.width && y < panel.height) {
      image_[Pixel{panel.left + x, panel.top + y}] = color;
    }
  }
  Grid<Rgb> take() { return std::move(image_); }

private:
  Grid<Rgb> image_;
};

/// How a panel shows the world: a virtual camera, or a map.
struct View {
  Panel panel;
  /// The virtual camera's optical frame in the world.
  Se3 T_view_world;
  /// Focal length [px]; for a map pixels per metre.
  double scale = 1.0;
  bool perspective = true;
  /// Where the optical axis meets the panel, from its middle [px].
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
  /// Vertical scale over horizontal: not 1 where pixels are not square.
  double aspect = 1.0;

  struct Projection {
    int x = 0;
    int y = 0;
    double depth_m = 0.0;
  };
  /// None behind the view or not finite.
  [[nodiscard]] std::optional<Projection> project(Eigen::Vector3d const& p_world) const;
  /// Whether a face with this outward normal is turned towards the viewer.
  [[nodiscard]] bool faces(Eigen::Vector3d const& p_world,
                           Eigen::Vector3d const& normal_world) const;
};

/// What the camera itself sees, in a panel that holds its whole image of `width_px` pixels.
View camera_view(Se3 const& T_world_camera, CameraIntrinsics const& intrinsics, int width_px,
                 Panel const& panel);
/// From behind and above the camera, looking where it looks.
View oblique_view(Se3 const& T_world_camera, Panel const& panel);
/// From straight above, world x to the right, y up, centred a little before the camera.
View map_view(Se3 const& T_world_camera, Panel const& panel);

/// How a line is drawn.
struct LineStyle {
  /// Of its points, evenly: less than 1 makes dots.
  double share = 1.0;
  /// Squares of 2 radius_px - 1 pixels.
  int radius_px = 1;
  /// So much nearer it counts than it is: a solid's edge wins over the noise of its surface.
  double ahead_m = 0.0;
};

/// Draws points and lines of one view with a depth test: the nearer wins.
class Splats {
public:
  Splats(View const& view, Canvas& canvas);
  /// A square of 2 radius_px - 1 pixels.
  void point(Eigen::Vector3d const& p_world, Rgb color, int radius_px, double ahead_m = 0.0);
  void line(Eigen::Vector3d const& a_world, Eigen::Vector3d const& b_world, Rgb color,
            LineStyle const& style = {});

private:
  View view_;
  Canvas& canvas_;
  Grid<float> depth_m_;
};

}  // namespace credo
