// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/common/apart.hpp"

#include "formats/core/errors.hpp"
#include "formats/core/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <new>

namespace grseg {
namespace {

// Limits of the work for one message: processor time in seconds, and additional memory in bytes.
// Undamaged files need a tenth of both.
constexpr rlim_t patience = 1, bytes_per_second = 1 << 20;
constexpr rlim_t memory = 128 << 20, memory_per_byte = 64;

/// Calls `pass` (read or write) until all bytes have been transferred; false if that fails.
template <class Pass, class Byte>
bool pass_all(Pass pass, int end, Byte* bytes, std::size_t count)
{
  while (count > 0) {
    const auto passed = pass(end, bytes, count);
    if (passed < 0 && errno == EINTR) continue;
    if (passed <= 0) return false;
    bytes += passed;
    count -= static_cast<std::size_t>(passed);
  }
  return true;
}

/// Writes a message (`code` 0), or an error's text with the exit code of the ToolError.
void write_message(int end, std::int32_t code, const std::string& text)
{
  std::uint64_t size = text.size();
  const auto header = packing::packed(code, size);
  if (!pass_all(write, end, header.data(), header.size()) ||
      !pass_all(write, end, text.data(), text.size()))
    _exit(exit_trouble);  // the parent process has closed the pipe
}

void limit_memory(rlim_t file_size)
{
  rlim_t pages = 0;  // memory pages that the program uses so far
  rlimit limit{};
  if (!(std::ifstream("/proc/self/statm") >> pages)) return;
  if (getrlimit(RLIMIT_AS, &limit) != 0) return;
  limit.rlim_cur = std::min(limit.rlim_cur, pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) +
                                                memory + memory_per_byte * file_size);
  setrlimit(RLIMIT_AS, &limit);
}

/// Restarts the timer for the next message; SIGPROF ends the process when the time is used up.
void limit_time(rlim_t file_size)
{
  itimerval once{};
  once.it_value.tv_sec = static_cast<time_t>(patience + file_size / bytes_per_second);
  setitimer(ITIMER_PROF, &once, nullptr);
}

/// The whole program of the separate process: sets limits, runs `work`, reports errors, exits.
[[noreturn]] void work_apart(int end, const std::string& file, const Apart::Work& work)
{
  std::error_code none;
  const auto found = std::filesystem::file_size(file, none);
  const rlim_t size = none ? 0 : found;
  std::signal(SIGPROF, SIG_DFL);
  const rlimit no_core{};
  setrlimit(RLIMIT_CORE, &no_core);
  limit_memory(size);
  limit_time(size);
  try {
    work([&](const std::string& message) {
      write_message(end, 0, message);
      limit_time(size);
    });
  } catch (const ToolError& error) {
    write_message(end, error.code(), error.what());
  } catch (const std::bad_alloc&) {
    write_message(end, exit_content,
                  fmt::format("{}: reading asks for more memory than a file of this size can fill; "
                              "the file is damaged: copy it again",
                              file));
  } catch (const std::exception& error) {
    write_message(end, exit_content, fmt::format("{}: {}", file, error.what()));
  }
  _exit(exit_done);
}

/// Describes how a process ended without a message, as part of a sentence ("ends in a crash ...").
std::string how_it_ends(int status)
{
  if (!WIFSIGNALED(status))
    return fmt::format("ends in a crash (exit code {})", WEXITSTATUS(status));
  if (WTERMSIG(status) == SIGPROF) return "does not end";
  return fmt::format("ends in a crash (signal {})", WTERMSIG(status));
}

[[noreturn]] void rethrow(std::int32_t code, const std::string& sentence)
{
  if (code == exit_usage) throw UsageError(sentence);
  if (code == exit_content) throw FormatError(sentence);
  throw ToolError(static_cast<ExitCode>(code), sentence);
}

/// A message of the separate process: sent once the archive is open, and with each frame.
struct News {
  ArchiveFacts facts;
  std::vector<std::string> remarks;
  bool more = true;
  ArchiveFrame frame;
};

template <class Pass>
void each_of(News& news, Pass& pass)
{
  auto& [facts, remarks, more, frame] = news;
  pass(facts, remarks, more, frame);
}

void read_apart(Archive& archive, const Apart::Send& send)
{
  News news;
  const auto tell = [&] {
    news.facts = archive.facts();
    news.remarks = archive.remarks();
    send(packing::packed(news));
  };
  tell();
  while (news.more) {
    news.more = archive.next(news.frame);
    tell();
  }
}

class ApartArchive : public Archive {
 public:
  ApartArchive(const std::string& file, const std::function<std::unique_ptr<Archive>()>& open)
      : apart_(file, [&](const Apart::Send& send) { read_apart(*open(), send); }), place_(file)
  {
    hear();
  }
  const ArchiveFacts& facts() const override { return news_.facts; }
  std::vector<std::string> remarks() const override { return news_.remarks; }
  bool next(ArchiveFrame& frame) override
  {
    if (!news_.more) return false;
    hear();
    std::swap(frame, news_.frame);  // so that the memory of both is used again
    if (news_.more) place_ = fmt::format("{} or later", frame.place);
    return news_.more;
  }

 private:
  void hear() { packing::unpack(apart_.receive(place_), news_); }

  Apart apart_;
  News news_;
  std::string place_;
};

}  // namespace

Apart::Apart(std::string file, const Work& work) : file_(std::move(file))
{
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0)
    throw RunError(fmt::format("{}: cannot be read: {}", file_, reason(errno)));
  end_ = ends[0];
  const pid_t parent = getpid();
  process_ = fork();
  if (process_ == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(exit_trouble);  // the parent ended before prctl()
    close(ends[0]);
    work_apart(ends[1], file_, work);
  }
  const int error = errno;
  close(ends[1]);
  if (process_ > 0) return;
  close(end_);
  throw RunError(fmt::format("{}: cannot be read: {}", file_, reason(error)));
}

Apart::~Apart()
{
  close(end_);
  if (process_ <= 0) return;
  kill(process_, SIGKILL);
  waitpid(process_, nullptr, 0);
}

const std::string& Apart::receive(const std::string& place)
{
  std::int32_t code = 0;
  std::uint64_t size = 0;
  std::string header(sizeof code + sizeof size, '\0');
  if (!pass_all(read, end_, header.data(), header.size())) explain_end(place);
  packing::unpack(header, code, size);
  message_.resize(size);
  if (!pass_all(read, end_, message_.data(), message_.size())) explain_end(place);
  if (code != 0) rethrow(code, message_);
  return message_;
}

void Apart::explain_end(const std::string& place)
{
  int status = 0;
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL)
    throw RunError(
        fmt::format("{}: the process that reads the file was killed; is memory short?", file_));
  throw FormatError(fmt::format("{}: reading {}; the file is damaged: copy it again", place,
                                how_it_ends(status)));
}

// Each each_of() lists all members: code with a new member does not compile until it is added here.
template <class Pass>
void each_of(Question& question, Pass& pass)
{
  auto& [what, option, reason] = question;
  pass(what, option, reason);
}

template <class Pass>
void each_of(ArchiveGrains& grains, Pass& pass)
{
  auto& [id, type, type_names, radius, mass, position, image, velocity, angular_velocity, force,
         fixed, missing, unwrapped] = grains;
  pass(id, type, type_names, radius, mass, position, image, velocity, angular_velocity, force,
       fixed, missing, unwrapped);
}

template <class Pass>
void each_of(ArchiveContacts& contacts, Pass& pass)
{
  auto& [i, j, wall, force, overlap, distance, branch, missing] = contacts;
  pass(i, j, wall, force, overlap, distance, branch, missing);
}

template <class Pass>
void each_of(ArchiveFrame& frame, Pass& pass)
{
  auto& [step, time, low, high, periodic, cell, grains, contacts, place, questions] = frame;
  pass(step, time, low, high, periodic, cell, grains, contacts, place, questions);
}

template <class Pass>
void each_of(ArchiveFacts& facts, Pass& pass)
{
  auto& [step, density, gravity, discs, walls, units, late, lists_all, detection, tolerance,
         reason] = facts;
  pass(step, density, gravity, discs, walls, units, late, lists_all, detection, tolerance, reason);
}

std::unique_ptr<Archive> open_apart(const std::string& file,
                                    const std::function<std::unique_ptr<Archive>()>& open)
{
#ifdef GRSEG_FUZZ
  return open();  // a fuzzer must see which code a file reaches
#else
  return std::make_unique<ApartArchive>(file, open);
#endif
}

}  // namespace grseg
