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

/// Import by several processes (--part, --join). Each process writes a part: a trajectory of a
/// range of the archive's frames, with additional data for the final checks and the report. The
/// joined file equals the file of an import by one process, byte for byte.
namespace grseg {

/// Numbers that describe a frame for the checks: the residuals of the grains' force balances (their
/// late damping in the archive's units), and the sums that the checks accumulate, in SI.
struct FrameRecord {
  std::optional<Residual> residual;
  CheckNumbers numbers;
};

/// The observables of an imported run, and their values. A part has additional ones at the end.
std::vector<Observable> import_observables(bool of_part);
std::vector<double> import_values(const FrameRecord& record, bool of_part);

/// Position of a part in its archive.
struct PartPlace {
  OutputPart part;
  std::size_t begin = 0, end = 0, frames = 0;  // [begin, end) of the archive's `frames`

  /// Parameters of the part's file: this position, and the columns and remarks of the report.
  Parameters parameters(const ImportReport& report) const;
};

/// The file of a part, open for reading.
class ImportPart {
 public:
  /// Opens the file of a part. Throws UsageError with the remedy if it is missing.
  ImportPart(const std::string& output, const OutputPart& part);

  const TrajectoryReader& run() const { return run_; }
  const PartPlace& place() const { return place_; }
  FrameRecord record(std::size_t frame) const;
  /// Fills in the columns and remarks of the report, as they are at the end of this part.
  void add_to(ImportReport& report) const;
  /// Description of the whole run, without the parameters of the part.
  RunDescription description() const;
  /// Throws FormatError naming the file, the reason `why` and the remedy.
  [[noreturn]] void fail(const std::string& why) const;

 private:
  TrajectoryReader run_;
  PartPlace place_;
  std::vector<std::vector<double>> values_;  // values by frame, for each of import_observables()
};

}  // namespace grseg
