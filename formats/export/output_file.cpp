// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/export/output_file.hpp"

#include "formats/core/errors.hpp"
#include "formats/core/files.hpp"

#include <boost/iostreams/categories.hpp>
#include <boost/iostreams/filter/zlib.hpp>
#include <boost/iostreams/filtering_stream.hpp>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <ios>

namespace grseg {
namespace {

namespace io = boost::iostreams;

constexpr std::streamsize buffer_size = 1 << 16;

/// Remembers how it failed and from then on swallows what comes: Boost reports no error that
/// happens while a chain of filters is closed.
struct Descriptor {
  using char_type = char;
  using category = io::sink_tag;

  int file;
  int* error;

  std::streamsize write(const char* bytes, std::streamsize count) const
  {
    for (std::streamsize done = 0; done < count && *error == 0;) {
      const auto n = ::write(file, bytes + done, static_cast<std::size_t>(count - done));
      if (n > 0)
        done += n;
      else if (n == 0 || errno != EINTR)
        *error = n == 0 ? ENOSPC : errno;
    }
    return count;
  }
};

struct OpenFile {
  int number = -1;

  ~OpenFile() { close(); }
  /// 0 or an errno.
  int close()
  {
    const bool closed = number < 0 || ::close(number) == 0;
    number = -1;
    return closed ? 0 : errno;
  }
};

}  // namespace

struct OutputFile::Stream {
  std::string name;
  OpenFile file;
  int error = 0;                // an errno
  io::filtering_ostream bytes;  // last: its destructor writes to the file

  [[noreturn]] void fail() const
  {
    throw RunError(fmt::format("cannot write {}: {}", name, reason(error)));
  }
};

OutputFile::OutputFile(const std::string& path, bool overwrite,
                       const std::vector<std::string>& inputs)
    : output_(path, overwrite, inputs), stream_(std::make_unique<Stream>())
{
  auto& my = *stream_;
  my.name = path;
  my.file.number =
      open(output_.temporary().c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (my.file.number < 0) throw RunError(fmt::format("cannot create {}: {}", path, reason(errno)));
  if (path.ends_with(".gz")) {
    io::zlib_params gzip(io::zlib::best_speed);  // digits of reals hardly pack better, only slower
    gzip.window_bits = 16 + 15;  // zlib's deflateInit2: 16 more ask for the frame of gzip
    my.bytes.push(io::zlib_compressor(gzip), buffer_size);
  }
  my.bytes.push(Descriptor{my.file.number, &my.error}, buffer_size);
  my.bytes.exceptions(std::ios_base::badbit | std::ios_base::failbit);
}

OutputFile::~OutputFile() = default;

void OutputFile::write(std::string_view bytes)
{
  stream_->bytes.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (stream_->error != 0) stream_->fail();
}

void OutputFile::close()
{
  auto& my = *stream_;
  if (my.file.number < 0) return;
  my.bytes.reset();
  const int error = my.file.close();
  if (my.error == 0) my.error = error;
  if (my.error != 0) my.fail();
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
        "{} already exists and holds no {}, so --overwrite does not replace it; choose another "
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
