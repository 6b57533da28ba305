// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/mercury/mercury_blocks.hpp"
#include "formats/import/mercury/mercury_restart.hpp"

#include <optional>
#include <string>
#include <vector>

/// Where the grains of a MercuryDPM run come from, moment by moment in order of time.
namespace grseg {

class MercuryGrainsSource {
 public:
  virtual ~MercuryGrainsSource() = default;
  /// Fills all of the next moment but its contacts; false at the end.
  virtual bool next(ArchiveMoment& moment) = 0;
  /// The .restart that says what is periodic; the one of the moment at hand where there are many.
  virtual const MercuryRestart* restart() const = 0;
};

/// Blocks of .data, beside one .restart or none. Row numbers name the grains; a program that inserts
/// grains appends rows, but one that removes a grain moves the last row to its place, so that rows
/// name no grain any more: this is refused where it shows.
class MercuryDataGrains : public MercuryGrainsSource {
 public:
  MercuryDataGrains(std::vector<std::string> files, std::string restart_path, bool info_is_species);
  bool next(ArchiveMoment& moment) override;
  const MercuryRestart* restart() const override { return restart_ ? &*restart_ : nullptr; }

 private:
  void require_rows_that_name_grains(const MercuryGrains& block) const;
  void add_restart_facts(const std::string& place, ArchiveGrains& grains) const;

  MercuryData data_;
  std::string restart_path_;
  std::optional<MercuryRestart> restart_;
  bool info_is_species_;
  std::vector<double> last_radius_;
};

/// A series of .restart files, each a moment with everything but, in versions 3 and 2, forces on
/// grains. Ids are those of the program, which it never uses twice.
class MercuryRestartGrains : public MercuryGrainsSource {
 public:
  explicit MercuryRestartGrains(std::vector<std::string> files);
  bool next(ArchiveMoment& moment) override;
  const MercuryRestart* restart() const override { return &restart_; }
  const std::string& path() const { return files_[at_ - 1]; }

 private:
  std::vector<std::string> files_;
  std::size_t at_ = 0;  // files handed out
  MercuryRestart restart_;
};

}  // namespace grseg
