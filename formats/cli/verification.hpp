// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/provenance.hpp"
#include "formats/cli/tool.hpp"
#include "formats/trajectory/reader.hpp"

namespace grseg {

/// --trust of every tool that reads runs.
struct TrustOption {
  bool trust = false;

  void add_to(po::options_description& options);
  Verify verify() const { return trust ? Verify::no : Verify::yes; }
};

/// The header lines of what was made of `run`: `verified`, what of it was compared with digests,
/// `incomplete` where the run had not ended, and of an import `undecided` and `waived`.
Header verification_lines(const TrajectoryReader& run);

}  // namespace grseg
