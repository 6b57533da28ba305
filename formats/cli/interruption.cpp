// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/interruption.hpp"

#include <csignal>

namespace grseg {
namespace {

volatile std::sig_atomic_t stop_signal = 0;

void remember_signal(int signal)
{
  stop_signal = signal;
}

}  // namespace

void listen_to_signals()
{
  stop_signal = 0;
  std::signal(SIGINT, remember_signal);
  std::signal(SIGTERM, remember_signal);
  for (const int signal : {SIGHUP, SIGUSR1, SIGUSR2, SIGXCPU})
    if (std::signal(signal, remember_signal) == SIG_IGN) std::signal(signal, SIG_IGN);
}

bool interrupted()
{
  return stop_signal != 0;
}

Interruption interruption(const std::string& sentence)
{
  return {static_cast<ExitCode>(exit_signal + stop_signal), sentence};
}

void stop_if_interrupted()
{
  if (interrupted()) throw interruption("interrupted; nothing is written");
}

}  // namespace grseg
