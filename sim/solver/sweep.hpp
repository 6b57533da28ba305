// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/contact/contact_blocks.hpp"

#include <span>
#include <string>
#include <vector>

/// Sweeps over blocks of contacts with vector instructions; each contact is relaxed as
/// contact_law.hpp defines. The instruction set is chosen when the program runs. All produce the
/// same bytes: products and sums are never fused, and sums over contacts are stored per lane of a
/// block and added in a fixed order.
namespace grseg {

/// Sums and maxima of one pass over all contacts.
struct SweepResult {
  double largest = 0;        // m/s, largest change of a relative velocity
  double sum_squares = 0;    // (m/s)^2, sum of the squared changes
  double sum_reference = 0;  // (m/s)^2, sum of (W p)^2
};

/// Members of SweepResult that a sweep computes: sum_squares only, or all.
enum class Measured { squares, all };

/// Function that relaxes all contacts once, block after block. Real is double or float.
template <int D, class Real>
using SweepOf = SweepResult (*)(const RunsOf<D, Real>&, MotionOf<D, Real>*, Real friction);
template <int D, class Real = double>
SweepOf<D, Real> choose_sweep(Effects effects, Measured measured = Measured::all);

/// Applies the impulses of the blocks to the bodies.
template <int D>
void apply_impulses(std::span<const ContactBlock<D>> blocks, Motion<D>* motion, Effects effects);

/// Instruction sets, out of avx512, avx2, sse4, sse2, neon and scalar, for which this build has
/// code and which this machine can execute; best first.
std::vector<std::string> instruction_sets();
/// Name of the instruction set in use.
std::string instruction_set();
/// Uses the instruction set `name` from now on, or the best one if it is "". Throws UsageError for
/// an unknown name. Must not be called while a sweep runs.
void use_instruction_set(const std::string& name);

}  // namespace grseg
