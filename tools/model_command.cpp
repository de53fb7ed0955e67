#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "commands.hpp"
#include "config_arguments.hpp"
#include "core/error.hpp"
#include "detector/models/model_picture.hpp"
#include "geometry/shapes/learned_surface.hpp"
#include "geometry/shapes/mesh_edges.hpp"
#include "io/image.hpp"
#include "io/pcd.hpp"
#include "io/ply_writer.hpp"
#include "source_uri.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;

constexpr char const* kExamples = R"(Examples:
  credo model milk.pcd --out milk.ply --picture milk.png
  credo model scan.pcd --box -0.1 -0.2 0.7 0.1 0.1 0.9 --out cup.ply
  credo model --source dataset:recordings/cup --frames 0:20 --box 1.9 -0.1 0.725 2.1 0.1 0.95 --out cup.ply

Makes a mesh of what was seen of an object: of a point cloud from one place (PCD, its VIEWPOINT; axes as
capture.axes says), or of frames with poses. --box is what holds the object and nothing else, two corners in the frame of the cloud or of the poses: begin
it some millimetres above the table. Its middle becomes the model's origin; a cloud without a box keeps its own. Where nobody looked the
mesh stays open. `credo detect --model cup.ply` looks for it, as a thing that shows its outside alone.)";

struct ModelCommand {
  fs::path cloud;
  std::string source;
  ConfigArguments config;
  std::string frames;
  std::vector<double> box;
  fs::path out;
  fs::path picture;
};

using Box = std::optional<Eigen::AlignedBox3d>;

/// First and last frame, both taken.
struct FrameSpan {
  std::int64_t first = 0;
  std::int64_t last = std::numeric_limits<std::int64_t>::max();
};

FrameSpan span_of(std::string const& text) {
  FrameSpan span;
  if (text.empty()) {
    return span;
  }
  char const* const end = text.data() + text.size();
  auto const first = std::from_chars(text.data(), end, span.first);
  bool good = first.ec == std::errc() && first.ptr != end && *first.ptr == ':';
  if (good) {
    auto const last = std::from_chars(first.ptr + 1, end, span.last);
    good = last.ec == std::errc() && last.ptr == end;
  }
  if (!good || span.first < 0 || span.last < span.first) {
    throw InputError("--frames " + text + ": write FIRST:LAST, as in 0:20");
  }
  return span;
}

Box box_of(std::vector<double> const& corners) {
  if (corners.empty()) {
    return std::nullopt;
  }
  Eigen::AlignedBox3d const box(Eigen::Vector3d(corners[0], corners[1], corners[2]),
                                Eigen::Vector3d(corners[3], corners[4], corners[5]));
  if (!(box.sizes().array() > 0.0).all() || !box.sizes().allFinite()) {
    throw InputError("--box: its second corner must be greater than its first along x, y and z");
  }
  return box;
}

SeenPoints seen_of_cloud(fs::path const& path, CloudAxes axes, Box const& box) {
  ViewedPoints const viewed = read_pcd_points(path, axes);
  if (!box) {
    return {viewed.points, viewed.viewpoint};
  }
  Eigen::Vector3f const middle = box->center().cast<float>();
  SeenPoints seen{{}, viewed.viewpoint - middle};
  for (Eigen::Vector3f const& point : viewed.points) {
    if (box->contains(point.cast<double>())) {
      seen.points.emplace_back(point - middle);
    }
  }
  return seen;
}

std::vector<SeenPoints> seen_of_frames(ModelCommand const& command, PipelineConfig const& config,
                                       Eigen::AlignedBox3d const& box) {
  FrameSpan const span = span_of(command.frames);
  auto const note = [](std::string const& text) { std::cerr << "warning: " << text << '\n'; };
  OpenedSource const opened = open_source(command.source, config.capture, config.pose,
                                          config.sensor, config.sim, note, std::stop_token());
  for (std::string const& warning : opened.warnings) {
    note(warning);
  }
  std::vector<SeenPoints> views;
  while (true) {
    SourceResult const result = opened.source->next();
    if (auto const* failure = std::get_if<FrameFailure>(&result)) {
      note(failure->message);
      if (failure->loss == Loss::kSilence || number(failure->index) >= span.last) {
        return views;
      }
      continue;
    }
    auto const* frame = std::get_if<FramePtr>(&result);
    if (frame == nullptr || number((*frame)->index) > span.last) {
      return views;
    }
    if (number((*frame)->index) < span.first) {
      continue;
    }
    if (SeenPoints seen = seen_in(**frame, box); !seen.points.empty()) {
      views.push_back(std::move(seen));
    }
  }
}

std::vector<SeenPoints> seen_by(ModelCommand const& command, Box const& box) {
  if (command.cloud.empty() == command.source.empty()) {
    throw InputError("give a cloud or --source, one of them");
  }
  PipelineConfig const config = resolved_config(command.config);
  if (!command.cloud.empty()) {
    if (!command.frames.empty()) {
      throw InputError("--frames is for --source: a cloud is one view");
    }
    return {seen_of_cloud(command.cloud, config.capture.axes, box)};
  }
  if (!box) {
    throw InputError("--source needs --box, which holds the object and nothing else");
  }
  return seen_of_frames(command, config, *box);
}

std::string summary(ModelCommand const& command, LearnedSurface const& learned, std::size_t views,
                    Box const& box) {
  Eigen::AlignedBox3f bounds;
  for (Eigen::Vector3f const& vertex : learned.mesh.vertices) {
    bounds.extend(vertex);
  }
  Eigen::Vector3f const size = bounds.sizes();
  std::size_t open = 0;
  for (MeshEdge const& edge : edges_of(learned.mesh)) {
    open += edge.left && edge.right ? 0 : 1;
  }
  std::string text = fmt::format(
      "{}: {:.3f} x {:.3f} x {:.3f} m, {} vertices, {} triangles, {} open edges\n"
      "{} points of {} view{}, {} of them used, on a grid of {:.1f} mm\n",
      command.out.string(), size.x(), size.y(), size.z(), learned.mesh.vertices.size(),
      learned.mesh.triangles.size(), open, learned.points, views, views == 1 ? "" : "s",
      learned.used_points, 1000.0F * learned.spacing_m);
  if (box) {
    Eigen::Vector3d const middle = box->center();
    text += fmt::format("origin: the middle of the box, {:.4f} {:.4f} {:.4f}\n", middle.x(),
                        middle.y(), middle.z());
  } else {
    text += "origin: the cloud's own\n";
  }
  return text;
}

int learn(ModelCommand const& command) {
  if (command.out.extension() != ".ply") {
    throw InputError("--out " + command.out.string() + ": a mesh is written as NAME.ply");
  }
  Box const box = box_of(command.box);
  std::vector<SeenPoints> const views = seen_by(command, box);
  LearnedSurface const learned = learned_surface(views);
  std::string const from = command.cloud.empty() ? command.source : command.cloud.string();
  if (learned.points == 0) {
    throw InputError(from + (box ? ": shows no point in the box; it is told in the frame of the "
                                   "cloud or of the poses, in metres"
                                 : ": has no points"));
  }
  if (learned.mesh.triangles.empty()) {
    throw InputError(fmt::format("{}: makes no surface: its {} points are too few or too far apart",
                                 from, learned.points));
  }
  write_ply(command.out, learned.mesh);
  if (!command.picture.empty()) {
    write_png_rgb(command.picture, draw_model(learned.mesh));
  }
  std::cout << summary(command, learned, views.size(), box);
  return 0;
}

}  // namespace

void add_model_command(CLI::App& app, Command& chosen) {
  auto command = std::make_shared<ModelCommand>();
  CLI::App* sub = app.add_subcommand("model", "Make a mesh of an object that was seen");
  sub->footer(kExamples);
  sub->add_option("cloud", command->cloud, "a point cloud, PCD")->type_name("FILE");
  sub->add_option("--source", command->source,
                  "dataset:DIR, oni:FILE or sim:NAME-or-FILE, with poses")
      ->type_name("URI");
  add_config_arguments(*sub, command->config);
  sub->add_option("--frames", command->frames, "of the source, from 0; all if left out")
      ->type_name("FIRST:LAST");
  sub->add_option("--box", command->box, "x y z of its lower corner, then of its upper, metres")
      ->expected(6)
      ->type_name("M");
  sub->add_option("--out", command->out, "the mesh")->required()->type_name("FILE.ply");
  sub->add_option("--picture", command->picture, "PNG of it from six sides")->type_name("FILE");
  sub->callback([command, &chosen] { chosen = [command] { return learn(*command); }; });
}

}  // namespace credo
