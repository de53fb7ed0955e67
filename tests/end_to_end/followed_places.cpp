#include "end_to_end/followed_places.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "end_to_end/recording_views.hpp"
#include "support/temp_folder.hpp"

namespace credo::test {
namespace {

// Pixels around a place in which it is looked for, and how far what they show may be from it.
constexpr int kAround_px = 4;
constexpr double kFarthest_m = 0.1;
/// Of 81 pixels.
constexpr int kLeastPixels = 20;

/// Where a camera sees a point; none outside the image, or too near its edge to look around.
std::optional<Pixel> pixel_of(Eigen::Vector3d const& p_camera, Frame const& frame) {
  if (p_camera.z() < 0.3) {
    return std::nullopt;
  }
  CameraIntrinsics const& k = frame.intrinsics;
  Pixel const pixel{static_cast<int>(std::lround(k.fx_px * p_camera.x() / p_camera.z() + k.cx_px)),
                    static_cast<int>(std::lround(k.fy_px * p_camera.y() / p_camera.z() + k.cy_px))};
  constexpr int kMargin_px = 2 * kAround_px;
  bool const inside = pixel.u >= kMargin_px && pixel.v >= kMargin_px &&
                      pixel.u < frame.cloud_camera.width() - kMargin_px &&
                      pixel.v < frame.cloud_camera.height() - kMargin_px;
  return inside ? std::optional(pixel) : std::nullopt;
}

std::vector<std::size_t> around(Pixel pixel, Grid<float> const& depth_m) {
  std::vector<std::size_t> pixels;
  for (int v = pixel.v - kAround_px; v <= pixel.v + kAround_px; ++v) {
    for (int u = pixel.u - kAround_px; u <= pixel.u + kAround_px; ++u) {
      pixels.push_back(depth_m.index({u, v}));
    }
  }
  return pixels;
}

/// NaN where there is no depth.
double median_depth_m(std::vector<std::size_t> const& pixels, Grid<float> const& depth_m) {
  std::vector<float> depths_m;
  for (std::size_t const i : pixels) {
    if (depth_m[i] > 0.0F) {
      depths_m.push_back(depth_m[i]);
    }
  }
  if (depths_m.empty()) {
    return std::nan("");
  }
  auto const middle = depths_m.begin() + static_cast<std::ptrdiff_t>(depths_m.size() / 2);
  std::ranges::nth_element(depths_m, middle);
  return static_cast<double>(*middle);
}

/// The thing whose label most of the pixels have; 0 for none.
std::uint32_t id_at(std::vector<std::size_t> const& pixels, LabelMap const& labels,
                    BeliefState const& belief) {
  std::map<LabelCode, int> counts;
  for (std::size_t const i : pixels) {
    if (is_stuff(labels[i])) {
      ++counts[labels[i]];
    }
  }
  auto const most = std::ranges::max_element(
      counts, {}, [](std::pair<LabelCode const, int> const& count) { return count.second; });
  if (most == counts.end() || most->second < kLeastPixels) {
    return 0;
  }
  auto const item =
      std::ranges::find(belief.stuff, std::optional(most->first), &StuffBelief::label);
  return item == belief.stuff.end() ? 0 : item->id;
}

void look_at(FollowedPlace& place, Frame const& frame, LabelMap const& labels,
             BeliefState const& belief) {
  Eigen::Vector3d const p_camera = frame.T_source_camera.inverse() * place.p_source;
  std::optional<Pixel> const pixel = pixel_of(p_camera, frame);
  if (!pixel) {
    return;
  }
  std::vector<std::size_t> const pixels = around(*pixel, frame.cloud_camera.z);
  if (!(std::abs(median_depth_m(pixels, frame.cloud_camera.z) - p_camera.z()) < kFarthest_m)) {
    return;
  }
  ++place.shown;
  std::uint32_t const id = id_at(pixels, labels, belief);
  if (id == 0) {
    ++place.lost;
    return;
  }
  place.switches += place.last_id != 0 && place.last_id != id ? 1 : 0;
  place.last_id = id;
  ++place.frames_of_id[id];
}

int frames_as_things(FollowedPlace const& place) {
  return place.shown - place.lost;
}

}  // namespace

std::vector<MarkedPlace> read_marked_places(std::filesystem::path const& file) {
  std::ifstream lines(file);
  std::vector<MarkedPlace> places;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') {
      continue;
    }
    MarkedPlace place;
    std::istringstream words(line);
    if (!(words >> place.thing >> place.frame >> place.pixel.u >> place.pixel.v)) {
      throw std::runtime_error(file.string() + ": no marked place: " + line);
    }
    places.push_back(std::move(place));
  }
  return places;
}

std::vector<FollowedPlace> places_of(std::filesystem::path const& recording,
                                     std::vector<MarkedPlace> const& marked) {
  std::set<std::int64_t> frames;
  for (MarkedPlace const& place : marked) {
    frames.insert(place.frame);
  }
  TempFolder const folder;
  std::vector<std::int64_t> const in_order(frames.begin(), frames.end());
  std::unique_ptr<FrameSource> const source = frames_of(recording, in_order, folder.path());
  std::vector<FollowedPlace> places;
  for (std::int64_t const number : in_order) {
    auto const frame = std::get<FramePtr>(source->next());
    for (MarkedPlace const& place : marked) {
      if (place.frame == number) {
        Grid<float> const& depth_m = frame->cloud_camera.z;
        double const z_m = median_depth_m(around(place.pixel, depth_m), depth_m);
        CameraIntrinsics const& k = frame->intrinsics;
        Eigen::Vector3d const p_camera((place.pixel.u - k.cx_px) * z_m / k.fx_px,
                                       (place.pixel.v - k.cy_px) * z_m / k.fy_px, z_m);
        places.push_back({.thing = place.thing, .p_source = frame->T_source_camera * p_camera});
      }
    }
  }
  return places;
}

std::vector<FollowedPlace> follow(std::unique_ptr<FrameSource> source, PipelineConfig const& config,
                                  std::vector<FollowedPlace> places) {
  for_each_result(std::move(source), config, [&](FrameResult const& result) {
    for (FollowedPlace& place : places) {
      look_at(place, *result.frame, result.segmentation->labels, *result.belief);
    }
  });
  return places;
}

double switches_per_1000(std::vector<FollowedPlace> const& places) {
  int frames = 0;
  int switches = 0;
  for (FollowedPlace const& place : places) {
    frames += frames_as_things(place);
    switches += place.switches;
  }
  return 1000.0 * switches / std::max(1, frames);
}

std::string report_of(std::vector<FollowedPlace> const& places) {
  std::ostringstream text;
  for (FollowedPlace const& place : places) {
    text << std::left << std::setw(12) << place.thing << " shown " << place.shown << ", lost "
         << place.lost << ", switches " << place.switches << ", ids " << place.frames_of_id.size()
         << '\n';
  }
  text << "switches per 1000: " << switches_per_1000(places) << '\n';
  return text.str();
}

}  // namespace credo::test
