// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/ptrace.h>
#include <sys/types.h>
#include <sys/user.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <optional>

namespace grseg {

/// Next instruction of a stopped copy of this process, whose code has the same addresses as here.
/// Null on processors whose instructions adds_or_multiplies() cannot read.
inline const std::uint8_t* next_instruction(pid_t copy)
{
#ifdef __x86_64__
  user_regs_struct registers{};
  ptrace(PTRACE_GETREGS, copy, nullptr, &registers);
  return reinterpret_cast<const std::uint8_t*>(registers.rip);
#else
  static_cast<void>(copy);
  return nullptr;
#endif
}

/// True if an instruction of x86-64 adds, subtracts or multiplies floating-point numbers. Its opcode
/// is then 58, 5C or 59 (hexadecimal) of the map 0F, behind the prefixes of SSE, AVX or AVX-512
/// (Intel's manual, volume 2, 2.1 to 2.7).
inline bool adds_or_multiplies(const std::uint8_t* code)
{
  if (code[0] == 0xC5) {
    code += 2;
  } else if (code[0] == 0xC4 && (code[1] & 0x1F) == 1) {
    code += 3;
  } else if (code[0] == 0x62 && (code[1] & 0x07) == 1) {
    code += 4;
  } else {
    while (*code == 0x66 || *code == 0xF2 || *code == 0xF3) ++code;
    if ((*code & 0xF0) == 0x40) ++code;
    if (*code++ != 0x0F) return false;
  }
  return *code == 0x58 || *code == 0x59 || *code == 0x5C;
}

struct Instructions {
  long all = 0;
  long arithmetic = 0;  // additions, subtractions and multiplications of floating-point numbers
};

/// Number of instructions that `work` executes, counted one by one in a copy of this process, so that the
/// number does not depend on the load of the machine. It includes a constant few hundred for the signals at
/// both ends. Nothing if a process may not trace another one, or if next_instruction() is not available.
template <class Work>
std::optional<Instructions> instructions_of(const Work& work)
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
  Instructions count;
  waitpid(child, &status, 0);
  bool counting = WIFSTOPPED(status);
  while (counting) {
    const auto* next = next_instruction(child);
    if (next == nullptr) break;
    ++count.all;
    if (adds_or_multiplies(next)) ++count.arithmetic;
    ptrace(PTRACE_SINGLESTEP, child, nullptr, nullptr);
    waitpid(child, &status, 0);
    counting = WIFSTOPPED(status) && WSTOPSIG(status) == SIGTRAP;
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
