// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/common/guarded_reading.hpp"

#include "formats/core/files.hpp"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <utility>

namespace grseg {
namespace {

// Limits of one reading: processor time in seconds, and additional memory in bytes. Undamaged files
// need a tenth of both.
constexpr rlim_t patience = 1, bytes_per_second = 1 << 20;
constexpr rlim_t memory = 128 << 20, memory_per_byte = 64;

/// Place that the child is reading, "" outside of read_guarded(): memory that both processes share.
/// Null in a process that is not such a child.
constexpr std::size_t longest_place = 8192;
char* shared_place = nullptr;

void tell_place(const std::string& place)
{
  shared_place[place.copy(shared_place, longest_place - 1)] = '\0';
}

void set_timer(rlim_t seconds)
{
  itimerval once{};
  once.it_value.tv_sec = static_cast<time_t>(seconds);
  setitimer(ITIMER_PROF, &once, nullptr);  // SIGPROF ends the process when the time is used up
}

pid_t child = 0;

void pass_on(int signal)
{
  kill(child, signal);
}

/// Waits for the child, and passes on the signals that end a program; `mask` was in force before.
int status_of_child(const sigset_t& mask)
{
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2, SIGXCPU})
    if (std::signal(signal, pass_on) == SIG_IGN) std::signal(signal, SIG_IGN);
  pthread_sigmask(SIG_SETMASK, &mask, nullptr);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

/// Ends this process as the child has ended, with an explanation if a file has killed it.
[[noreturn]] void end_as(int status, const std::string& program, const std::string& place,
                         const std::string& output)
{
  if (!WIFSIGNALED(status)) _exit(WEXITSTATUS(status));
  const int signal = WTERMSIG(status);
  if (!output.empty()) remove_temporaries(behind_links(output));
  if (signal == SIGKILL) {
    fmt::print(stderr, "{}: the process that imports was killed; is memory short?\n", program);
    _exit(exit_trouble);
  }
  if (!place.empty()) {
    const auto end = signal == SIGPROF ? std::string("does not end")
                                       : fmt::format("ends in a crash (signal {})", signal);
    fmt::print(stderr, "{}: {}: reading {}; the file is damaged: copy it again\n", program, place,
               end);
    _exit(exit_content);
  }
  std::signal(signal, SIG_DFL);
  std::raise(signal);
  _exit(exit_trouble);
}

class GuardedArchive : public Archive {
 public:
  GuardedArchive(std::string file, const std::function<std::unique_ptr<Archive>()>& open)
      : file_(std::move(file)), place_(file_), archive_(read_guarded(file_, place_, open))
  {
  }
  const ArchiveFacts& facts() const override { return archive_->facts(); }
  std::vector<std::string> remarks() const override { return archive_->remarks(); }
  bool next(ArchiveFrame& frame) override
  {
    const bool more = read_guarded(file_, place_, [&] { return archive_->next(frame); });
    if (more) place_ = fmt::format("{} or later", frame.place);
    return more;
  }

 private:
  std::string file_, place_;
  std::unique_ptr<Archive> archive_;
};

}  // namespace

void continue_in_child(const std::string& program, const std::string& output)
{
  void* const both =
      mmap(nullptr, longest_place, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  const pid_t parent = getpid();
  sigset_t all, before;  // no signal is lost before it can be passed on
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, &before);
  child = both == MAP_FAILED ? -1 : fork();
  if (child < 0) throw RunError(fmt::format("cannot start a process: {}", reason(errno)));
  if (child > 0) {
    const int status = status_of_child(before);
    end_as(status, program, static_cast<const char*>(both), output);
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  shared_place = static_cast<char*>(both);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(exit_trouble);  // the parent ended before prctl()
  std::signal(SIGPROF, SIG_DFL);
  const rlimit no_core{};
  setrlimit(RLIMIT_CORE, &no_core);
}

LimitedReading::LimitedReading(const std::string& file, const std::string& place)
{
  if (shared_place == nullptr) return;
  tell_place(place);
  std::error_code none;
  const auto found = std::filesystem::file_size(file, none);
  const rlim_t size = none ? 0 : found;
  rlim_t pages = 0;  // memory pages that the program uses so far
  std::ifstream("/proc/self/statm") >> pages;
  getrlimit(RLIMIT_AS, &memory_);
  const rlim_t most =
      pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + memory + memory_per_byte * size;
  const rlimit limit{std::min(memory_.rlim_cur, most), memory_.rlim_max};
  if (pages > 0) setrlimit(RLIMIT_AS, &limit);
  set_timer(patience + size / bytes_per_second);
}

LimitedReading::~LimitedReading()
{
  if (shared_place == nullptr) return;
  set_timer(0);
  setrlimit(RLIMIT_AS, &memory_);
  tell_place("");
}

void refuse_as_too_large(const std::string& file)
{
  throw FormatError(
      fmt::format("{}: reading asks for more memory than a file of this size can fill; the file is "
                  "damaged: copy it again",
                  file));
}

std::unique_ptr<Archive> open_guarded(const std::string& file,
                                      const std::function<std::unique_ptr<Archive>()>& open)
{
  return std::make_unique<GuardedArchive>(file, open);
}

}  // namespace grseg
