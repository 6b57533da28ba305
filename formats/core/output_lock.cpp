// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/output_lock.hpp"

#include "formats/core/errors.hpp"
#include "formats/core/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <optional>
#include <sstream>

namespace grseg {
namespace {

std::string this_host()
{
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

/// Start time of the process, in clock ticks since the system was booted; 0 if there is no such
/// process. Systems reuse process numbers, but not together with the start time.
unsigned long long start_of(long process)
{
  std::ifstream file(fmt::format("/proc/{}/stat", process));
  std::string text;
  std::getline(file, text);
  const auto name_ends = text.rfind(')');
  if (name_ends == std::string::npos) return 0;
  std::istringstream words(text.substr(name_ends + 1));
  std::string word;
  for (int k = 0; k < 19; ++k) words >> word;  // skips fields 3 to 21 (proc(5))
  unsigned long long start = 0;
  words >> start;
  return start;
}

/// The process that a lock file names.
struct Owner {
  std::string host;
  long process = 0;
  unsigned long long start = 0;

  static Owner self() { return {this_host(), getpid(), start_of(getpid())}; }
  /// The owner that the lock file `file` names; empty if the file cannot be read or names none.
  static std::optional<Owner> in(const std::string& file)
  {
    std::ifstream text(file);
    Owner owner;
    if (text >> owner.host >> owner.process >> owner.start && owner.process > 0) return owner;
    return {};
  }
  std::string text() const { return fmt::format("{} {} {}\n", host, process, start); }
  std::string sentence() const { return fmt::format("process {} on {}", process, host); }
  bool has_died() const
  {
    if (host != this_host()) return false;
    return (kill(static_cast<pid_t>(process), 0) != 0 && errno == ESRCH) ||
           start_of(process) != start;
  }
  bool operator==(const Owner&) const = default;
};

/// True if `path` is still the name of the open `file`: its owner may have removed it meanwhile.
bool is_name_of(const std::string& path, int file)
{
  struct stat of_file {
  }, of_path{};
  return fstat(file, &of_file) == 0 && stat(path.c_str(), &of_path) == 0 &&
         of_file.st_dev == of_path.st_dev && of_file.st_ino == of_path.st_ino;
}

void write_owner(int file)
{
  const auto text = Owner::self().text();
  if (ftruncate(file, 0) != 0 || pwrite(file, text.data(), text.size(), 0) < 0)
    return;  // on a full disk the lock still works; other processes just cannot name its owner
}

[[noreturn]] void refuse(const std::string& path, const std::optional<Owner>& owner)
{
  throw UsageError(fmt::format("{} is being written by {}; wait for it, or choose another name",
                               path, owner ? owner->sentence() : "another process"));
}

/// Throws a message for the case that nobody can tell whether the writer named in the lock file
/// `file` is still running.
[[noreturn]] void refuse_unless_removed(const std::string& path, const std::string& file,
                                        const std::optional<Owner>& owner)
{
  const auto who = owner ? owner->sentence() : "a process that it does not name";
  throw UsageError(
      fmt::format("{} is being written by {}, says {}; if that run is dead, remove this file", path,
                  who, file));
}

/// Removes `lock` if its owner has died; throws UsageError if not. One process at a time checks and
/// removes, so that no process removes a lock that was taken after its check.
void remove_dead_lock(const std::string& path, const std::string& lock)
{
  const auto claim = lock + ".claim";
  const int file = open(claim.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file < 0 && errno == EEXIST) refuse_unless_removed(path, claim, {});
  if (file < 0) throw RunError(fmt::format("cannot create {}: {}", claim, reason(errno)));
  close(file);
  const RemoveAtEnd claimed(claim);
  const auto owner = Owner::in(lock);
  if (!owner && access(lock.c_str(), F_OK) != 0) return;  // its owner has finished meanwhile
  if (!owner || !owner->has_died()) refuse_unless_removed(path, lock, owner);
  unlink(lock.c_str());
}

/// Whatever else the system says (ENOLCK, EOPNOTSUPP, 524 of Lustre), the file system has no locks.
bool has_no_locks(int error)
{
  return error != 0 && error != EWOULDBLOCK;
}

}  // namespace

int lock_file(int file)
{
  return flock(file, LOCK_EX | LOCK_NB) == 0 ? 0 : errno;
}

OutputLock::OutputLock(const std::string& path, int (*lock)(int file)) : path_(path + ".lock")
{
  while (!take(path, lock)) continue;
  write_owner(file_);
}

OutputLock::~OutputLock()
{
  if (is_name_of(path_, file_)) unlink(path_.c_str());  // must precede close(), the unlocking
  close(file_);
}

/// Takes the lock; returns false if the lock file of another process vanished meanwhile, and the
/// caller has to try again.
bool OutputLock::take(const std::string& path, int (*lock)(int file))
{
  file_ = open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  const bool created = file_ >= 0;
  if (!created && errno == EEXIST) {
    file_ = open(path_.c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC);
    if (file_ < 0 && errno == ENOENT) return false;
  }
  if (file_ < 0) throw RunError(fmt::format("cannot create {}: {}", path_, reason(errno)));
  const int error = lock(file_);
  if (error == 0 && is_name_of(path_, file_)) return true;
  if (has_no_locks(error) && created) return true;  // O_EXCL: only this process can have created it
  close(file_);
  if (error == EWOULDBLOCK) refuse(path, Owner::in(path_));
  if (has_no_locks(error)) remove_dead_lock(path, path_);
  return false;
}

}  // namespace grseg
