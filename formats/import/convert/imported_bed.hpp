// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/import/convert/rows_by_id.hpp"
#include "formats/import/facts/run_facts.hpp"

#include <string>

namespace grseg {

/// What all frames of an imported run share: its grains, cell and axes, found from the first moment
/// of the archive, in the archive's units. Rows are grains by increasing id.
struct ImportedBed {
  /// UsageError where the command line does not fit the grains, FormatError where the grains are
  /// impossible.
  ImportedBed(const ArchiveMoment& first, const RunFacts& facts, const ImportSettings& settings);

  bool is_boundary(std::size_t row) const { return grains.species[row] == Species::boundary; }

  Axes axes;
  Grains grains;
  Box box;
  SpeciesFound species;
  RowsById rows;
  double shift_x = 0;  // to be added to x in the plane of the flow
  double origin = 0;   // height in the archive that is y = 0

 private:
  void make_grains(const ArchiveMoment& first, const RunFacts& facts,
                   const SpeciesSettings& settings);
  void make_box(const ArchiveMoment& first);
  void find_origin(const ArchiveMoment& first, const std::string& text);
  void require_a_plane(const ArchiveMoment& first) const;
};

}  // namespace grseg
