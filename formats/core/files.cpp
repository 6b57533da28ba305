// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/files.hpp"

#include "formats/core/errors.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

namespace grseg {
namespace {

void flush(const std::string& path, int (*synchronise)(int))
{
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool on_disk = file >= 0 && synchronise(file) == 0;
  const int error = errno;
  if (file >= 0) close(file);
  if (!on_disk) throw RunError(fmt::format("cannot flush {} to disk: {}", path, reason(error)));
}

/// Renames `from` unless `to` exists; returns 0 or an errno. If the file system cannot do this in
/// one call (renameat2), adds a hard link and removes the old name. If it has no links either, an
/// empty file claims the name.
int rename_unless_taken(const std::string& from, const std::string& to)
{
  if (renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return 0;
  if (errno != EINVAL && errno != ENOSYS && errno != EOPNOTSUPP) return errno;
  std::error_code ignored;
  if (std::filesystem::is_directory(from, ignored)) {  // folders cannot have hard links
    if (is_taken(to)) return EEXIST;
  } else if (link(from.c_str(), to.c_str()) == 0) {
    unlink(from.c_str());
    return 0;
  } else {
    const int claim = open(to.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (claim < 0) return errno;
    close(claim);
  }
  return rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

/// Keeps signals that end the program waiting while it exists, so that files of a moment are removed.
class SignalsWait {
 public:
  SignalsWait()
  {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, &before_);
  }
  ~SignalsWait() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsWait(const SignalsWait&) = delete;
  SignalsWait& operator=(const SignalsWait&) = delete;

 private:
  sigset_t before_{};
};

/// Throws RunError unless a file beside `path` can be created, opened again and renamed, as it is
/// when the work is done.
void try_to_publish(const std::string& path)
{
  const SignalsWait until_removed;
  const RemoveAtEnd before(temporary_path(path) + "a"), after(temporary_path(path) + "b");
  for (const char* question : {"", "; is the umask too strict?"}) {
    const int file = open(before.path().c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
    if (file < 0)
      throw RunError(fmt::format("cannot create {}: {}{}", path, reason(errno), question));
    close(file);
  }
  if (rename(before.path().c_str(), after.path().c_str()) != 0)
    throw RunError(fmt::format(
        "cannot create {}: its file system renames no files ({}); name an output on another one, "
        "and copy it",
        path, reason(errno)));
}

/// True if `digits` is the number of a process that has ended, or of this process.
bool is_of_ended_process(const std::string& digits)
{
  pid_t process = 0;
  const auto* last = digits.data() + digits.size();
  const auto [end, wrong] = std::from_chars(digits.data(), last, process);
  if (wrong != std::errc() || end != last || process <= 0) return false;
  return process == getpid() || (kill(process, 0) != 0 && errno == ESRCH);
}

/// True if the file `path` lies in `folder` or in one of its subfolders.
bool lies_in(const std::string& path, const std::string& folder)
{
  std::error_code error;
  auto above = std::filesystem::canonical(path, error);
  while (!error && above.has_relative_path()) {
    above = above.parent_path();
    if (same_file(above.string(), folder)) return true;
  }
  return false;
}

}  // namespace

void require_file(const std::string& path)
{
  struct stat found {};
  if (stat(path.c_str(), &found) != 0 && (errno == ENOENT || errno == ENOTDIR))
    throw UsageError(fmt::format("{}: no such file", path));
  if (S_ISDIR(found.st_mode)) throw UsageError(fmt::format("{}: is a folder, not a file", path));
  if (access(path.c_str(), R_OK) != 0)
    throw UsageError(fmt::format("{}: cannot be read: {}", path, reason(errno)));
}

void require_seekable(const std::string& path)
{
  require_file(path);
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw UsageError(fmt::format(
        "{}: is a pipe or a device, which can be read only once; write it to a file first", path));
}

std::string already_exists(const std::string& path)
{
  return fmt::format("{} already exists; choose another name, remove it, or pass --overwrite",
                     path);
}

bool is_taken(const std::string& path)
{
  std::error_code error;
  return std::filesystem::exists(std::filesystem::symlink_status(path, error));
}

std::string behind_links(const std::string& path)
{
  namespace fs = std::filesystem;
  constexpr int most = 40;  // as many as the kernel follows
  fs::path target = path;
  std::error_code error;
  for (int k = 0; k < most && !is_device(path) && fs::is_symlink(target, error); ++k)
    target = target.parent_path() / fs::read_symlink(target, error);
  return target.string();
}

bool same_file(const std::string& a, const std::string& b)
{
  struct stat of_a {
  }, of_b{};
  return stat(a.c_str(), &of_a) == 0 && stat(b.c_str(), &of_b) == 0 && of_a.st_dev == of_b.st_dev &&
         of_a.st_ino == of_b.st_ino;
}

bool is_device(const std::string& path)
{
  std::error_code error;
  // Streams of this process; is_other() is false for one that is redirected to a file.
  for (const char* of_process : {"/dev/std", "/dev/fd/", "/proc/"})
    if (path.starts_with(of_process)) return true;
  return std::filesystem::is_other(std::filesystem::status(path, error));
}

void refuse_input_as_output(const std::string& output, const std::vector<std::string>& inputs)
{
  if (is_device(output)) return;
  for (const auto& input : inputs) {
    if (same_file(output, input))
      throw UsageError(
          input == output
              ? fmt::format("{} is an input and cannot be the output; choose another name", output)
              : fmt::format("{} is the input {} under another name and cannot be the output; "
                            "choose another name",
                            output, input));
    if (lies_in(input, output))
      throw UsageError(fmt::format(
          "the input {} lies in the folder {}, which cannot be the output; choose another name",
          input, output));
  }
}

void check_output(const std::string& path, bool overwrite, const std::vector<std::string>& inputs)
{
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw UsageError(fmt::format("{} is a folder; name a file inside it", path));
  if (is_device(path)) throw UsageError(fmt::format("{} is a device or a pipe; name a file", path));
  refuse_input_as_output(path, inputs);
  const auto target = behind_links(path);
  if (!overwrite && is_taken(path))
    throw UsageError(is_taken(target)
                         ? already_exists(path)
                         : fmt::format("{} is a link to {}, which does not exist; choose another "
                                       "name, remove it, or pass --overwrite to write there",
                                       path, target));
  try_to_publish(target);
}

std::string reason(int error)
{
  constexpr int no_locks = 524;  // ENOTSUPP of the kernel, which Lustre and DVS return
  struct Remedy {
    int error;
    const char* text;
  };
  constexpr Remedy remedies[] = {
      {EFBIG, "is there a limit (ulimit -f, quota)?"},
      {EMFILE, "raise the limit (ulimit -n)"},
      {ENFILE, "close other programs"},
      {ENOMEM, "is there a limit (ulimit -v, cgroup)?"},
      {ENOLCK, "set HDF5_USE_FILE_LOCKING=FALSE"},
      {no_locks, "set HDF5_USE_FILE_LOCKING=FALSE"},
      {EIO, "does its disk or file server still work?"},
      {ESTALE, "mount its file system again"},
      {ENOTCONN, "mount its file system again"},
      {EHOSTDOWN, "does its file server still work?"},
      {ETIMEDOUT, "does its file server still work?"},
  };
  std::string words = std::strerror(error == no_locks ? ENOLCK : error);
  for (const auto& [known, text] : remedies)
    if (known == error) return words + "; " + text;
  return words;
}

std::string temporary_path(const std::string& path)
{
  return fmt::format("{}.tmp.{}", path, getpid());
}

std::string new_temporary(const std::string& path)
{
  auto name = temporary_path(path);
  const int file = open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file < 0 && errno == EEXIST)
    throw RunError(fmt::format(
        "{} is being written by another process, says {}; if that one is dead, remove this file",
        path, name));
  if (file < 0) throw RunError(fmt::format("cannot create {}: {}", path, reason(errno)));
  close(file);
  return name;
}

void remove_temporaries(const std::string& path)
{
  namespace fs = std::filesystem;
  const fs::path whole(path);
  const auto begin = whole.filename().string() + ".tmp.";
  const auto folder = whole.has_parent_path() ? whole.parent_path() : fs::path(".");
  std::vector<fs::path> left;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const auto name = at->path().filename().string();
    if (name.starts_with(begin) && is_of_ended_process(name.substr(begin.size())))
      left.push_back(at->path());
  }
  for (const auto& file : left) fs::remove(file, error);
}

namespace {

/// Writes `content` to the file `path`, opened with the flag `mode` (O_TRUNC or O_APPEND).
void write_with(int mode, const std::string& path, std::string_view content,
                const std::string& name)
{
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | mode | O_CLOEXEC, 0666);
  if (file < 0) throw RunError(fmt::format("cannot create {}: {}", name, reason(errno)));
  const auto fail = [&name](int error) {
    throw RunError(fmt::format("cannot write {}: {}", name, reason(error)));
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

}  // namespace

void write_file(const std::string& path, std::string_view content, const std::string& name)
{
  write_with(O_TRUNC, path, content, name);
}

void append_to_file(const std::string& path, std::string_view content, const std::string& name)
{
  write_with(O_APPEND, path, content, name);
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

void rename_to_new(const std::string& from, const std::string& to, const std::string& remedy)
{
  const int error = rename_unless_taken(from, to);
  if (error == EEXIST)
    throw RunError(fmt::format("{} has appeared since this program began and is not replaced; {}",
                               to, remedy));
  if (error != 0)
    throw RunError(fmt::format("cannot rename {} to {}: {}", from, to, reason(error)));
}

void keep_as(const std::string& path, const std::string& second)
{
  // Renaming between two hard links of one file does nothing, so the temporary name may remain.
  const RemoveAtEnd temporary(temporary_path(second));
  const bool linked = link(path.c_str(), temporary.path().c_str()) == 0;
  rename_path(linked ? temporary.path() : path, second);
}

void publish_file(const std::string& temporary, const std::string& path, bool overwrite,
                  const std::string& remedy)
{
  flush_to_disk(temporary);
  if (overwrite)
    rename_path(temporary, path);
  else
    rename_to_new(temporary, path, remedy);
}

RemoveAtEnd::~RemoveAtEnd()
{
  std::error_code ignored;
  if (condition_ == If::there || std::filesystem::file_size(path_, ignored) == 0)
    std::filesystem::remove(path_, ignored);
}

}  // namespace grseg
