// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/errors.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// Functions that fuzz targets share. A target reads bytes as a tool would: they are accepted, or
/// refused with a ToolError. Anything else is a finding: another exception, a sanitizer's report, a
/// violated condition, too much time or memory.
namespace grseg::fuzz {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size)
{
  return {reinterpret_cast<const char*>(data), size};
}

/// Calls `read`, which may throw a ToolError.
template <class Read>
void try_to(const Read& read)
{
  try {
    read();
  } catch (const ToolError&) {
  }
}

/// Ends the process, as a finding, unless the condition `holds` is true.
void require(bool holds, const char* promise);

/// Parts of one input that represents several files; lines "=====" separate the parts.
std::vector<std::string_view> parts_of(std::string_view text);

/// A file in memory, in a folder of this process, that is written again for each input.
class ScratchFile {
 public:
  explicit ScratchFile(const std::string& name);
  ~ScratchFile();
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  void write(std::string_view bytes);
  const std::string& path() const { return path_; }

 private:
  std::string folder_, path_;
  int file_ = -1;
};

}  // namespace grseg::fuzz
