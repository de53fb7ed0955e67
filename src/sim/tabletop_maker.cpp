#include "sim/tabletop_maker.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <stdexcept>
#include <utility>
#include <variant>

#include "geometry/convex_hull.hpp"
#include "geometry/shapes/outline.hpp"
#include "sim/height_field.hpp"
#include "sim/mesh_making.hpp"
#include "sim/resting.hpp"

namespace credo {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr int kFieldWidth = 660;
constexpr int kFieldDepth = 410;

using Random = std::mt19937_64;

double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

int uniform_int(Random& random, int low, int high) {
  return std::uniform_int_distribution<int>(low, high)(random);
}

Eigen::Vector3d rpy_deg_of(Eigen::Quaterniond const& turn) {
  Eigen::Vector3d const yaw_pitch_roll = turn.toRotationMatrix().eulerAngles(2, 1, 0);
  return yaw_pitch_roll.reverse() / kDegree;
}

/// The sides of the box around a mesh, the least first.
Eigen::Vector3d sorted_sides(TriangleMesh const& mesh) {
  Eigen::AlignedBox3d box;
  for (Eigen::Vector3f const& vertex : mesh.vertices) {
    box.extend(vertex.cast<double>());
  }
  Eigen::Vector3d sides = box.sizes();
  std::ranges::sort(sides);
  return sides;
}

/// From where one looks at a table with so much on it.
void place_camera(TabletopScene& scene, TabletopKind kind, Random& random) {
  bool const sparse = kind == TabletopKind::kSparse;
  double const azimuth = uniform(random, -135.0, -45.0) * kDegree;
  double const elevation =
      (sparse ? uniform(random, 20.0, 50.0) : uniform(random, 30.0, 60.0)) * kDegree;
  double const distance_m = uniform(random, 0.85, sparse ? 1.4 : 1.2);
  scene.look_at_m = {uniform(random, -0.05, 0.05), uniform(random, -0.05, 0.05),
                     kTabletopHeight_m + 0.06};
  scene.camera_m =
      scene.look_at_m + distance_m * Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth),
                                                     std::cos(elevation) * std::sin(azimuth),
                                                     std::sin(elevation));
  scene.wall_y_m = uniform(random, 0.6, 1.6);
}

}  // namespace

struct TabletopMaker::Body {
  std::string name;
  TriangleMesh mesh;
  Eigen::Vector3d centre_of_mass_m;
  std::vector<Rest> rests;
  /// The rest in which z is up, if there is one.
  std::optional<Rest> upright;
  Eigen::Vector3d sides_m;
};

/// A table that fills up.
class TabletopMaker::Table {
public:
  Table(TabletopScene& scene, Random& random)
      : scene_(scene), random_(random), field_(kFieldWidth, kFieldDepth) {}

  /// Anywhere within so far of the middle, on the table itself.
  bool put_apart(Body const& body, Eigen::Vector2d const& reach_m);
  /// Pushed along the table until it touches something.
  bool put_beside(Body const& body);
  bool put_on(Body const& body);
  /// Tilted, pushed until it leans.
  bool put_leaning(Body const& body);
  void put_unknown(std::vector<Body> const& known);

private:
  struct Turned {
    Eigen::Quaterniond turn;
    Footprint footprint;
    Eigen::Vector2d mass_m;  // from the footprint's first cell
  };

  Eigen::Quaterniond some_rest(Body const& body);
  Eigen::Vector2d some_place();
  [[nodiscard]] static Turned turned(Body const& body, Eigen::Quaterniond const& turn);
  /// The last place before it is lifted, and the first where it is.
  [[nodiscard]] std::optional<std::pair<Drop, Drop>> pushed(Footprint const& footprint,
                                                            Eigen::Vector2d const& toward);
  [[nodiscard]] Pixel first_cell(Footprint const& footprint, Eigen::Vector2d const& origin) const;
  [[nodiscard]] static bool is_held(std::vector<Eigen::Vector2d> const& contacts,
                                    Turned const& body, Drop const& drop, double margin_m);
  void keep(std::string const& name, Turned const& body, Drop const& drop);

  TabletopScene& scene_;
  Random& random_;
  HeightField field_;
  /// Origins of what lies there, in cells of the field.
  std::vector<Eigen::Vector2d> places_;
};

Eigen::Quaterniond TabletopMaker::Table::some_rest(Body const& body) {
  Eigen::Quaterniond const yaw(
      Eigen::AngleAxisd(uniform(random_, 0.0, 2.0 * std::numbers::pi), Eigen::Vector3d::UnitZ()));
  double chance = uniform(random_, 0.0, 1.0);
  if (chance < 0.6 && body.upright) {
    return yaw * body.upright->turn;
  }
  chance = uniform(random_, 0.0, 1.0);
  for (Rest const& rest : body.rests) {
    chance -= rest.share;
    if (chance <= 0.0) {
      return yaw * rest.turn;
    }
  }
  return yaw * body.rests.back().turn;
}

Eigen::Vector2d TabletopMaker::Table::some_place() {
  return places_[static_cast<std::size_t>(
      uniform_int(random_, 0, static_cast<int>(places_.size()) - 1))];
}

TabletopMaker::Table::Turned TabletopMaker::Table::turned(Body const& body,
                                                          Eigen::Quaterniond const& turn) {
  Turned result{turn, footprint_of(moved(body.mesh, Se3(turn, Eigen::Vector3d::Zero()))), {}};
  result.mass_m = (result.footprint.origin_m + turn * body.centre_of_mass_m).head<2>();
  return result;
}

Pixel TabletopMaker::Table::first_cell(Footprint const& footprint,
                                       Eigen::Vector2d const& origin) const {
  Eigen::Vector2d const first = origin - footprint.origin_m.head<2>() / kHeightCell_m;
  return {static_cast<int>(std::lround(first.x())), static_cast<int>(std::lround(first.y()))};
}

bool TabletopMaker::Table::is_held(std::vector<Eigen::Vector2d> const& contacts, Turned const& body,
                                   Drop const& drop, double margin_m) {
  Eigen::Vector2d const mass =
      body.mass_m + kHeightCell_m * Eigen::Vector2d(drop.cell.u, drop.cell.v);
  return depth_inside(convex_polygon(contacts), mass) >= margin_m;
}

void TabletopMaker::Table::keep(std::string const& name, Turned const& body, Drop const& drop) {
  field_.add(body.footprint, drop);
  Eigen::Vector2d const origin_m =
      body.footprint.origin_m.head<2>() + kHeightCell_m * Eigen::Vector2d(drop.cell.u, drop.cell.v);
  places_.emplace_back(origin_m / kHeightCell_m);
  TabletopThing thing;
  thing.model = name;
  thing.position_m = {origin_m.x() - 0.5 * (kFieldWidth - 1) * kHeightCell_m,
                      origin_m.y() - 0.5 * (kFieldDepth - 1) * kHeightCell_m,
                      kTabletopHeight_m + drop.height_m + body.footprint.origin_m.z()};
  thing.rpy_deg = rpy_deg_of(body.turn);
  scene_.things.push_back(thing);
}

bool TabletopMaker::Table::put_apart(Body const& body, Eigen::Vector2d const& reach_m) {
  Turned const one = turned(body, some_rest(body));
  for (int i = 0; i < 60; ++i) {
    Eigen::Vector2d const from_middle =
        reach_m.cwiseProduct(Eigen::Vector2d(uniform(random_, -1, 1), uniform(random_, -1, 1)));
    Eigen::Vector2d const origin =
        Eigen::Vector2d(kFieldWidth, kFieldDepth) / 2.0 + from_middle / kHeightCell_m;
    auto const drop = field_.drop(one.footprint, first_cell(one.footprint, origin));
    if (drop && drop->height_m == 0.0) {
      keep(body.name, one, *drop);
      return true;
    }
  }
  return false;
}

std::optional<std::pair<Drop, Drop>> TabletopMaker::Table::pushed(Footprint const& footprint,
                                                                  Eigen::Vector2d const& toward) {
  // Of three things the most central: the heap stays together.
  Eigen::Vector2d const middle(0.5 * kFieldWidth, 0.5 * kFieldDepth);
  Eigen::Vector2d goal = some_place();
  for (int i = 0; i < 2; ++i) {
    Eigen::Vector2d const other = some_place();
    goal = (other - middle).norm() < (goal - middle).norm() ? other : goal;
  }
  constexpr int kWay = 150;
  std::optional<Drop> before;
  for (int step = -kWay; step <= 0; ++step) {
    auto const drop = field_.drop(footprint, first_cell(footprint, goal + step * toward));
    if (drop && drop->height_m > 0.0) {
      return before ? std::optional(std::pair(*before, *drop)) : std::nullopt;
    }
    before = drop;
  }
  return std::nullopt;
}

bool TabletopMaker::Table::put_beside(Body const& body) {
  Turned const one = turned(body, some_rest(body));
  for (int i = 0; i < 20; ++i) {
    double const angle = uniform(random_, 0.0, 2.0 * std::numbers::pi);
    if (auto const found = pushed(one.footprint, {std::cos(angle), std::sin(angle)})) {
      keep(body.name, one, found->first);
      return true;
    }
  }
  return false;
}

bool TabletopMaker::Table::put_on(Body const& body) {
  constexpr double kTouch_m = 0.0005;
  constexpr double kMargin_m = 0.008;
  constexpr double kHighest_m = 0.2;
  Turned const one = turned(body, some_rest(body));
  for (int i = 0; i < 60; ++i) {
    Eigen::Vector2d const origin =
        some_place() + Eigen::Vector2d(uniform(random_, -25, 25), uniform(random_, -25, 25));
    auto const drop = field_.drop(one.footprint, first_cell(one.footprint, origin));
    if (drop && drop->height_m > 0.005 && drop->height_m < kHighest_m &&
        is_held(field_.contacts(one.footprint, *drop, kTouch_m), one, *drop, kMargin_m)) {
      keep(body.name, one, *drop);
      return true;
    }
  }
  return false;
}

bool TabletopMaker::Table::put_leaning(Body const& body) {
  constexpr double kTouch_m = 0.001;
  constexpr double kMargin_m = 0.002;
  for (int i = 0; i < 12; ++i) {
    double const angle = uniform(random_, 0.0, 2.0 * std::numbers::pi);
    Eigen::Vector2d const toward(std::cos(angle), std::sin(angle));
    // The upper end goes where it is pushed.
    Eigen::Quaterniond const tilt(Eigen::AngleAxisd(uniform(random_, 12.0, 40.0) * kDegree,
                                                    Eigen::Vector3d(-toward.y(), toward.x(), 0.0)));
    Turned const one = turned(body, tilt * some_rest(body));
    auto const found = pushed(one.footprint, toward);
    if (!found) {
      continue;
    }
    auto contacts = field_.contacts(one.footprint, found->first, kTouch_m);
    auto const pushed_at = field_.contacts(one.footprint, found->second, kTouch_m);
    contacts.insert(contacts.end(), pushed_at.begin(), pushed_at.end());
    if (is_held(contacts, one, found->first, kMargin_m)) {
      keep(body.name, one, found->first);
      return true;
    }
  }
  return false;
}

void TabletopMaker::Table::put_unknown(std::vector<Body> const& known) {
  TabletopThing thing;
  thing.shape = static_cast<SceneShape>(uniform_int(random_, 0, 2));
  Solid solid;
  if (thing.shape == SceneShape::kBox) {
    thing.size_m = {uniform(random_, 0.05, 0.22), uniform(random_, 0.05, 0.22),
                    uniform(random_, 0.05, 0.22)};
    solid = box_on_base({thing.size_m[0], thing.size_m[1], thing.size_m[2]});
  } else if (thing.shape == SceneShape::kCylinder) {
    thing.size_m = {uniform(random_, 0.02, 0.08), uniform(random_, 0.05, 0.22)};
    solid = CylinderSolid{thing.size_m[0], thing.size_m[1]};
  } else {
    thing.size_m = {uniform(random_, 0.03, 0.09)};
    solid = SphereSolid{thing.size_m[0]};
  }
  Body body{"", mesh_of(solid), Eigen::Vector3d::Zero(), {{}}, Rest{}, {}};
  // What has the sides of a known object, to a fifth, might be taken for it with good reason.
  Eigen::Array3d const sides = sorted_sides(body.mesh).array();
  for (Body const& other : known) {
    if (((sides / other.sides_m.array() - 1.0).abs() < 0.2).all()) {
      return;
    }
  }
  if (!put_apart(body, {0.35, 0.26})) {
    return;
  }
  scene_.things.back().shape = thing.shape;
  scene_.things.back().size_m = thing.size_m;
}

TabletopMaker::TabletopMaker(ObjectModels const& models) {
  for (auto const& [name, model] : models) {
    auto const* const mesh = std::get_if<TriangleMesh>(&model.shape);
    if (mesh == nullptr) {
      throw std::logic_error("TabletopMaker: model " + name + " is not a mesh");
    }
    Body body{name, *mesh, centre_of_mass(*mesh), rests_of(*mesh), {}, sorted_sides(*mesh)};
    for (Rest const& rest : body.rests) {
      if ((rest.turn * Eigen::Vector3d::UnitZ()).z() > std::cos(2.0 * kDegree)) {
        body.upright = rest;
      }
    }
    bodies_.push_back(std::move(body));
  }
}

TabletopMaker::~TabletopMaker() = default;

TabletopScene TabletopMaker::make(TabletopKind kind, std::string const& name, int seed) const {
  Random random(static_cast<std::uint64_t>(seed));
  TabletopScene scene;
  scene.name = name;
  scene.seed = seed;
  place_camera(scene, kind, random);
  std::vector<Body const*> order;
  for (Body const& body : bodies_) {
    order.push_back(&body);
  }
  std::ranges::shuffle(order, random);
  bool const sparse = kind == TabletopKind::kSparse;
  auto const wanted =
      static_cast<std::size_t>(sparse ? uniform_int(random, 3, 8) : uniform_int(random, 18, 22));
  if (!sparse) {
    // What is wide goes below.
    std::stable_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(wanted),
                     [](Body const* a, Body const* b) {
                       return a->sides_m.tail<2>().prod() > b->sides_m.tail<2>().prod();
                     });
  }
  Table table(scene, random);
  for (Body const* const body : order) {
    if (scene.things.size() == wanted) {
      break;
    }
    if (sparse || scene.things.empty()) {
      table.put_apart(*body, sparse ? Eigen::Vector2d(0.3, 0.22) : Eigen::Vector2d(0.08, 0.08));
      continue;
    }
    double const how = uniform(random, 0.0, 1.0);
    bool const put = how < 0.4 ? table.put_on(*body) : how < 0.6 ? table.put_leaning(*body) : false;
    if (!put) {
      table.put_beside(*body);
    }
  }
  std::size_t const all =
      scene.things.size() + (sparse ? static_cast<std::size_t>(uniform_int(random, 1, 4)) : 0U);
  for (int tries = 0; tries < 100 && scene.things.size() < all; ++tries) {
    table.put_unknown(bodies_);
  }
  return scene;
}

}  // namespace credo
