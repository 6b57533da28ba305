// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/errors.hpp"

#include <string>

namespace grseg {

/// The reason to stop is a signal; the exit code tells which.
struct Interruption : ToolError {
  using ToolError::ToolError;
};

/// From here on SIGINT and SIGTERM are remembered, rather than end the program at once.
void listen_to_signals();

/// One of them came since.
bool interrupted();

/// What is thrown then; the sentence tells what is left of the work.
Interruption interruption(const std::string& sentence);

/// Throws it where a program may stop without harm: what it had begun to write goes.
void stop_if_interrupted();

}  // namespace grseg
