#include "openni/oni_codec.hpp"

namespace credo {
namespace {

constexpr unsigned kSmallZero = 6;
constexpr unsigned kFiller = 13;
constexpr unsigned kRepeat = 14;
constexpr unsigned kNextByte = 15;

std::uint16_t little_endian(std::span<unsigned char const> bytes, std::size_t at) {
  return static_cast<std::uint16_t>(bytes[at] | bytes[at + 1] << 8);
}

/// Reads packed values into a list that takes no more than `count`.
class Unpacker {
public:
  Unpacker(std::span<unsigned char const> packed, std::size_t count)
      : packed_(packed), count_(count) {
    values_.reserve(count);
  }

  std::optional<std::vector<std::uint16_t>> values() {
    if (packed_.size() < 2) {
      return std::nullopt;
    }
    last_ = little_endian(packed_, 0);
    position_ = 2;
    append();
    while (good_ && position_ < packed_.size()) {
      read_byte();
    }
    return good_ && values_.size() == count_ ? std::optional(std::move(values_)) : std::nullopt;
  }

private:
  void read_byte() {
    unsigned const high = packed_[position_] >> 4;
    unsigned const low = packed_[position_] & 0x0F;
    ++position_;
    if (high == kRepeat) {
      for (unsigned i = 0; i < 2 * low; ++i) {
        append();
      }
    } else if (high == kNextByte) {
      read_large();
    } else {
      read_small(high);
      if (low == kNextByte) {
        read_large();
      } else {
        read_small(low);
      }
    }
  }

  void read_small(unsigned half) {
    if (half < kFiller) {
      last_ = static_cast<std::uint16_t>(last_ + kSmallZero - half);
      append();
    } else {
      good_ = good_ && half == kFiller;
    }
  }

  void read_large() {
    if (position_ < packed_.size() && (packed_[position_] & 0x80) != 0) {
      last_ = static_cast<std::uint16_t>(last_ + 192 - packed_[position_]);
      position_ += 1;
    } else if (position_ + 1 < packed_.size()) {
      last_ = static_cast<std::uint16_t>(packed_[position_] << 8 | packed_[position_ + 1]);
      position_ += 2;
    } else {
      good_ = false;
      return;
    }
    append();
  }

  void append() {
    good_ = good_ && values_.size() < count_;
    if (good_) {
      values_.push_back(last_);
    }
  }

  std::span<unsigned char const> packed_;
  std::size_t count_;
  std::vector<std::uint16_t> values_;
  std::size_t position_ = 0;
  std::uint16_t last_ = 0;
  bool good_ = true;
};

}  // namespace

std::optional<std::vector<std::uint16_t>> unpack_16z(std::span<unsigned char const> packed,
                                                     std::size_t count) {
  return Unpacker(packed, count).values();
}

std::optional<std::vector<std::uint16_t>> unpack_16z_with_table(
    std::span<unsigned char const> packed, std::size_t count) {
  if (packed.size() < 2) {
    return std::nullopt;
  }
  std::size_t const length = little_endian(packed, 0);
  std::size_t const table_bytes = 2 + 2 * length;
  if (packed.size() < table_bytes) {
    return std::nullopt;
  }
  auto values = unpack_16z(packed.subspan(table_bytes), count);
  if (!values) {
    return std::nullopt;
  }
  for (std::uint16_t& value : *values) {
    if (value >= length) {
      return std::nullopt;
    }
    value = little_endian(packed, 2 + 2 * std::size_t{value});
  }
  return values;
}

}  // namespace credo
