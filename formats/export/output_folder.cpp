// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/export/output_folder.hpp"

#include "formats/core/errors.hpp"
#include "formats/core/files.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>

namespace grseg {
namespace {

namespace fs = std::filesystem;

std::string without_last_slashes(std::string path)
{
  while (path.size() > 1 && path.ends_with('/')) path.pop_back();
  return path;
}

void create_folder(const std::string& path)
{
  std::error_code error;
  if (!fs::create_directory(path, error))
    throw RunError(fmt::format("cannot create {}: {}", path, error.message()));
}

}  // namespace

OutputFolder::OutputFolder(std::string path, std::string mark, bool overwrite)
    : path_(without_last_slashes(std::move(path))),
      mark_(std::move(mark)),
      temporary_(temporary_path(path_))
{
  std::error_code error;
  const bool exists = fs::exists(path_, error);
  if (exists && !overwrite) throw UsageError(already_exists(path_));
  if (exists && !fs::exists(fs::path(path_) / mark_, error))
    throw UsageError(fmt::format(
        "{} already exists and holds no {}, so --overwrite does not replace it; choose another "
        "name",
        path_, mark_));
  create_folder(temporary_);
}

OutputFolder::~OutputFolder()
{
  std::error_code ignored;
  fs::remove_all(temporary_, ignored);
}

void OutputFolder::add_folder(const std::string& name) const
{
  create_folder((fs::path(temporary_) / name).string());
}

void OutputFolder::add_file(const std::string& name, std::string_view content) const
{
  const auto path = (fs::path(temporary_) / name).string();
  write_file(path, content, path);
}

void OutputFolder::publish()
{
  flush_file_system(temporary_);
  const auto old = fmt::format("{}.old.{}", path_, getpid());
  std::error_code error;
  const bool replaces = fs::exists(path_, error);
  if (replaces) rename_path(path_, old);
  try {
    rename_path(temporary_, path_);
  } catch (const RunError&) {
    if (replaces) fs::rename(old, path_, error);
    throw;
  }
  if (replaces) fs::remove_all(old, error);
}

}  // namespace grseg
