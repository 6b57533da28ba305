// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/export/output.hpp"

#include "formats/core/errors.hpp"
#include "formats/core/files.hpp"

#include <boost/iostreams/categories.hpp>
#include <boost/iostreams/filter/zlib.hpp>
#include <boost/iostreams/filtering_stream.hpp>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <ios>

namespace grseg {
namespace {

namespace fs = std::filesystem;
namespace io = boost::iostreams;

constexpr std::streamsize buffer_size = 1 << 16;

[[noreturn]] void fail(const char* what, const std::string& path, const std::string& why)
{
  throw RunError(fmt::format("cannot {} {}: {}", what, path, why));
}

/// One call for a folder of thousands of files.
void bring_file_system_to_disk(const std::string& path)
{
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool on_disk = file >= 0 && syncfs(file) == 0;
  const std::string why = std::strerror(errno);
  if (file >= 0) close(file);
  if (!on_disk) fail("bring to the disk", path, why);
}

void rename(const std::string& from, const std::string& to)
{
  std::error_code error;
  fs::rename(from, to, error);
  if (error) throw RunError(fmt::format("cannot rename {} to {}: {}", from, to, error.message()));
}

std::string without_last_slashes(std::string path)
{
  while (path.size() > 1 && path.ends_with('/')) path.pop_back();
  return path;
}

/// A file that remembers whether it failed, and takes all that comes thereafter: of what happens
/// while a chain of filters is closed Boost tells nothing.
struct Descriptor {
  using char_type = char;
  using category = io::sink_tag;

  int file;
  bool* failed;

  std::streamsize write(const char* bytes, std::streamsize count) const
  {
    for (std::streamsize done = 0; done < count && !*failed;) {
      const auto n = ::write(file, bytes + done, static_cast<std::size_t>(count - done));
      if (n > 0)
        done += n;
      else
        *failed = n == 0 || errno != EINTR;
    }
    return count;
  }
};

struct OpenFile {
  int number = -1;

  ~OpenFile() { close(); }
  bool close()
  {
    const bool closed = number < 0 || ::close(number) == 0;
    number = -1;
    return closed;
  }
};

}  // namespace

struct ByteSink::Impl {
  std::string path;
  OpenFile file;
  bool failed = false;
  io::filtering_ostream stream;  // last: when it goes it writes to the file
};

ByteSink::ByteSink(const std::string& path, const std::string& name)
    : impl_(std::make_unique<Impl>())
{
  auto& my = *impl_;
  my.path = path;
  my.file.number = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (my.file.number < 0) fail("create", name, std::strerror(errno));
  if (name.ends_with(".gz")) {
    io::zlib_params gzip(io::zlib::best_speed);  // digits of reals hardly pack better, only slower
    gzip.window_bits = 16 + 15;  // zlib's deflateInit2: 16 more ask for the frame of gzip
    my.stream.push(io::zlib_compressor(gzip), buffer_size);
  }
  my.stream.push(Descriptor{my.file.number, &my.failed}, buffer_size);
  my.stream.exceptions(std::ios_base::badbit | std::ios_base::failbit);
}

ByteSink::~ByteSink() = default;

void ByteSink::write(std::string_view bytes)
{
  impl_->stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (impl_->failed) fail("write", impl_->path, "is the disk full?");
}

void ByteSink::close()
{
  auto& my = *impl_;
  if (my.file.number < 0) return;
  my.stream.reset();
  if (!my.file.close() || my.failed) fail("write", my.path, "is the disk full?");
}

OutputFolder::OutputFolder(std::string path, std::string mark, bool overwrite)
    : path_(without_last_slashes(std::move(path))),
      mark_(std::move(mark)),
      beside_(name_beside(path_))
{
  std::error_code error;
  if (fs::exists(path_, error) && !(overwrite && fs::exists(fs::path(path_) / mark_, error)))
    throw UsageError(
        overwrite
            ? fmt::format("{} is there already and holds no {}: it is no folder that "
                          "--overwrite may replace; choose another name",
                          path_, mark_)
            : fmt::format("{} is there already; choose another name, remove it, or say --overwrite",
                          path_));
  if (!fs::create_directory(beside_, error)) fail("create", beside_, error.message());
}

OutputFolder::~OutputFolder()
{
  std::error_code ignored;
  fs::remove_all(beside_, ignored);
}

void OutputFolder::add_folder(const std::string& name) const
{
  std::error_code error;
  const auto folder = (fs::path(beside_) / name).string();
  if (!fs::create_directory(folder, error)) fail("create", folder, error.message());
}

void OutputFolder::add_file(const std::string& name, std::string_view bytes) const
{
  const auto path = (fs::path(beside_) / name).string();
  ByteSink sink(path, path);
  sink.write(bytes);
  sink.close();
}

void OutputFolder::publish()
{
  bring_file_system_to_disk(beside_);
  const auto old = fmt::format("{}.old.{}", path_, getpid());
  std::error_code error;
  const bool replaces = fs::exists(path_, error);
  if (replaces) rename(path_, old);
  try {
    rename(beside_, path_);
  } catch (const RunError&) {
    if (replaces) fs::rename(old, path_, error);
    throw;
  }
  if (replaces) fs::remove_all(old, error);
}

}  // namespace grseg
