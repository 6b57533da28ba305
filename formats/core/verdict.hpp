// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace grseg {

/// The outcome of a check of a file (grseg-check) or of an import (grseg-import).
enum class Verdict {
  passed,
  failed,
  undecided,  // scatter or missing data alone allow a deviation beyond the tolerance
  waived,     // failed or undecided, but accepted by the user (--accept-residual)
  skipped,
};

/// The word for a verdict in reports.
constexpr const char* to_text(Verdict verdict)
{
  constexpr const char* words[] = {"passed", "failed", "undecided", "waived", "skipped"};
  return words[static_cast<int>(verdict)];
}

}  // namespace grseg
