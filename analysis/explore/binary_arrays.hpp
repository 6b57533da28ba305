// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace grseg {

/// Arrays of numbers for a page, which finds them by name. All their bytes become one zlib stream in
/// base64, which a browser unpacks by itself. The lowest bytes of an array's numbers come first, then the
/// next ones, and so on: so they compress better.
class BinaryArrays {
 public:
  void add(const std::string& name, const std::vector<std::uint8_t>& values);
  void add(const std::string& name, const std::vector<std::int8_t>& values);
  void add(const std::string& name, const std::vector<std::uint16_t>& values);
  void add(const std::string& name, const std::vector<std::uint32_t>& values);
  void add(const std::string& name, const std::vector<float>& values);
  void add(const std::string& name, const std::vector<double>& values);

  /// {"x": {"type": "u16", "offset": 0, "length": 12}, ...}: offset in bytes, length in numbers.
  const nlohmann::ordered_json& directory() const { return directory_; }
  /// RunError where the memory does not suffice.
  std::string base64() const;

 private:
  template <class Number>
  void append(const std::string& name, const char* type, const std::vector<Number>& values);

  nlohmann::ordered_json directory_ = nlohmann::ordered_json::object();
  std::vector<std::uint8_t> bytes_;
};

}  // namespace grseg
