// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/provenance.hpp"
#include "formats/cli/table.hpp"
#include "formats/cli/tool.hpp"

#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// What grseg-derive makes of sums, as given on the command line.
struct DerivedOptions {
  std::string force = "modulus", average = "contacts", partition = "size", pool = "none", depth,
              heights;
  std::optional<double> begin = {}, end = {};  // s, of the windows

  /// Adds --force --average --partition --pool --depth --heights --begin --end.
  void add_to(po::options_description& options);
  /// UsageError where a word is unknown, before any table is read.
  void check() const;
};

/// The quantities that follow from tables of grseg-micro (derived_quantities.hpp), with `provenance` as
/// the first lines of its header and the settings of the first table behind it. UsageError where
/// options have no meaning or tables of different grains are given together; RunError where no row is
/// left.
Table derived_table(const std::vector<Table>& tables, const DerivedOptions& options,
                    const Header& provenance);

}  // namespace grseg
