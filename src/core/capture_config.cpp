#include "core/capture_config.hpp"

namespace credo {

FieldList fields(CaptureConfig& config) {
  FieldList camera = {
      {"fx_px", &config.camera_fx_px, {0, 1e5}, "px", "horizontal focal length; 0 = not given"},
      {"fy_px", &config.camera_fy_px, {0, 1e5}, "px", "vertical focal length; 0 = not given"},
      {"cx_px", &config.camera_cx_px, {0, 1e5}, "px", "principal point, column"},
      {"cy_px", &config.camera_cy_px, {0, 1e5}, "px", "principal point, row"},
  };
  return {
      section("camera", std::move(camera),
              "intrinsics where the recording brings no camera-intrinsics.txt"),
      choice("axes", config.axes, {"auto", "optical", "y_up_z_back"},
             "axes of recorded clouds: optical is x right, y down, z forward; auto tells by the "
             "sign of z"),
      {"depth_unit_m",
       &config.depth_unit_m,
       {0, 1},
       "m",
       "metres per count of a 16-bit depth image; 0 = the layout's own"},
      choice("color_registered", config.color_registered, {"auto", "yes", "no"},
             "whether colour images are registered to depth; auto: clouds, the simulation and TUM "
             "folders are, a sensor if it says so, others are not"),
      {"max_depth_m", &config.max_depth_m, {0.1, 100}, "m", "depth beyond this is invalid"},
      {"independent_frames",
       &config.independent_frames,
       {},
       "",
       "each frame is a scene of its own: fresh belief, fresh level"},
  };
}

bool is_color_registered(CaptureConfig const& config, bool as_known) {
  return config.color_registered == ColorRegistered::kAuto
             ? as_known
             : config.color_registered == ColorRegistered::kYes;
}

FieldList fields(PoseConfig& config) {
  return {
      choice(
          "source", config.source, {"recorded", "file", "fixed"},
          "camera poses: the recording's own, those of pose.file, or a sensor that stands still"),
      {"file",
       &config.file,
       {},
       "",
       "trajectory for pose.source: file; lines 'stamp_s tx ty tz qx qy qz qw' or 16 numbers"},
      choice(
          "level", config.level, {"off", "auto", "given", "floor"},
          "off: the source is level, floor at z = 0; auto: find the floor and level by it what is "
          "not level yet; "
          "given: the first camera stands as camera_* say, above a floor at z = 0; floor: as auto, "
          "however little it leans"),
      {"camera_pitch_rad",
       &config.camera_pitch_rad,
       {-1.6, 1.6},
       "rad",
       "downward pitch of the first camera where no floor is in view, or level is given"},
      {"camera_roll_rad",
       &config.camera_roll_rad,
       {-3.2, 3.2},
       "rad",
       "roll to the right of the first camera where no floor is in view, or level is given"},
      {"camera_height_m",
       &config.camera_height_m,
       {-100, 100},
       "m",
       "height of the first camera where no floor is in view, or level is given"},
      {"camera_yaw_rad",
       &config.camera_yaw_rad,
       {-3.2, 3.2},
       "rad",
       "turn of the first camera where level is given, counterclockwise from above; 0: as auto "
       "turns it, the view along +y"},
      {"camera_x_m",
       &config.camera_x_m,
       {-1e4, 1e4},
       "m",
       "where the first camera stands where level is given"},
      {"camera_y_m",
       &config.camera_y_m,
       {-1e4, 1e4},
       "m",
       "where the first camera stands where level is given"},
      {"level_frames",
       &config.level_frames,
       {1, 1000},
       "frames",
       "frames to read ahead, at most, in search of the floor"},
  };
}

}  // namespace credo
