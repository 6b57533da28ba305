// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/ptrace.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <optional>

namespace grseg {

/// How many instructions `work` takes, counted one by one in a copy of this process, so that they
/// are the same whatever else the machine does; with a few hundred more, always the same, for the
/// signals at both ends. Nothing where one process may not trace another.
template <class Work>
std::optional<long> instructions_of(const Work& work)
{
  const pid_t child = fork();
  if (child == 0) {
    if (ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) _exit(1);
    raise(SIGSTOP);
    work();
    raise(SIGUSR1);
    _exit(0);
  }
  int status = 0;
  long count = 0;
  waitpid(child, &status, 0);
  bool counting = WIFSTOPPED(status);
  while (counting) {
    ptrace(PTRACE_SINGLESTEP, child, nullptr, nullptr);
    waitpid(child, &status, 0);
    counting = WIFSTOPPED(status) && WSTOPSIG(status) == SIGTRAP;
    ++count;
  }
  const bool whole = WIFSTOPPED(status) && WSTOPSIG(status) == SIGUSR1;
  if (WIFSTOPPED(status)) {
    kill(child, SIGKILL);
    waitpid(child, &status, 0);
  }
  if (!whole) return {};
  return count;
}

}  // namespace grseg
