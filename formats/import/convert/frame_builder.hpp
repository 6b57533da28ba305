// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/import/convert/imported_bed.hpp"

#include <string>

namespace grseg {

/// Turns the moments of an archive into frames of a trajectory (formats/README.md), in the
/// archive's units. Every moment must have the grains of the first one. Grain i of a contact is
/// mobile; contacts between two boundary grains are left out; the order of contacts is kept.
class FrameBuilder {
 public:
  /// UsageError where the command line does not fit the grains, FormatError where they are
  /// impossible.
  FrameBuilder(const ArchiveMoment& first, const RunFacts& facts, const ImportSettings& settings);

  const ImportedBed& bed() const { return bed_; }

  /// FormatError naming the moment where grains or contacts are impossible.
  void build(const ArchiveMoment& moment, Frame<2>& frame) const;

 private:
  void require_numbers(const ArchiveMoment& moment, const Frame<2>& frame) const;
  void require_same_cell(const ArchiveMoment& moment) const;
  void place_grains(const ArchiveMoment& moment, Frame<2>& frame) const;
  void place(const ArchiveMoment& moment, std::size_t g, std::size_t row, Frame<2>& frame) const;
  void add_contacts(const ArchiveMoment& moment, ContactList<2>& contacts,
                    const Frame<2>& frame) const;
  void add_contact(const ArchiveMoment& moment, std::size_t c, const Frame<2>& frame,
                   ContactList<2>& contacts) const;
  std::size_t row_of(std::int64_t id, const ArchiveMoment& moment) const;

  ImportedBed bed_;
  double step_;
};

}  // namespace grseg
