// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/coarse_graining.hpp"
#include "analysis/composition.hpp"
#include "analysis/partial_contact_stress.hpp"
#include "formats/length.hpp"
#include "formats/tool.hpp"

#include <optional>
#include <string>

namespace grseg {

/// Where contacts and grains count, as the command line says it.
struct Booking {
  Assignment assignment;
  std::optional<KernelShape> shape;  // where the assignment is a kernel
  GrainArea area;
};

/// The options from which a Booking follows.
struct BookingOptions {
  std::string assign = "contact-point", width = "1dS", composition;

  /// Adds --assign --width --composition.
  void add_to(po::options_description& options);
  /// UsageError where a word is none of those known, or a width is given without a kernel. Sets
  /// `composition` to what follows from `assign` where it was not given.
  Booking booking(const po::variables_map& values);
  /// The kernel of `booking`, if it has one; UsageError where --width is no length.
  std::optional<Kernel> kernel(const Booking& booking, const LengthUnits& units) const;
};

}  // namespace grseg
