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
namespace {

void flush(const std::string& path, int (*synchronise)(int))
{
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool on_disk = file >= 0 && synchronise(file) == 0;
  const int error = errno;
  if (file >= 0) close(file);
  if (!on_disk)
    throw RunError(fmt::format("cannot flush {} to disk: {}", path, std::strerror(error)));
}

}  // namespace

void require_file(const std::string& path)
{
  std::error_code error;
  if (!std::filesystem::exists(path, error))
    throw UsageError(fmt::format("{}: no such file", path));
  if (std::filesystem::is_directory(path, error))
    throw UsageError(fmt::format("{}: is a folder, not a file", path));
  if (access(path.c_str(), R_OK) != 0)
    throw UsageError(fmt::format("{}: cannot be read: {}", path, std::strerror(errno)));
}

std::string already_exists(const std::string& path)
{
  return fmt::format("{} already exists; choose another name, remove it, or pass --overwrite",
                     path);
}

void refuse_to_overwrite(const std::string& path, bool overwrite)
{
  if (std::filesystem::is_directory(path))
    throw UsageError(fmt::format("{} is a folder; name a file inside it", path));
  if (!overwrite && std::filesystem::exists(path)) throw UsageError(already_exists(path));
}

std::string temporary_path(const std::string& path)
{
  return fmt::format("{}.tmp.{}", path, getpid());
}

void write_file(const std::string& path, std::string_view content, const std::string& name)
{
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) throw RunError(fmt::format("cannot create {}: {}", name, std::strerror(errno)));
  const auto fail = [&name](int error) {
    throw RunError(
        fmt::format("cannot write {}: {}; is the disk full?", name, std::strerror(error)));
  };
  for (std::size_t done = 0; done < content.size();) {
    const auto count = write(file, content.data() + done, content.size() - done);
    if (count > 0) {
      done += static_cast<std::size_t>(count);
    } else if (count == 0 || errno != EINTR) {
      const int error = errno;
      close(file);
      fail(error);
    }
  }
  if (close(file) != 0) fail(errno);
}

void flush_to_disk(const std::string& path)
{
  flush(path, fsync);
}

void flush_file_system(const std::string& path)
{
  flush(path, syncfs);
}

void rename_path(const std::string& from, const std::string& to)
{
  std::error_code error;
  std::filesystem::rename(from, to, error);
  if (error) throw RunError(fmt::format("cannot rename {} to {}: {}", from, to, error.message()));
}

void publish_file(const std::string& temporary, const std::string& path)
{
  flush_to_disk(temporary);
  rename_path(temporary, path);
}

RemoveAtEnd::~RemoveAtEnd()
{
  std::error_code ignored;
  if (condition_ == If::there || std::filesystem::file_size(path_, ignored) == 0)
    std::filesystem::remove(path_, ignored);
}

}  // namespace grseg
