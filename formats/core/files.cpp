// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/files.hpp"

#include "formats/core/errors.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

namespace grseg {

void require_file(const std::string& path)
{
  std::error_code error;
  if (!std::filesystem::exists(path, error))
    throw UsageError(fmt::format("{}: there is no such file", path));
  if (std::filesystem::is_directory(path, error))
    throw UsageError(fmt::format("{}: is a folder, not a file", path));
  if (access(path.c_str(), R_OK) != 0)
    throw UsageError(fmt::format("{}: cannot be read: {}", path, std::strerror(errno)));
}

void refuse_to_overwrite(const std::string& path, bool overwrite)
{
  if (std::filesystem::is_directory(path))
    throw UsageError(fmt::format("{} is a folder; name a file in it", path));
  if (!overwrite && std::filesystem::exists(path))
    throw UsageError(fmt::format(
        "{} is there already; choose another name, remove it, or say --overwrite", path));
}

void bring_to_disk(const std::string& path)
{
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool on_disk = file >= 0 && fsync(file) == 0;
  const std::string why = std::strerror(errno);
  if (file >= 0) close(file);
  if (!on_disk) throw RunError(fmt::format("cannot bring {} to the disk: {}", path, why));
}

void publish_file(const std::string& beside, const std::string& path)
{
  bring_to_disk(beside);
  std::error_code error;
  std::filesystem::rename(beside, path, error);
  if (error)
    throw RunError(fmt::format("cannot rename {} to {}: {}", beside, path, error.message()));
}

}  // namespace grseg
