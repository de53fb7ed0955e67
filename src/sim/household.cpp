#include "sim/household.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "sim/mesh_making.hpp"

namespace credo {
namespace {

using Outline = std::vector<Eigen::Vector2d>;
using Path = std::vector<Eigen::Vector3d>;

constexpr double kPi = std::numbers::pi;

Se3 at(double x_m, double y_m, double z_m, Eigen::Vector3d const& rpy_deg = {0, 0, 0}) {
  return {rotation_of_rpy_deg(rpy_deg), {x_m, y_m, z_m}};
}

Symmetry half_turns_about_z() {
  return {std::nullopt, {rotation_of_rpy_deg({0, 0, 180})}};
}

/// What a box with three different sides looks the same after.
Symmetry half_turns() {
  return {std::nullopt,
          {rotation_of_rpy_deg({180, 0, 0}), rotation_of_rpy_deg({0, 180, 0}),
           rotation_of_rpy_deg({0, 0, 180})}};
}

ObjectModel round_thing(std::string name, Outline const& outline) {
  return {std::move(name), centred(revolved(outline)), {SymmetryAxis{}, {}}};
}

ObjectModel box_thing(std::string name, Eigen::Vector3d const& size_m) {
  return {std::move(name), block(size_m), half_turns()};
}

/// Its handle, spout or the like lies in the plane y = 0.
ObjectModel odd_thing(std::string name, std::vector<TriangleMesh> const& parts) {
  return {std::move(name), centred(joined(parts)), {}};
}

/// An arc in the plane y = 0, from one angle to another, counter-clockwise seen from -y.
Path arc(Eigen::Vector2d const& middle_xz_m, Eigen::Vector2d const& radii_m, double from_deg,
         double to_deg) {
  constexpr int kSteps = 12;
  Path path;
  for (int i = 0; i <= kSteps; ++i) {
    double const angle = (from_deg + (to_deg - from_deg) * i / kSteps) * kPi / 180.0;
    path.emplace_back(middle_xz_m.x() + radii_m.x() * std::cos(angle), 0.0,
                      middle_xz_m.y() + radii_m.y() * std::sin(angle));
  }
  return path;
}

/// An upright, open vessel with walls of one thickness.
TriangleMesh open_cup(double bottom_radius_m, double top_radius_m, double height_m, double wall_m) {
  return revolved({{0, 0},
                   {bottom_radius_m, 0},
                   {top_radius_m, height_m},
                   {top_radius_m - wall_m, height_m},
                   {bottom_radius_m - wall_m, 2 * wall_m},
                   {0, 2 * wall_m}});
}

void add_boxes(std::vector<ObjectModel>& models) {
  models.push_back(box_thing("book", {0.15, 0.03, 0.22}));
  models.push_back(box_thing("cereal_box", {0.19, 0.065, 0.3}));
  models.push_back(box_thing("phone", {0.075, 0.011, 0.155}));
  models.push_back(box_thing("tea_box", {0.145, 0.07, 0.085}));
  models.push_back(box_thing("tissue_box", {0.23, 0.12, 0.1}));
  // A square carton with its gable on top.
  double const half = 0.036;
  TriangleMesh const gable =
      prism({{-half, 0.195}, {half, 0.195}, {0.004, 0.235}, {-0.004, 0.235}}, -half, half);
  models.push_back({"milk_carton",
                    centred(joined({moved(block({2 * half, 2 * half, 0.196}), at(0, 0, 0.098)),
                                    moved(gable, at(0, 0, 0, {90, 0, 0}))})),
                    half_turns_about_z()});
}

void add_bottles(std::vector<ObjectModel>& models) {
  models.push_back(round_thing("wine_bottle", {{0, 0},
                                               {0.037, 0},
                                               {0.0375, 0.185},
                                               {0.033, 0.205},
                                               {0.0165, 0.23},
                                               {0.0145, 0.3},
                                               {0, 0.3}}));
  models.push_back(round_thing("water_bottle", {{0, 0},
                                                {0.031, 0},
                                                {0.0335, 0.01},
                                                {0.0335, 0.08},
                                                {0.028, 0.095},
                                                {0.0335, 0.11},
                                                {0.0335, 0.16},
                                                {0.014, 0.205},
                                                {0.0155, 0.225},
                                                {0, 0.225}}));
  models.push_back(round_thing(
      "can", {{0, 0}, {0.027, 0}, {0.033, 0.009}, {0.033, 0.106}, {0.027, 0.116}, {0, 0.116}}));
  // Its ends differ by a millimetre.
  models.back().symmetry.axis->both_ways = true;
  models.push_back(round_thing("jar", {{0, 0},
                                       {0.047, 0},
                                       {0.047, 0.1},
                                       {0.036, 0.112},
                                       {0.041, 0.113},
                                       {0.041, 0.135},
                                       {0, 0.135}}));
  models.push_back(round_thing("vase", {{0, 0},
                                        {0.045, 0},
                                        {0.068, 0.06},
                                        {0.072, 0.1},
                                        {0.055, 0.16},
                                        {0.03, 0.2},
                                        {0.045, 0.26},
                                        {0.041, 0.26},
                                        {0.026, 0.2},
                                        {0.05, 0.158},
                                        {0.066, 0.1},
                                        {0.04, 0.008},
                                        {0, 0.008}}));
}

void add_dishes(std::vector<ObjectModel>& models) {
  Outline bowl = {{0, 0}, {0.032, 0}};
  for (double const angle_deg : {20.0, 40.0, 60.0, 75.0, 90.0}) {
    double const angle = angle_deg * kPi / 180.0;
    bowl.emplace_back(0.032 + 0.05 * std::sin(angle), 0.068 * (1.0 - std::cos(angle)));
  }
  for (double const angle_deg : {90.0, 70.0, 45.0, 20.0}) {
    double const angle = angle_deg * kPi / 180.0;
    bowl.emplace_back(0.03 + 0.047 * std::sin(angle), 0.068 - 0.06 * std::cos(angle));
  }
  bowl.emplace_back(0, 0.0075);
  models.push_back(round_thing("bowl", bowl));
  models.push_back(round_thing("plate", {{0, 0},
                                         {0.07, 0},
                                         {0.082, 0.006},
                                         {0.125, 0.022},
                                         {0.125, 0.027},
                                         {0.08, 0.012},
                                         {0.068, 0.006},
                                         {0, 0.006}}));
  models.push_back({"cup", centred(open_cup(0.028, 0.042, 0.098, 0.0035)), {SymmetryAxis{}, {}}});
  models.push_back(round_thing("wine_glass", {{0, 0},
                                              {0.034, 0},
                                              {0.034, 0.003},
                                              {0.005, 0.009},
                                              {0.005, 0.085},
                                              {0.022, 0.1},
                                              {0.039, 0.135},
                                              {0.033, 0.195},
                                              {0.03, 0.195},
                                              {0.035, 0.135},
                                              {0.018, 0.104},
                                              {0, 0.1}}));
  models.push_back(round_thing("candlestick", {{0, 0},
                                               {0.055, 0},
                                               {0.055, 0.01},
                                               {0.02, 0.02},
                                               {0.012, 0.05},
                                               {0.022, 0.075},
                                               {0.012, 0.1},
                                               {0.012, 0.15},
                                               {0.03, 0.165},
                                               {0.03, 0.172},
                                               {0.011, 0.173},
                                               {0.011, 0.24},
                                               {0, 0.24}}));
}

void add_handled(std::vector<ObjectModel>& models) {
  models.push_back(odd_thing("mug", {open_cup(0.042, 0.042, 0.095, 0.004),
                                     bar(arc({0.039, 0.048}, {0.032, 0.03}, -90, 90), 0.0055)}));
  TriangleMesh const pot = revolved({{0, 0},
                                     {0.05, 0},
                                     {0.075, 0.03},
                                     {0.078, 0.06},
                                     {0.06, 0.1},
                                     {0.035, 0.112},
                                     {0.012, 0.118},
                                     {0.014, 0.135},
                                     {0, 0.138}});
  models.push_back(odd_thing(
      "teapot",
      {pot, bar(arc({-0.07, 0.064}, {0.045, 0.036}, 60, 300), 0.006),
       bar({{0.07, 0, 0.045}, {0.1, 0, 0.06}, {0.115, 0, 0.085}, {0.13, 0, 0.11}}, 0.011)}));
  TriangleMesh const boiler =
      revolved({{0, 0}, {0.085, 0}, {0.085, 0.03}, {0.06, 0.2}, {0.02, 0.215}, {0, 0.215}});
  models.push_back(
      odd_thing("kettle", {boiler,
                           bar({{-0.058, 0, 0.19},
                                {-0.11, 0, 0.205},
                                {-0.13, 0, 0.18},
                                {-0.13, 0, 0.09},
                                {-0.118, 0, 0.06}},
                               0.012),
                           moved(prism({{-0.02, -0.025}, {0.04, 0}, {-0.02, 0.025}}, -0.025, 0.025),
                                 at(0.072, 0, 0.17))}));
  models.push_back(odd_thing("jug", {revolved({{0, 0},
                                               {0.05, 0},
                                               {0.062, 0.06},
                                               {0.045, 0.16},
                                               {0.056, 0.22},
                                               {0.052, 0.22},
                                               {0.041, 0.16},
                                               {0.058, 0.06},
                                               {0.046, 0.008},
                                               {0, 0.008}}),
                                     bar(arc({-0.057, 0.13}, {0.06, 0.07}, 85, 270), 0.008)}));
  models.push_back(odd_thing(
      "watering_can",
      {revolved({{0, 0}, {0.065, 0}, {0.055, 0.13}, {0.03, 0.13}, {0.028, 0.01}, {0, 0.01}}),
       bar({{0.06, 0, 0.03}, {0.11, 0, 0.08}, {0.18, 0, 0.155}}, 0.011),
       moved(revolved({{0, 0}, {0.012, 0}, {0.026, 0.025}, {0, 0.025}}),
             at(0.172, 0, 0.147, {0, 45, 0})),
       bar(arc({-0.05, 0.075}, {0.055, 0.045}, 80, 260), 0.007)}));
  models.push_back(
      odd_thing("frying_pan", {open_cup(0.075, 0.09, 0.04, 0.004),
                               bar({{0.084, 0, 0.03}, {0.13, 0, 0.042}, {0.25, 0, 0.055}}, 0.01)}));
}

void add_tools(std::vector<ObjectModel>& models) {
  // The head across the handle: a face on one side, a bent wedge on the other.
  models.push_back(odd_thing(
      "hammer", {bar({{0, 0, 0}, {0, 0, 0.14}, {0, 0, 0.275}}, 0.013),
                 moved(block({0.07, 0.028, 0.028}), at(0.022, 0, 0.285)),
                 moved(revolved({{0, 0}, {0.018, 0}, {0.018, 0.02}, {0, 0.02}}),
                       at(0.055, 0, 0.285, {0, 90, 0})),
                 moved(prism({{-0.07, -0.036}, {-0.01, -0.012}, {-0.01, 0.013}, {-0.045, 0.002}},
                             -0.013, 0.013),
                       at(0, 0, 0.285, {90, 0, 0}))}));
  models.push_back(round_thing("screwdriver", {{0, 0},
                                               {0.012, 0.001},
                                               {0.017, 0.02},
                                               {0.015, 0.08},
                                               {0.011, 0.1},
                                               {0.004, 0.105},
                                               {0.0035, 0.23},
                                               {0, 0.235}}));
  models.push_back(odd_thing(
      "spatula", {bar({{0, 0, 0}, {0, 0, 0.12}, {0.005, 0, 0.19}, {0.03, 0, 0.24}}, 0.009),
                  moved(block({0.085, 0.007, 0.1}), at(0.045, 0, 0.28, {0, 0, 90}))}));
  // A sole that comes to a point, a body above it, a handle over that.
  models.push_back(odd_thing(
      "iron",
      {prism({{-0.12, -0.055},
              {0.02, -0.055},
              {0.08, -0.04},
              {0.13, 0},
              {0.08, 0.04},
              {0.02, 0.055},
              {-0.12, 0.055}},
             0, 0.025),
       prism({{-0.1, -0.04}, {0.02, -0.04}, {0.085, 0}, {0.02, 0.04}, {-0.1, 0.04}}, 0.024, 0.06),
       bar({{-0.085, 0, 0.055},
            {-0.095, 0, 0.1},
            {-0.06, 0, 0.125},
            {0.02, 0, 0.118},
            {0.05, 0, 0.055}},
           0.014)}));
  std::vector<TriangleMesh> truck = {moved(block({0.07, 0.085, 0.1}), at(0.07, 0, 0.075)),
                                     moved(block({0.152, 0.09, 0.06}), at(-0.04, 0, 0.055))};
  for (double const x : {0.065, -0.075}) {
    for (double const side : {-0.05, 0.03}) {
      truck.push_back(moved(revolved({{0, 0}, {0.026, 0}, {0.026, 0.02}, {0, 0.02}}),
                            at(x, side + 0.02, 0.026, {90, 0, 0})));
    }
  }
  models.push_back(odd_thing("toy_truck", truck));
}

}  // namespace

std::vector<ObjectModel> household_models() {
  std::vector<ObjectModel> models;
  add_boxes(models);
  add_bottles(models);
  add_dishes(models);
  add_handled(models);
  add_tools(models);
  std::ranges::sort(models, {}, &ObjectModel::name);
  return models;
}

}  // namespace credo
