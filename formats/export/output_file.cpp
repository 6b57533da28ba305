// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/export/output_file.hpp"

#include "formats/core/errors.hpp"
#include "formats/core/files.hpp"

#include <boost/iostreams/filter/zlib.hpp>
#include <boost/iostreams/filtering_stream.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <ios>
#include <sstream>
#include <utility>

namespace grseg {
namespace {

namespace io = boost::iostreams;

constexpr std::streamsize buffer_size = 1 << 16;

}  // namespace

/// The compression stream, and its compressed bytes that are not yet written.
struct OutputFile::Packer {
  std::ostringstream packed;
  io::filtering_ostream bytes;  // declared last, because its destructor writes to `packed`
};

OutputFile::OutputFile(const std::string& path, bool overwrite,
                       const std::vector<std::string>& inputs)
    : name_(path), output_(path, overwrite, inputs)
{
  if (!path.ends_with(".gz")) return;
  packer_ = std::make_unique<Packer>();
  io::zlib_params gzip(io::zlib::best_speed);  // higher levels: slower, and digits hardly shrink
  gzip.window_bits = 16 + 15;  // window of 2^15 bytes; + 16: gzip header (zlib's deflateInit2)
  packer_->bytes.push(io::zlib_compressor(gzip), buffer_size);
  packer_->bytes.push(packer_->packed);
  packer_->bytes.exceptions(std::ios_base::badbit | std::ios_base::failbit);
}

OutputFile::~OutputFile() = default;

void OutputFile::write(std::string_view bytes)
{
  if (!packer_) return append_to_file(output_.temporary(), bytes, name_);
  auto& [packed, stream] = *packer_;
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  append_to_file(output_.temporary(), packed.str(), name_);
  packed.str("");
}

void OutputFile::close()
{
  if (!packer_) return;
  packer_->bytes.reset();
  append_to_file(output_.temporary(), packer_->packed.str(), name_);
  packer_.reset();
}

void OutputFile::publish()
{
  close();
  output_.publish();
}

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

OutputFolder::OutputFolder(std::string path, std::string mark, bool overwrite,
                           const std::vector<std::string>& inputs)
    : path_(without_last_slashes(std::move(path))),
      mark_(std::move(mark)),
      temporary_(temporary_path(path_)),
      overwrite_(overwrite)
{
  refuse_input_as_output(path_, inputs);
  if (is_taken(path_)) require_replaceable();
  create_folder(temporary_);
}

void OutputFolder::require_replaceable() const
{
  if (!overwrite_) throw UsageError(already_exists(path_));
  std::error_code error;
  if (!fs::exists(fs::path(path_) / mark_, error))
    throw UsageError(fmt::format(
        "{} already exists and contains no {}, so --overwrite does not replace it; choose another "
        "name",
        path_, mark_));
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
  const std::string remedy = "choose another name";
  if (!overwrite_ || !is_taken(path_)) return rename_to_new(temporary_, path_, remedy);
  require_replaceable();
  const auto old = fmt::format("{}.old.{}", path_, getpid());
  std::error_code error;
  rename_path(path_, old);
  try {
    rename_to_new(temporary_, path_, remedy);
  } catch (const RunError&) {
    fs::rename(old, path_, error);
    throw;
  }
  fs::remove_all(old, error);
}

}  // namespace grseg
