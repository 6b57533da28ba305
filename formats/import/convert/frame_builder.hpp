// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/import/convert/imported_bed.hpp"

#include <string>

namespace grseg {

/// Turns the moments of an archive into frames of a trajectory (formats/README.md), in the
/// archive's units. Every moment must have all grains, unless they come and go: then those that a
/// moment does not have are absent in its frame. Grain i of a contact is mobile; contacts between two boundary grains are left out; the order of contacts is kept.
class FrameBuilder {
 public:
  /// UsageError where the command line does not fit the grains, FormatError where they are
  /// impossible.
  FrameBuilder(const ArchiveMoment& all, const RunFacts& facts, const ImportSettings& settings,
               bool grains_come_and_go = false);

  const ImportedBed& bed() const { return bed_; }
  /// Whether images of frames are those of the archive. Where it does not tell how often grains have
  /// crossed a period, images are 0 for positions within the cell.
  bool counts_periods() const { return counts_periods_; }

  /// D is the dimension of the bed's box. FormatError naming the moment where grains or contacts are
  /// impossible, or lack components in three dimensions; OtherGrains where a moment has not all
  /// grains, or others.
  template <int D>
  void build(const ArchiveMoment& moment, Frame<D>& frame) const;

 private:
  template <int D>
  void require_numbers(const ArchiveMoment& moment, const Frame<D>& frame) const;
  void require_same_cell(const ArchiveMoment& moment) const;
  void require_all_components(const ArchiveMoment& moment) const;
  template <int D>
  void place_grains(const ArchiveMoment& moment, Frame<D>& frame) const;
  template <int D>
  void place(const ArchiveMoment& moment, std::size_t g, std::size_t row, Frame<D>& frame) const;
  template <int D>
  void add_contacts(const ArchiveMoment& moment, ContactList<D>& contacts,
                    const Frame<D>& frame) const;
  template <int D>
  void add_contact(const ArchiveMoment& moment, std::size_t c, const Frame<D>& frame,
                   ContactList<D>& contacts) const;
  template <int D>
  std::size_t row_of(std::int64_t id, const ArchiveMoment& moment, const Frame<D>& frame) const;

  ImportedBed bed_;
  double step_;
  bool has_force_, counts_periods_, grains_come_and_go_;
};

}  // namespace grseg
