#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace credo {

/// Depth counts as OpenNI's recorders pack them ("16z"): a first value of two bytes, then from byte
/// to byte, high half before low,
///   0..12   the value before, plus 6 - n
///   13      nothing (fills up a byte)
///   14      as a high half: the value before, twice as often as the low half says
///   15      what follows starts at the next byte: 1bbbbbbb the value before plus 64 - b, else the
///           value itself, two bytes, high one first
/// None where that does not come out at exactly `count` values: the bytes are damaged. They carry
/// no checksum, so damage that keeps the count is not noticed.
std::optional<std::vector<std::uint16_t>> unpack_16z(std::span<unsigned char const> packed,
                                                     std::size_t count);

/// The same for numbers of a table that comes first ("16zT"): its length and its values, of two
/// bytes each. None also where a number is beyond the table.
std::optional<std::vector<std::uint16_t>> unpack_16z_with_table(
    std::span<unsigned char const> packed, std::size_t count);

}  // namespace credo
