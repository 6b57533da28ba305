// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/output.hpp"

#include "formats/core/errors.hpp"
#include "formats/core/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <utility>

namespace grseg {

std::string name_beside(const std::string& place)
{
  return fmt::format("{}.tmp.{}", place, getpid());
}

Output::Output(std::string place, bool overwrite)
    : place_(std::move(place)), beside_(name_beside(place_))
{
  refuse_to_overwrite(place_, overwrite);
}

Output::~Output()
{
  std::error_code ignored;
  std::filesystem::remove(beside_, ignored);
}

void Output::publish()
{
  publish_file(beside_, place_);
}

void write_whole(const std::string& path, std::string_view text)
{
  if (path.empty() || path == "-") {
    std::cout << text;
    return;
  }
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
      !std::filesystem::is_directory(status)) {
    // A device or a pipe is written to, never replaced.
    std::ofstream out(path, std::ios::binary);
    out << text << std::flush;
    if (!out) throw RunError(fmt::format("cannot write {}", path));
    return;
  }
  const std::string beside = fmt::format("{}.tmp.{}", path, getpid());
  const int file = open(beside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  const auto fail = [&](const char* what) {
    const std::string why = std::strerror(errno);
    if (file >= 0) {
      close(file);
      unlink(beside.c_str());
    }
    throw RunError(fmt::format("cannot {} {}: {}", what, path, why));
  };
  if (file < 0) fail("create");
  for (std::size_t done = 0; done < text.size();) {
    const auto count = write(file, text.data() + done, text.size() - done);
    if (count < 0) fail("write");
    done += static_cast<std::size_t>(count);
  }
  if (fsync(file) != 0) fail("write");
  if (rename(beside.c_str(), path.c_str()) != 0) fail("rename to");
  close(file);
}

}  // namespace grseg
