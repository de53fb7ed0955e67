#include "detector/poses/edge_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "detector/scenes/scene_projection.hpp"

namespace credo {
namespace {

constexpr float kReach_m = 0.020F;
constexpr float kJump_px = 1.5F;
constexpr float kCrease_px = 4.0F;

/// What a pixel on the line is to the surface that is followed.
enum class Step : std::uint8_t { kOn, kBeyond, kOtherSegment, kInFront, kUnknown };

class Line {
public:
  Line(SearchModel const& model, SearchScene const& scene, Eigen::Vector3f const& inside,
       Eigen::Vector3f const& direction)
      : model_(model),
        scene_(scene),
        project_(scene),
        inside_(inside),
        direction_(direction),
        tolerance_m_(depth_tolerance_m(inside.z())) {}

  /// `segment`: of the surface that is followed; 0 before it is known.
  [[nodiscard]] Step at(float distance_m, std::uint16_t segment) const {
    ScenePixel const* pixel = project_(inside_ + distance_m * direction_);
    if (pixel == nullptr || pixel->depth_m <= 0.0F) {
      return Step::kUnknown;
    }
    float const d_m = pixel->depth_m - inside_.z();
    if (d_m < -tolerance_m_) {
      return Step::kInFront;
    }
    if (d_m > tolerance_m_) {
      return Step::kBeyond;
    }
    if (scene_.is_background(*pixel, model_.diameter_m) ||
        (segment != 0 && pixel->segment != segment)) {
      return Step::kOtherSegment;
    }
    return Step::kOn;
  }
  [[nodiscard]] std::uint16_t segment_at(float distance_m) const {
    ScenePixel const* pixel = project_(inside_ + distance_m * direction_);
    return pixel != nullptr ? pixel->segment : std::uint16_t{0};
  }

private:
  SearchModel const& model_;
  SearchScene const& scene_;
  SceneProjection project_;
  Eigen::Vector3f inside_;
  Eigen::Vector3f direction_;
  float tolerance_m_;
};

/// Where the surface ends, from the inner point on, and how well that is known.
struct End {
  EdgeVerdict verdict = EdgeVerdict::kOpen;
  float distance_m = 0.0F;
  float deviation_px = 0.0F;
};

End end_at(float distance_m, float step_m, Step outside) {
  if (outside == Step::kInFront || outside == Step::kUnknown) {
    return {EdgeVerdict::kHidden};
  }
  return {EdgeVerdict::kFound, distance_m - 0.5F * step_m,
          outside == Step::kBeyond ? kJump_px : kCrease_px};
}

End find_end(Line const& line, float step_m) {
  Step const inside = line.at(0.0F, 0);
  if (inside == Step::kOn) {
    std::uint16_t const segment = line.segment_at(0.0F);
    for (float distance_m = step_m; distance_m <= kReach_m; distance_m += step_m) {
      Step const step = line.at(distance_m, segment);
      if (step != Step::kOn) {
        return end_at(distance_m, step_m, step);
      }
    }
    return {};
  }
  Step outside = inside;
  for (float distance_m = -step_m; distance_m >= -kReach_m; distance_m -= step_m) {
    Step const step = line.at(distance_m, 0);
    if (step == Step::kOn) {
      return end_at(distance_m + step_m, step_m, outside);
    }
    outside = step;
  }
  bool const hidden = inside == Step::kInFront || inside == Step::kUnknown;
  return {hidden ? EdgeVerdict::kHidden : EdgeVerdict::kOpen};
}

}  // namespace

EdgeLook look_at_edge(SearchModel const& model, SearchScene const& scene, CameraPose const& pose,
                      OutlinePair const& pair) {
  Eigen::Vector3f const inside = pose * pair.inside_model;
  Eigen::Vector3f const outside = pose * pair.outside_model;
  // The view that the pair comes from may be a few degrees off.
  Eigen::Vector3f const ray = inside.normalized();
  Eigen::Vector3f const across = (outside - inside) - ray * ray.dot(outside - inside);
  if (!(inside.z() > 0.0F) || !(across.squaredNorm() > 0.0F)) {
    return {};
  }
  Eigen::Vector3f const direction = across.normalized();
  float const pixel_m = inside.z() / static_cast<float>(scene.intrinsics.fx_px);
  End const end = find_end(Line(model, scene, inside, direction), pixel_m);
  EdgeLook look;
  look.verdict = end.verdict;
  look.contact.direction = direction;
  look.contact.point = inside + pair.inside_m * direction;
  look.contact.residual_m = end.distance_m - pair.inside_m;
  look.contact.deviation_m = std::max(0.002F, end.deviation_px * pixel_m);
  return look;
}

}  // namespace credo
