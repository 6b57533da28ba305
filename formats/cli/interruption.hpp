// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/errors.hpp"

#include <string>

namespace grseg {

/// Thrown when a signal stops the program; the exit code is 128 plus the number of the signal.
struct Interruption : ToolError {
  using ToolError::ToolError;
};

/// From this call on, signals that ask a program to end are recorded instead of ending it at once:
/// SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2 and SIGXCPU. The last four stay ignored if they were
/// ignored before, as nohup does.
void listen_to_signals();

/// True once a signal has arrived.
bool interrupted();

/// Exception to throw after a signal; `sentence` reports which output remains.
Interruption interruption(const std::string& sentence);

/// Throws an Interruption if a signal has arrived. Call it only where stopping is safe and
/// unfinished output is removed.
void stop_if_interrupted();

}  // namespace grseg
