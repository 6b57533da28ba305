// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/coarse_graining.hpp"
#include "analysis/frames/composition.hpp"
#include "analysis/stress/partial_contact_stress.hpp"
#include "formats/cli/tool.hpp"
#include "formats/core/length.hpp"

#include <optional>
#include <string>

namespace grseg {

/// To which layer contacts and grains count, as given on the command line.
struct ContactAssignment {
  Assignment assignment;
  std::optional<KernelShape> shape;  // where the assignment is a kernel
  GrainArea area;
};

/// The options from which a ContactAssignment follows.
struct ContactAssignmentOptions {
  std::string assign = "contact-point", width = "1dS", composition;

  /// Adds --assign --kernel-width --composition.
  void add_to(po::options_description& options);
  /// UsageError for an unknown word, or a width without a kernel. Sets `composition` to what
  /// follows from `assign`, or to `otherwise`, where it was not given.
  ContactAssignment contact_assignment(const po::variables_map& values,
                                       const std::string& otherwise = "clipped");
  /// The kernel of `contact_assignment`, if it has one; UsageError where --kernel-width is not a length.
  std::optional<Kernel> kernel(const ContactAssignment& chosen, const LengthUnits& units) const;
};

}  // namespace grseg
