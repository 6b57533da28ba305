// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace grseg {

/// The outcome of a check of a file (grseg-check) or of an import (grseg-import).
enum class Verdict {
  passed,
  failed,
  undecided,  // the file does not tell: chance alone, or what is missing, allows more than the tolerance
  waived,  // would have failed or be undecided, but the user accepts it (--accept-residual)
  skipped,
};

/// The word for it in reports.
constexpr const char* to_text(Verdict verdict)
{
  constexpr const char* words[] = {"passed", "failed", "undecided", "waived", "skipped"};
  return words[static_cast<int>(verdict)];
}

}  // namespace grseg
