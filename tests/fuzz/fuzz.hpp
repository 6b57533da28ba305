// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/errors.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// What fuzz targets share. A target reads bytes as a tool would: they are accepted, or refused with
/// a ToolError. Anything else (another exception, a sanitizer's report, a broken promise, more than
/// the limits of time and memory) is a finding.
namespace grseg::fuzz {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size)
{
  return {reinterpret_cast<const char*>(data), size};
}

/// Calls `read`, which may refuse.
template <class Read>
void try_to(const Read& read)
{
  try {
    read();
  } catch (const ToolError&) {
  }
}

/// Ends the process, as a finding, unless a promise holds.
void require(bool holds, const char* promise);

/// One input that stands for several files: what lies between lines "=====".
std::vector<std::string_view> parts_of(std::string_view text);

/// A file in memory that is written again for each input.
class ScratchFile {
 public:
  explicit ScratchFile(const std::string& name);
  ~ScratchFile();
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  void write(std::string_view bytes);
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  int file_ = -1;
};

}  // namespace grseg::fuzz
