// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/contact/contact_blocks.hpp"

#include <span>
#include <string>
#include <vector>

/// Sweeps over blocks of contacts with vector instructions; each contact is relaxed as
/// contact_law.hpp says. The instruction set is chosen when the program runs. All give the same
/// bytes: products and sums are never fused, and sums over contacts are kept per lane of a block
/// and added in one order.
namespace grseg {

/// Sums and maxima of one pass over all contacts.
struct SweepResult {
  double largest = 0;        // m/s
  double sum_squares = 0;    // (m/s)^2, of the changes
  double sum_reference = 0;  // (m/s)^2, of W p
};

/// Results of a sweep besides the relaxed contacts: only the sum of squares, or all of SweepResult.
enum class Measured { squares, all };

/// Relaxes all contacts once, block after block. Real is double or float.
template <class Real>
using SweepOf = SweepResult (*)(const RunsOf<Real>&, MotionOf<Real>*, Real friction);
template <class Real = double>
SweepOf<Real> choose_sweep(Effects effects, Measured measured = Measured::all);

/// Applies the impulses of the blocks to the bodies.
void apply_impulses(std::span<const ContactBlock> blocks, Motion* motion, Effects effects);

/// Instruction sets that both this build and this machine have, best first: of avx512,
/// avx2, sse4, sse2, neon and scalar.
std::vector<std::string> instruction_sets();
/// The one in use.
std::string instruction_set();
/// Uses the named one from now on, "" the best. Not to be called while a sweep runs.
void use_instruction_set(const std::string& name);

}  // namespace grseg
