// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/convert/importer.hpp"
#include "formats/import/facts/import_settings.hpp"
#include "formats/import/verify/check_series.hpp"
#include "formats/import/verify/verification.hpp"
#include "formats/trajectory/reader.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

/// An import by several processes: each writes a part, a trajectory of the moments of its range that
/// also holds what the whole needs to know of each moment and of the archive. Joined, parts give the
/// bytes of an import by one process.
namespace grseg {

/// A moment's numbers beside its frame: its residual (the late damping in the archive's units), and
/// the memory of the checks, in SI.
struct MomentRecord {
  std::optional<Residual> residual;
  CheckMoment moment;
};

/// The observables of an imported run, and their values. A part has a few more behind them.
std::vector<Observable> import_observables(bool of_part);
std::vector<double> import_values(const MomentRecord& record, bool of_part);

/// Where a part stands in its archive.
struct PartPlace {
  OutputPart part;
  std::size_t begin = 0, end = 0, moments = 0;  // moments [begin, end) of `moments` in the archive

  /// Says it, and what of the report an import by one process says at its end.
  Parameters parameters(const ImportReport& report) const;
};

/// The file of a part, open.
class ImportPart {
 public:
  /// UsageError with the remedy where it is missing.
  ImportPart(const std::string& output, const OutputPart& part);

  const TrajectoryReader& run() const { return run_; }
  const PartPlace& place() const { return place_; }
  MomentRecord record(std::size_t frame) const;
  /// Fills in what the report of the whole import says at its end.
  void add_to(ImportReport& report) const;
  /// The description of the whole run.
  RunDescription description() const;
  /// FormatError naming the file and what to do.
  [[noreturn]] void fail(const std::string& why) const;

 private:
  TrajectoryReader run_;
  PartPlace place_;
  std::vector<std::vector<double>> values_;  // of import_observables()
};

}  // namespace grseg
