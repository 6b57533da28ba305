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

/// When the process began, in the system's ticks since it was booted: a number of a process is used
/// again, together with this it is not. 0 where there is no such process.
unsigned long long start_of(long process)
{
  std::ifstream file(fmt::format("/proc/{}/stat", process));
  std::string text;
  std::getline(file, text);
  const auto name_ends = text.rfind(')');
  if (name_ends == std::string::npos) return 0;
  std::istringstream words(text.substr(name_ends + 1));
  std::string word;
  for (int k = 0; k < 19; ++k) words >> word;  // fields 3 to 21 of proc(5)
  unsigned long long start = 0;
  words >> start;
  return start;
}

/// The process that a lock names.
struct Owner {
  std::string host;
  long process = 0;
  unsigned long long start = 0;

  static Owner self() { return {this_host(), getpid(), start_of(getpid())}; }
  /// Empty where `file` does not hold one.
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

/// True while `path` is still the name of the open `file`; its owner may have removed it meanwhile.
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
    return;  // a disk that is full does not hinder the lock: others do not learn who has it
}

[[noreturn]] void refuse(const std::string& path, const std::optional<Owner>& owner)
{
  throw UsageError(fmt::format("{} is being written by {}; wait for it, or choose another name",
                               path, owner ? owner->sentence() : "another process"));
}

/// A message that leaves to the reader whether the writer that `file` stands for is alive.
[[noreturn]] void refuse_unless_removed(const std::string& path, const std::string& file,
                                        const std::optional<Owner>& owner)
{
  const auto who = owner ? owner->sentence() : "a process that it does not name";
  throw UsageError(
      fmt::format("{} is being written by {}, says {}; if that run is dead, remove this file", path,
                  who, file));
}

/// Refuses the owner of `lock`, unless it has died; its lock is then removed. One process at a time
/// looks and removes, so that none removes a lock taken after it looked.
void remove_dead_lock(const std::string& path, const std::string& lock)
{
  const auto claim = lock + ".claim";
  const int file = open(claim.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file < 0 && errno == EEXIST) refuse_unless_removed(path, claim, {});
  if (file < 0) throw RunError(fmt::format("cannot create {}: {}", claim, reason(errno)));
  close(file);
  const RemoveAtEnd claimed(claim);
  const auto owner = Owner::in(lock);
  if (!owner && access(lock.c_str(), F_OK) != 0) return;  // its owner has ended meanwhile
  if (!owner || !owner->has_died()) refuse_unless_removed(path, lock, owner);
  unlink(lock.c_str());
}

bool has_no_locks(int error)
{
  return error == ENOSYS || error == EOPNOTSUPP || error == ENOLCK;
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
  if (is_name_of(path_, file_)) unlink(path_.c_str());  // before the lock is released
  close(file_);
}

/// False where the file of another process went away meanwhile: once more.
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
  if (has_no_locks(error) && created) return true;  // nobody else can have created it
  close(file_);
  if (error == EWOULDBLOCK) refuse(path, Owner::in(path_));
  if (has_no_locks(error))
    remove_dead_lock(path, path_);
  else if (error != 0)
    throw RunError(fmt::format("cannot lock {}: {}", path_, reason(error)));
  return false;
}

}  // namespace grseg
