// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/run/run_files.hpp"

#include "formats/cli/output.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/files.hpp"
#include "formats/trajectory/repack.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

namespace grseg {

std::string part_of(const std::string& path)
{
  return path + ".part";
}

void require_writable(const std::string& path)
{
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) throw RunError(fmt::format("cannot create {}: {}", path, std::strerror(errno)));
  close(file);
}

bool holds_something(const std::string& path)
{
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  return !error && size > 0;
}

void publish_trajectory(const std::string& part, const std::string& output,
                        const StorageSettings& storage)
{
  if (storage.compression == 0) {
    publish_file(part, output);
    return;
  }
  Output compressed(output, true);
  repack(part, compressed.temporary(), storage);
  compressed.publish();
  std::error_code ignored;
  std::filesystem::remove(part, ignored);
}

}  // namespace grseg
