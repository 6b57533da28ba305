// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/explore/binary_arrays.hpp"

#include <libdeflate.h>

#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

/// The arrays that a page finds, decoded like in its JavaScript but by independent code.
namespace grseg::unpacked {

inline std::vector<unsigned char> from_base64(const std::string& text)
{
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<unsigned char> bytes;
  unsigned value = 0, bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    value = value << 6 | static_cast<unsigned>(letters.find(c));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes.push_back(static_cast<unsigned char>(value >> bits & 255));
  }
  return bytes;
}

inline std::vector<unsigned char> bytes_of(const BinaryArrays& arrays)
{
  const auto packed = from_base64(arrays.base64());
  std::vector<unsigned char> bytes(1 << 22);
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> tool(
      libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  std::size_t size = 0;
  if (libdeflate_zlib_decompress(tool.get(), packed.data(), packed.size(), bytes.data(),
                                 bytes.size(), &size) != LIBDEFLATE_SUCCESS)
    throw std::runtime_error("not a zlib stream");
  bytes.resize(size);
  return bytes;
}

/// Array with this name; `type` is the type that the directory must state.
template <class Number>
std::vector<Number> array(const BinaryArrays& arrays, const std::string& name,
                          const std::string& type)
{
  const auto& entry = arrays.directory().at(name);
  if (entry.at("type") != type) throw std::runtime_error("of another type");
  const auto bytes = bytes_of(arrays);
  std::vector<Number> values(entry.at("length").get<std::size_t>());
  const auto offset = entry.at("offset").get<std::size_t>();
  for (std::size_t k = 0; k < values.size(); ++k) {
    unsigned char own[sizeof(Number)];
    for (std::size_t b = 0; b < sizeof(Number); ++b) own[b] = bytes[offset + b * values.size() + k];
    std::memcpy(&values[k], own, sizeof(Number));
  }
  return values;
}

}  // namespace grseg::unpacked
