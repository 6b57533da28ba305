// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

/// Functions that read exported files.
namespace grseg {

namespace fs = std::filesystem;

inline std::string content(const fs::path& path)
{
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline std::vector<std::string> lines_of(const std::string& text)
{
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// The array `name` of a .vtp file, found by its offset after the underscore.
template <class Number>
std::vector<Number> array_in(const std::string& vtp, const std::string& name)
{
  const auto at = vtp.find("offset=\"", vtp.find("Name=\"" + name + "\"")) + 8;
  const auto begin = vtp.find("\n_") + 2 + std::stoul(vtp.substr(at));
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, vtp.data() + begin, sizeof bytes);
  std::vector<Number> values(bytes / sizeof(Number));
  std::memcpy(values.data(), vtp.data() + begin + sizeof bytes, bytes);
  return values;
}

}  // namespace grseg
