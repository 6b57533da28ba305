// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/output.hpp"

#include <filesystem>
#include <iostream>
#include <utility>

namespace grseg {
namespace {

/// A device or a pipe: it is written to, never replaced.
bool is_device(const std::string& path)
{
  std::error_code error;
  return std::filesystem::is_other(std::filesystem::status(path, error));
}

}  // namespace

Output::Output(std::string path, bool overwrite)
    : path_(std::move(path)), temporary_(temporary_path(path_))
{
  refuse_to_overwrite(path_, overwrite);
}

void write_whole(const std::string& path, std::string_view text)
{
  if (path.empty() || path == "-") {
    std::cout << text;
    return;
  }
  if (is_device(path)) return write_file(path, text, path);
  const RemoveAtEnd temporary(temporary_path(path));
  write_file(temporary.path(), text, path);
  publish_file(temporary.path(), path);
}

}  // namespace grseg
