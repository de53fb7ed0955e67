#include "openni/oni_records.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <map>
#include <span>
#include <string_view>
#include <utility>

#include "core/error.hpp"

namespace credo {
namespace {

namespace fs = std::filesystem;

// The file: a header, then records. A record: header (magic, type, node, bytes of header and
// fields, bytes of payload, position of a record that it undoes), fields, payload. Little endian
// throughout.
constexpr std::string_view kFileMagic = "NI10";
constexpr std::uint64_t kFileHeaderBytes = 24;
constexpr std::uint32_t kRecordMagic = 0x0052494E;  // "NIR"
constexpr std::uint32_t kRecordHeaderBytes = 28;
// Damage shows as sizes that no recorder writes.
constexpr std::uint32_t kMaxFieldsBytes = 1U << 20;
constexpr std::uint32_t kMaxPayloadBytes = 1U << 26;
constexpr std::uint64_t kLeastImageBytes = kRecordHeaderBytes + 12;
constexpr std::uint32_t kMaxImages = 1U << 30;

enum Type : std::uint32_t {
  kNodeAddedOldest = 0x02,
  kIntProperty = 0x03,
  kRealProperty = 0x04,
  kGeneralProperty = 0x06,
  kNewData = 0x0A,
  kEnd = 0x0B,
  kNodeAddedOld = 0x0C,
  kNodeAdded = 0x0D,
  kLastType = 0x0E,
};
constexpr std::uint32_t kDepthNode = 2;
constexpr std::uint32_t kImageNode = 3;

struct Record {
  std::uint64_t offset = 0;
  std::uint32_t type = 0;
  std::uint32_t node = 0;
  std::uint32_t fields_bytes = 0;
  std::uint32_t payload_bytes = 0;

  [[nodiscard]] std::uint64_t payload() const { return offset + fields_bytes; }
  [[nodiscard]] std::uint64_t end() const { return payload() + payload_bytes; }
};

/// Takes numbers and texts off the front; `good` turns false where there are too few bytes.
class Fields {
public:
  explicit Fields(std::span<unsigned char const> bytes) : bytes_(bytes) {}

  template <typename T>
  T number() {
    T value{};
    if (auto const taken = take(sizeof(T)); good_) {
      std::memcpy(&value, taken.data(), sizeof(T));
    }
    return value;
  }
  std::string text() {
    auto const taken = take(number<std::uint32_t>());
    std::string text(taken.begin(), taken.end());
    return text.substr(0, text.find('\0'));
  }
  [[nodiscard]] bool good() const { return good_; }

private:
  std::span<unsigned char const> take(std::size_t count) {
    good_ = good_ && count <= bytes_.size();
    if (!good_) {
      return {};
    }
    auto const taken = bytes_.first(count);
    bytes_ = bytes_.subspan(count);
    return taken;
  }

  std::span<unsigned char const> bytes_;
  bool good_ = true;
};

class OniFile {
public:
  explicit OniFile(fs::path const& path) {
    // A pipe would let us wait for ever.
    if (!fs::is_regular_file(path)) {
      throw InputError(path.string() + ": " +
                       (fs::exists(path) ? "is no file" : "no such recording"));
    }
    file_.open(path, std::ios::binary);
    size_ = fs::file_size(path);
    std::array<char, kFileHeaderBytes> header{};
    if (!file_) {
      throw InputError(path.string() + ": cannot be opened: may it be read?");
    }
    if (size_ == 0) {
      throw InputError(path.string() + ": is empty");
    }
    file_.read(header.data(), header.size());
    if (std::string_view(header.data(), kFileMagic.size()) != kFileMagic) {
      throw InputError(path.string() + ": is no ONI recording: it does not begin with NI10");
    }
  }

  [[nodiscard]] std::uint64_t size() const { return size_; }

  /// Up to so many bytes from there.
  std::span<unsigned char const> read(std::uint64_t offset, std::size_t count) {
    buffer_.resize(count);
    file_.clear();
    file_.seekg(static_cast<std::streamoff>(offset));
    file_.read(reinterpret_cast<char*>(buffer_.data()), static_cast<std::streamsize>(count));
    return {buffer_.data(), static_cast<std::size_t>(file_.gcount())};
  }

  /// The record that begins there; none where no recorder would write such. It may end beyond the
  /// file.
  std::optional<Record> record(std::uint64_t offset) {
    Fields header(read(offset, kRecordHeaderBytes));
    auto const magic = header.number<std::uint32_t>();
    Record record{offset, header.number<std::uint32_t>(), header.number<std::uint32_t>(),
                  header.number<std::uint32_t>(), header.number<std::uint32_t>()};
    header.number<std::uint64_t>();
    bool const right =
        header.good() && magic == kRecordMagic && record.type > 0 && record.type <= kLastType &&
        record.fields_bytes >= kRecordHeaderBytes && record.fields_bytes <= kMaxFieldsBytes &&
        record.payload_bytes <= kMaxPayloadBytes &&
        (record.type != kEnd || record.fields_bytes + record.payload_bytes == kRecordHeaderBytes);
    return right ? std::optional(record) : std::nullopt;
  }

  /// Whether another record begins where this one ends, or none is due.
  bool followed(Record const& one) {
    return one.end() == size_ || (one.end() < size_ && (one.type == kEnd || record(one.end())));
  }

  /// The next record from `offset` on that is whole and is followed by another or by nothing.
  std::optional<Record> next_whole(std::uint64_t offset) {
    constexpr std::size_t kBlock = 1 << 16;
    for (std::uint64_t at = offset; at + kRecordHeaderBytes <= size_; at += kBlock) {
      // Overlapping: a magic may lie across the border.
      auto const read_bytes = read(at, kBlock + 3);
      std::string const block(read_bytes.begin(), read_bytes.end());
      for (std::size_t found = block.find("NIR"); found != std::string::npos && found < kBlock;
           found = block.find("NIR", found + 1)) {
        std::optional<Record> const candidate = record(at + found);
        if (candidate && followed(*candidate)) {
          return candidate;
        }
      }
    }
    return std::nullopt;
  }

private:
  std::ifstream file_;
  std::uint64_t size_ = 0;
  std::vector<unsigned char> buffer_;
};

/// Walks the records of a file, and makes the index of them.
class Indexer {
public:
  explicit Indexer(fs::path const& path) : file_(path), path_(path) {}

  OniIndex index() {
    std::uint64_t at = kFileHeaderBytes;
    bool ended = false;
    while (!ended) {
      std::optional<Record> record = file_.record(at);
      if (at + kRecordHeaderBytes > file_.size()) {
        break;
      }
      if (!record || !file_.followed(*record)) {
        std::optional<Record> const next = file_.next_whole(at + 1);
        bool const within = next && (!record || next->offset < record->end());
        if (within) {
          // Damaged: what is whole begins before it ends.
          skipped(at, next->offset);
          record = next;
        } else if (!record) {
          skipped(at, file_.size());
          break;
        } else if (record->end() > file_.size()) {
          cut_off(*record);
          break;
        }
        // Else it is whole, and the one after it is not.
      }
      ended = record->type == kEnd;
      enter(*record);
      at = record->end();
    }
    end_bytes_ = ended ? at : 0;
    if (!ended) {
      warnings_.insert(warnings_.begin(),
                       path_.string() + ": cut short: it does not say where it ends");
    }
    return result();
  }

private:
  struct Node {
    std::uint32_t type = 0;
    /// As the recorder counted them; 0 where it was killed before it did.
    std::uint32_t promised_images = 0;
    OniStream stream;
    /// Bytes passed over since its last image.
    std::uint64_t skipped_bytes = 0;
  };

  void enter(Record const& record) {
    Fields fields(
        file_.read(record.offset + kRecordHeaderBytes, record.fields_bytes - kRecordHeaderBytes));
    switch (record.type) {
      case kNodeAdded:
      case kNodeAddedOld:
      case kNodeAddedOldest:
        add_node(record.node, fields);
        break;
      case kIntProperty:
      case kGeneralProperty:
        set_property(nodes_[record.node].stream, fields);
        break;
      case kNewData:
        add_image(nodes_[record.node], record, fields);
        break;
      default:
        break;
    }
  }

  void add_node(std::uint32_t id, Fields& fields) {
    fields.text();
    Node& node = nodes_[id];
    node.type = fields.number<std::uint32_t>();
    auto const codec = fields.number<std::array<char, 4>>();
    node.stream.codec.assign(codec.begin(), codec.end());
    node.promised_images = fields.number<std::uint32_t>();
  }

  static void set_property(OniStream& stream, Fields& fields) {
    std::string const name = fields.text();
    fields.number<std::uint32_t>();  // bytes of the value
    if (name == "Mirror" || name == "xnMirror") {
      stream.mirrored = fields.number<std::uint64_t>() != 0;
    } else if (name == "xnPixelFormat") {
      stream.pixel_format = fields.number<std::uint64_t>();
    } else if (name == "xnMapOutputMode") {
      stream.width = static_cast<int>(fields.number<std::uint32_t>());
      stream.height = static_cast<int>(fields.number<std::uint32_t>());
    } else if (name == "xnFOV") {
      stream.horizontal_fov_rad = fields.number<double>();
      stream.vertical_fov_rad = fields.number<double>();
    }
  }

  static void add_image(Node& node, Record const& record, Fields& fields) {
    auto const stamp_us = fields.number<std::uint64_t>();
    auto const number = fields.number<std::uint32_t>();
    constexpr std::uint64_t kMaxStampUs = 9'000'000'000'000'000;
    if (!fields.good() || stamp_us > kMaxStampUs) {
      node.skipped_bytes += record.end() - record.offset;
      return;
    }
    std::vector<OniImage>& images = node.stream.images;
    std::uint32_t const last = images.empty() ? number - 1 : images.back().number;
    // No more are missing than had room in what was passed over: a number may be damaged itself.
    if (number > last && number - last - 1 <= node.skipped_bytes / kLeastImageBytes) {
      for (std::uint32_t lost = last + 1; lost < number; ++lost) {
        images.push_back({.number = lost, .lost = true});
      }
    }
    node.skipped_bytes = 0;
    images.push_back({record.payload(), record.payload_bytes,
                      static_cast<std::int64_t>(stamp_us) * 1000, number, false});
  }

  void cut_off(Record const& record) {
    if (record.type == kNewData) {
      Node& node = nodes_[record.node];
      auto const& images = node.stream.images;
      node.stream.images.push_back(
          {.number = images.empty() ? 1 : images.back().number + 1, .lost = true});
    }
  }

  void skipped(std::uint64_t from, std::uint64_t to) {
    if (from == to) {
      return;
    }
    warnings_.push_back(path_.string() + ": damaged at byte " + std::to_string(from) + ": " +
                        std::to_string(to - from) + " bytes passed over");
    for (auto& [id, node] : nodes_) {
      node.skipped_bytes += to - from;
    }
  }

  OniIndex result() {
    OniIndex index{{}, std::nullopt, end_bytes_, std::move(warnings_)};
    bool has_depth = false;
    for (auto& [id, node] : nodes_) {
      if (node.type != kDepthNode && node.type != kImageNode) {
        continue;
      }
      bool const depth = node.type == kDepthNode;
      tell_missing(node, depth ? "depth" : "colour", index.warnings);
      if (depth && !has_depth) {
        index.depth = std::move(node.stream);
        has_depth = true;
      } else if (!depth && !index.color) {
        index.color = std::move(node.stream);
      }
    }
    check_depth(index, has_depth);
    return index;
  }

  void tell_missing(Node const& node, char const* what, std::vector<std::string>& warnings) const {
    auto const whole = static_cast<std::size_t>(std::ranges::count_if(
        node.stream.images, [](OniImage const& image) { return !image.lost; }));
    // Recorders that were killed leave no count, or one that is none.
    bool const plausible = node.promised_images <= kMaxImages;
    std::size_t const all =
        std::max<std::size_t>(plausible ? node.promised_images : 0, node.stream.images.size());
    if (whole < all) {
      warnings.push_back(path_.string() + ": holds " + std::to_string(whole) + " whole " + what +
                         " images of " + std::to_string(all));
    }
  }

  void check_depth(OniIndex const& index, bool has_depth) const {
    std::string const why = index.warnings.empty() ? "" : " (" + index.warnings.front() + ")";
    if (!has_depth || index.depth.images.empty()) {
      throw InputError(path_.string() + ": has no depth" + why);
    }
    constexpr int kMaxSide_px = 16384;
    if (index.depth.width <= 0 || index.depth.height <= 0 || index.depth.width > kMaxSide_px ||
        index.depth.height > kMaxSide_px) {
      throw InputError(path_.string() + ": does not say how large its depth images are" + why);
    }
  }

  OniFile file_;
  fs::path path_;
  std::map<std::uint32_t, Node> nodes_;
  std::uint64_t end_bytes_ = 0;
  std::vector<std::string> warnings_;
};

}  // namespace

OniIndex index_oni(fs::path const& path) {
  return Indexer(path).index();
}

}  // namespace credo
