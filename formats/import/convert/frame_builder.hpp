// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/import/convert/run_facts.hpp"

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace grseg {

/// Rows of the trajectory by ids of the archive.
class RowsById {
 public:
  RowsById() = default;
  explicit RowsById(const std::vector<std::int64_t>& sorted_ids);
  /// -1: there is no such grain.
  std::int32_t find(std::int64_t id) const;

 private:
  std::int64_t first_ = 0;
  std::vector<std::int32_t> dense_;  // where ids are close together
  std::unordered_map<std::int64_t, std::int32_t> sparse_;
};

/// Makes frames of a trajectory (formats/README.md) out of an archive's moments, in the archive's
/// units. Rows are grains by increasing id, those of the first moment; every moment must have the
/// same. Of a contact i is mobile, between two boundary grains it is left out; order of rows stays.
class FrameBuilder {
 public:
  /// UsageError where the command line does not fit the grains, FormatError where they cannot be.
  FrameBuilder(const ArchiveMoment& first, const RunFacts& facts, const ImportSettings& settings);

  const Grains& grains() const { return grains_; }
  const Box& box() const { return box_; }
  const SpeciesFound& species() const { return species_; }
  double origin() const { return origin_; }  // height in the archive that is y = 0

  /// FormatError naming the moment where grains or contacts cannot be.
  void build(const ArchiveMoment& moment, Frame& frame) const;

 private:
  void make_grains(const ArchiveMoment& first, const RunFacts& facts,
                   const SpeciesSettings& settings);
  void make_box(const ArchiveMoment& first);
  void find_origin(const ArchiveMoment& first, const std::string& text);
  void require_a_plane(const ArchiveMoment& first) const;
  void require_numbers(const ArchiveMoment& moment, const Frame& frame) const;
  void require_same_cell(const ArchiveMoment& moment) const;
  void place_grains(const ArchiveMoment& moment, Frame& frame) const;
  void place(const ArchiveMoment& moment, std::size_t g, std::size_t row, Frame& frame) const;
  void add_contacts(const ArchiveMoment& moment, ContactList& contacts, const Frame& frame) const;
  void add_contact(const ArchiveMoment& moment, std::size_t c, const Frame& frame,
                   ContactList& contacts) const;
  std::size_t row_of(std::int64_t id, const ArchiveMoment& moment) const;
  bool is_boundary(std::size_t row) const { return grains_.species[row] == Species::boundary; }

  Axes axes_;
  double step_;
  Grains grains_;
  Box box_;
  SpeciesFound species_;
  RowsById rows_;
  double shift_x_ = 0, origin_ = 0;
};

}  // namespace grseg
