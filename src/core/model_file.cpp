#include "core/model_file.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "core/se3.hpp"

namespace credo {
namespace {

constexpr Range kLength_m{1e-4, 100};

Field length(std::string name, double& value, std::string text) {
  return {std::move(name), &value, kLength_m, "m", std::move(text)};
}

Field lengths(std::string name, std::vector<double>& values, std::size_t count, std::string text) {
  return {std::move(name), NumbersTarget{&values, count, count}, kLength_m, "m", std::move(text)};
}

Field symmetry_field(SymmetryEntry& entry) {
  auto target = std::make_shared<OneOfTarget>();
  target->form = &entry.form;
  target->word = choice_target(entry.word, {"own", "none"});
  target->map = {
      {"axis", NumbersTarget{&entry.axis, 3, 3}, {}, "", "turns about it change nothing"},
      {"point", NumbersTarget{&entry.point_m, 3, 3}, {-100, 100}, "m", "a point of the axis"},
      {"both_ways", &entry.both_ways, {}, "", "turned end for end about the point it is the same"},
  };
  target->list = list_target(entry.turns);
  return {"symmetry",
          std::move(target),
          {},
          "",
          "own, none, {axis, point, both_ways}, or the list of all turns that change nothing"};
}

[[noreturn]] void refuse(std::string const& where, std::string const& what) {
  throw InputError(where + ": " + what);
}

Eigen::Vector3d vector_of(std::vector<double> const& v) {
  return {v[0], v[1], v[2]};
}

/// A shape that a vertical turn brings to itself: by a half, or by a quarter too.
std::vector<Eigen::Quaterniond> upright_turns(double x_m, double y_m) {
  std::vector<Eigen::Quaterniond> turns = {rotation_of_rpy_deg({0, 0, 180})};
  if (x_m == y_m) {
    turns.push_back(rotation_of_rpy_deg({0, 0, 90}));
    turns.push_back(rotation_of_rpy_deg({0, 0, -90}));
  }
  return turns;
}

/// How many of the ways to give a shape are used.
int shapes_given(ModelFile const& file) {
  return static_cast<int>(!file.box_m.empty()) +
         static_cast<int>(file.cylinder_radius_m > 0.0 || file.cylinder_height_m > 0.0) +
         static_cast<int>(!file.table_top_m.empty() || file.table_thickness_m > 0.0 ||
                          file.table_height_m > 0.0 || file.table_leg_m > 0.0) +
         static_cast<int>(!file.mesh.empty());
}

void give_table(ModelFile const& file, std::string const& where, ObjectModel& model) {
  if (file.table_top_m.empty() || file.table_thickness_m == 0.0 || file.table_height_m == 0.0 ||
      file.table_leg_m == 0.0) {
    refuse(where, "primitive.table needs top, thickness, height and leg");
  }
  Eigen::Vector2d const top(file.table_top_m[0], file.table_top_m[1]);
  if (!(file.table_thickness_m < file.table_height_m)) {
    refuse(where, "primitive.table: thickness must be less than height");
  }
  if (!(2.0 * file.table_leg_m <= top.minCoeff())) {
    refuse(where, "primitive.table: two legs must fit under each side of the top");
  }
  model.shape = table_on_base({top, file.table_height_m, file.table_thickness_m, file.table_leg_m});
  model.symmetry.rotations = upright_turns(top.x(), top.y());
}

/// The shape, with the symmetry that it has by itself.
void give_shape(ModelFile const& file, std::optional<TriangleMesh> mesh, std::string const& where,
                ObjectModel& model) {
  if (!file.box_m.empty()) {
    model.shape = std::vector<Solid>{box_on_base(vector_of(file.box_m))};
    model.symmetry.rotations = upright_turns(file.box_m[0], file.box_m[1]);
  } else if (mesh.has_value()) {
    model.shape = *std::move(mesh);
  } else if (file.cylinder_radius_m > 0.0 && file.cylinder_height_m > 0.0) {
    model.shape = std::vector<Solid>{CylinderSolid{file.cylinder_radius_m, file.cylinder_height_m}};
    model.symmetry.axis = SymmetryAxis{};
  } else if (file.cylinder_radius_m > 0.0 || file.cylinder_height_m > 0.0) {
    refuse(where, "primitive.cylinder needs radius and height");
  } else {
    give_table(file, where, model);
  }
}

Symmetry written_symmetry(SymmetryEntry const& entry, std::string const& where) {
  Symmetry symmetry;
  if (entry.form == Form::kMap) {
    if (entry.axis.empty() || !(vector_of(entry.axis).norm() > 1e-9)) {
      refuse(where, "symmetry.axis must be a direction that is not 0, 0, 0");
    }
    symmetry.axis = SymmetryAxis{vector_of(entry.axis).stableNormalized(), vector_of(entry.point_m),
                                 entry.both_ways};
  } else if (entry.form == Form::kList) {
    for (std::size_t i = 0; i < entry.turns.size(); ++i) {
      if (entry.turns[i].rpy_deg.empty()) {
        refuse(where, "symmetry[" + std::to_string(i) + "] needs rpy_deg");
      }
      symmetry.rotations.push_back(rotation_of_rpy_deg(vector_of(entry.turns[i].rpy_deg)));
    }
  }
  return symmetry;
}

}  // namespace

FieldList fields(SymmetryTurn& turn) {
  return {
      {"rpy_deg",
       NumbersTarget{&turn.rpy_deg, 3, 3},
       {-360, 360},
       "deg",
       "turns about the fixed axes x, y, z, through the model's origin"},
  };
}

FieldList fields(ModelFile& file) {
  FieldList const cylinder = {
      length("radius", file.cylinder_radius_m, "radius"),
      length("height", file.cylinder_height_m, "height"),
  };
  FieldList const table = {
      lengths("top", file.table_top_m, 2, "the top's sides along x and y"),
      length("thickness", file.table_thickness_m, "the top's thickness"),
      length("height", file.table_height_m, "from the floor to the upper side of the top"),
      length("leg", file.table_leg_m, "side of one of its four legs"),
  };
  return {
      {"name", &file.name, {}, "", "what objects and detections call it; the file's name if empty"},
      section("primitive",
              {
                  lengths("box", file.box_m, 3, "sides along x, y and z"),
                  section("cylinder", cylinder, "upright"),
                  section("table", table, "a top on four legs"),
              },
              "a shape that stands on the centre of its base, z up"),
      {"mesh", &file.mesh, {}, "", "a mesh's file, beside this one; it keeps its own frame"},
      choice("unit", file.unit, {"m", "mm"}, "of the mesh's numbers"),
      {"one_sided",
       &file.one_sided,
       {},
       "",
       "an open mesh whose triangles show their outside alone: what is behind was never seen"},
      symmetry_field(file.symmetry),
  };
}

ObjectModel model_of(ModelFile const& file, std::optional<TriangleMesh> mesh,
                     std::string const& where) {
  if (file.name.empty()) {
    refuse(where, "a model needs a name");
  }
  if (shapes_given(file) != 1) {
    refuse(where, "give one of primitive.box, primitive.cylinder, primitive.table and mesh");
  }
  if (file.mesh.empty() && file.unit != LengthUnit::kMetre) {
    refuse(where, "unit is that of a mesh's numbers; primitives are in metres");
  }
  if (file.mesh.empty() && file.one_sided) {
    refuse(where, "one_sided tells of a mesh; primitives are closed");
  }
  ObjectModel model;
  model.name = file.name;
  model.one_sided = file.one_sided;
  give_shape(file, std::move(mesh), where, model);
  SymmetryEntry const& entry = file.symmetry;
  if (entry.form != Form::kWord || entry.word != SymmetryEntry::Word::kOwn) {
    model.symmetry = written_symmetry(entry, where);
  }
  return model;
}

}  // namespace credo
