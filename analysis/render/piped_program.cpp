// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/render/piped_program.hpp"

#include "formats/cli/interruption.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <thread>

namespace grseg {
namespace {

constexpr int patience = 50;  // time between checks for an interruption, ms

/// Starts the program words[0]; the file descriptors `input` and `errors` become its standard input and
/// error. Returns 0, or an error number as in errno.
int spawn(pid_t& process, std::vector<std::string> words, int input, int errors)
{
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&files, errors, STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
  sigset_t defaults;
  sigemptyset(&defaults);
  sigaddset(&defaults, SIGPIPE);
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (auto& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const int error =
      posix_spawn(&process, pointers[0], &files, &attributes, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  posix_spawnattr_destroy(&attributes);
  return error;
}

}  // namespace

std::optional<std::string> find_program(const std::string& name)
{
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const auto file = (std::filesystem::path(folder.empty() ? "." : folder) / name).string();
    std::error_code ignored;
    if (std::filesystem::is_regular_file(file, ignored) && access(file.c_str(), X_OK) == 0)
      return file;
  }
  return std::nullopt;
}

PipedProgram::PipedProgram(const std::string& path, const std::vector<std::string>& arguments)
    : errors_(std::tmpfile())
{
  if (!errors_) throw RunError(fmt::format("cannot make a temporary file: {}", reason(errno)));
  fcntl(fileno(errors_.get()), F_SETFD, FD_CLOEXEC);
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0)
    throw RunError(fmt::format("cannot make a pipe: {}", reason(errno)));
  // A write that cannot continue returns, so that an interruption is noticed while the program does not read.
  fcntl(ends[1], F_SETFL, O_NONBLOCK);
  std::signal(SIGPIPE, SIG_IGN);
  std::vector<std::string> words{path};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const int error = spawn(process_, words, ends[0], fileno(errors_.get()));
  close(ends[0]);
  pipe_ = ends[1];
  if (error == 0) return;
  close(pipe_);
  throw RunError(fmt::format("{}: cannot be started: {}", path, reason(error)));
}

PipedProgram::~PipedProgram()
{
  if (process_ < 0) return;
  kill(process_, SIGKILL);
  if (pipe_ >= 0) close(pipe_);
  ended(true);
}

bool PipedProgram::write(std::span<const std::uint8_t> bytes)
{
  while (!bytes.empty()) {
    const auto taken = ::write(pipe_, bytes.data(), bytes.size());
    if (taken >= 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(taken));
    } else if (errno == EAGAIN) {
      stop_if_interrupted();
      pollfd room{pipe_, POLLOUT, 0};
      poll(&room, 1, patience);
    } else if (errno != EINTR) {
      return false;
    }
  }
  return true;
}

std::optional<int> PipedProgram::ended(bool wait)
{
  int status = 0;
  pid_t process = 0;
  do process = waitpid(process_, &status, wait ? 0 : WNOHANG);
  while (process < 0 && errno == EINTR);
  if (process == 0) return std::nullopt;
  process_ = -1;
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

PipedProgram::End PipedProgram::finish()
{
  close(pipe_);
  pipe_ = -1;
  std::optional<int> code;
  while (!(code = ended(false))) {
    stop_if_interrupted();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  End end{*code, {}};
  std::rewind(errors_.get());
  char buffer[4096];
  for (std::size_t n = 0; (n = std::fread(buffer, 1, sizeof buffer, errors_.get())) > 0;)
    end.said.append(buffer, n);
  return end;
}

}  // namespace grseg
