// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/errors.hpp"

#include <string>

namespace grseg {

/// Thrown where a signal stops the program; the exit code is 128 plus its number.
struct Interruption : ToolError {
  using ToolError::ToolError;
};

/// From this call on, signals that ask a program to end are remembered instead of ending it at
/// once: SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2 and SIGXCPU. Where the last four are ignored, as
/// by nohup, they stay so.
void listen_to_signals();

/// True once a signal has arrived.
bool interrupted();

/// Exception to throw after a signal; the sentence says which part of the work is kept.
Interruption interruption(const std::string& sentence);

/// Throws it if interrupted; for places where stopping is safe and unfinished output is removed.
void stop_if_interrupted();

}  // namespace grseg
