#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "detector/models/search_model.hpp"

namespace credo {

/// How two oriented points lie to each other, whatever the frame (Drost, Ulrich, Navab and Ilic,
/// CVPR 2010, equation 1), cut into steps.
class PairFeature {
public:
  static constexpr int kAngleSteps = 15;

  /// Where the pair lies on its axes: distance in steps, then angles in steps: of each normal to
  /// the line between the points, and between the normals.
  [[nodiscard]] static Eigen::Vector4f of(Eigen::Vector3f const& from_point,
                                          Eigen::Vector3f const& from_normal,
                                          Eigen::Vector3f const& to_point,
                                          Eigen::Vector3f const& to_normal, float step_m);
};

/// The turn about a point's normal at which another point lies, in [-pi, pi): `frame` takes the
/// point to the origin and its normal to x.
struct NormalFrame {
  NormalFrame(Eigen::Vector3f const& point, Eigen::Vector3f const& normal);
  [[nodiscard]] float turn_of(Eigen::Vector3f const& other) const;

  Eigen::Matrix3f rotation;
  Eigen::Vector3f translation_m;
};

/// All pairs of a model's points that one view shows together, by their feature.
class PairTable {
public:
  struct Entry {
    /// Position in `references`.
    std::uint16_t reference;
    /// Turn of the other point about the reference's normal, 65536 to a full turn.
    std::uint16_t turn;
  };

  PairTable() = default;
  explicit PairTable(SearchModel const& model);

  /// Positions of the model's points that pairs begin and end with.
  [[nodiscard]] std::vector<std::uint16_t> const& references() const { return references_; }
  [[nodiscard]] float step_m() const { return step_m_; }
  /// Entries whose feature is within about a step of this one; none for a longer pair than any.
  [[nodiscard]] std::span<Entry const> like(Eigen::Vector4f const& feature) const;
  [[nodiscard]] std::size_t size() const { return entries_.size(); }

  /// Calls with every list and every number that a table is made of, for archives.
  template <typename Table, typename List, typename Value>
  static void tell(Table& table, List const& list, Value const& value) {
    list(table.references_);
    value(table.step_m_);
    value(table.distance_steps_);
    list(table.begins_);
    list(table.entries_);
  }

private:
  [[nodiscard]] std::size_t cell(std::array<int, 4> const& steps) const;

  std::vector<std::uint16_t> references_;
  float step_m_ = 0.0F;
  int distance_steps_ = 0;
  /// Where the entries of each cell begin, and the end of the last.
  std::vector<std::uint32_t> begins_;
  std::vector<Entry> entries_;
};

}  // namespace credo
