#include "detector/models/model_archive.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace credo {
namespace {

/// Types whose bytes are their value, without gaps.
template <typename T>
constexpr bool kIsPlain = std::is_arithmetic_v<T> || std::is_same_v<T, Eigen::Vector3f> ||
                          std::is_same_v<T, std::array<std::uint32_t, 3>> ||
                          std::is_same_v<T, OutlinePair> || std::is_same_v<T, PairTable::Entry>;
static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float));
static_assert(sizeof(OutlinePair) == 7 * sizeof(float));
static_assert(sizeof(PairTable::Entry) == 2 * sizeof(std::uint16_t));

class Writer {
public:
  template <typename T>
  void value(T const& value) {
    static_assert(kIsPlain<T>);
    put(&value, 1);
  }
  template <typename T>
  void list(std::vector<T> const& values) {
    value(values.size());
    put(values.data(), values.size());
  }
  /// A list whose elements are written one by one.
  template <typename T, typename Each>
  void each(std::vector<T> const& values, Each const& write) {
    value(values.size());
    for (T const& value : values) {
      write(*this, value);
    }
  }
  std::vector<unsigned char> take() { return std::move(bytes_); }

private:
  template <typename T>
  void put(T const* values, std::size_t count) {
    auto const* bytes = reinterpret_cast<unsigned char const*>(values);
    bytes_.insert(bytes_.end(), bytes, bytes + count * sizeof(T));
  }

  std::vector<unsigned char> bytes_;
};

class Reader {
public:
  explicit Reader(std::span<unsigned char const> bytes) : left_(bytes) {}

  template <typename T>
  void value(T& value) {
    static_assert(kIsPlain<T>);
    get(&value, 1);
  }
  template <typename T>
  void list(std::vector<T>& values) {
    if (std::size_t const count = counted(sizeof(T)); count > 0) {
      values.resize(count);
      get(values.data(), count);
    }
  }
  template <typename T, typename Each>
  void each(std::vector<T>& values, Each const& read) {
    values.resize(counted(1));
    for (T& value : values) {
      read(*this, value);
    }
  }
  [[nodiscard]] bool came_out_even() const { return !failed_ && left_.empty(); }

private:
  /// How many elements a list has; 0 where the bytes cannot hold them.
  std::size_t counted(std::size_t least_bytes) {
    std::size_t count = 0;
    value(count);
    if (count > left_.size() / least_bytes) {
      failed_ = true;
    }
    return failed_ ? 0 : count;
  }
  template <typename T>
  void get(T* values, std::size_t count) {
    std::size_t const size = count * sizeof(T);
    if (failed_ || size > left_.size()) {
      failed_ = true;
      return;
    }
    std::memcpy(reinterpret_cast<unsigned char*>(values), left_.data(), size);
    left_ = left_.subspan(size);
  }

  std::span<unsigned char const> left_;
  bool failed_ = false;
};

// Each tells the members in turn, to be written or read.

constexpr auto kFacet = [](auto& archive, auto& facet) {
  archive.value(facet.normal);
  archive.value(facet.centre_m);
  archive.value(facet.along);
  archive.value(facet.half_length_m);
  archive.value(facet.half_width_m);
  archive.value(facet.points);
  archive.value(facet.segment);
};

constexpr auto kView = [](auto& archive, auto& view) {
  archive.value(view.to_camera_model);
  archive.list(view.visible);
  archive.value(view.area_m2);
  archive.list(view.outline);
};

template <typename Archive, typename Model>
void all_of(Archive& archive, Model& prepared) {
  auto& model = prepared.model;
  archive.value(model.one_sided);
  archive.value(model.centre_model);
  archive.value(model.radius_m);
  archive.value(model.diameter_m);
  archive.value(model.surface_m2);
  archive.list(model.points_model);
  archive.list(model.normals_model);
  archive.value(model.spacing_m);
  archive.each(model.facets, kFacet);
  archive.list(model.vertices_model);
  archive.list(model.triangles);
  archive.each(model.views, kView);
  PairTable::tell(
      prepared.pairs, [&](auto& list) { archive.list(list); },
      [&](auto& value) { archive.value(value); });
}

}  // namespace

std::vector<unsigned char> archived(PreparedModel const& model) {
  Writer writer;
  all_of(writer, model);
  return writer.take();
}

std::optional<PreparedModel> unarchived(std::span<unsigned char const> bytes) {
  Reader reader(bytes);
  PreparedModel model;
  all_of(reader, model);
  return reader.came_out_even() ? std::optional(std::move(model)) : std::nullopt;
}

}  // namespace credo
