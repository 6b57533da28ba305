// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/errors.hpp"

#include <string>

namespace grseg {

/// Thrown where a signal stops the program; the exit code is that of the signal.
struct Interruption : ToolError {
  using ToolError::ToolError;
};

/// From here on SIGINT and SIGTERM are remembered instead of ending the program at once.
void listen_to_signals();

/// Whether one of them has arrived since.
bool interrupted();

/// What to throw then; the sentence says what is kept of the work.
Interruption interruption(const std::string& sentence);

/// Throws it if interrupted; for places where stopping is safe and unfinished output is removed.
void stop_if_interrupted();

}  // namespace grseg
