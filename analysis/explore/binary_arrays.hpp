// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace grseg {

/// Named arrays of numbers for a page. All arrays together form one zlib stream in base64, which a
/// browser can unpack. Each array starts with the lowest byte of every number, then follow the second
/// bytes of all numbers, and so on: this order compresses better.
class BinaryArrays {
 public:
  /// Adds an array of unsigned numbers of 8, 16 or 32 bits, of floats or of doubles.
  template <class Number>
  void add(const std::string& name, const std::vector<Number>& values)
  {
    static_assert(std::is_floating_point_v<Number> || std::is_unsigned_v<Number>);
    add(name, std::is_floating_point_v<Number> ? 'f' : 'u', sizeof(Number), values.data(),
        values.size());
  }

  /// {"x": {"type": "u16", "offset": 0, "length": 12}, ...}: `offset` counts bytes, `length` numbers.
  const nlohmann::ordered_json& directory() const { return directory_; }
  /// The compressed arrays as base64 text. Throws RunError if memory runs out.
  std::string base64() const;

 private:
  void add(const std::string& name, char kind, std::size_t size, const void* numbers,
           std::size_t count);

  nlohmann::ordered_json directory_ = nlohmann::ordered_json::object();
  std::vector<std::uint8_t> bytes_;
};

}  // namespace grseg
