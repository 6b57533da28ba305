// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/dump/fitting_columns.hpp"

#include "formats/cli/interruption.hpp"
#include "formats/import/dump/contact_balance.hpp"
#include "formats/import/dump/contact_columns.hpp"
#include "formats/import/dump/dump_grains.hpp"
#include "formats/import/dump/dump_pair.hpp"

#include <numeric>

namespace grseg {
namespace {

ArchiveGrains read_grains(DumpPair& dumps)
{
  ArchiveGrains grains;
  DumpGrains().read(dumps.grains(), grains);
  return grains;
}

/// One moment, with all columns of its contacts.
class ColumnTrial {
 public:
  ColumnTrial(DumpPair& dumps, const DumpDialect& dialect, const std::optional<Vec3>& gravity)
      : dialect_(dialect),
        header_(dumps.contacts().header()),
        grains_(read_grains(dumps)),
        balance_(grains_, gravity)
  {
    std::vector<std::size_t> all(header_.columns.size());
    std::iota(all.begin(), all.end(), 0);
    dumps.contacts().read_rows(all, rows_);
  }

  /// Nothing where a column cannot have the meaning that `columns` gives it, or where forces do not
  /// tell.
  std::optional<double> residual(const std::string& columns)
  {
    try {
      ContactColumns map(dialect_.mapping(columns, header_));
      map.look_up(header_.columns, header_.place);
      std::vector<std::vector<double>> values;
      for (const auto column : map.wanted()) values.push_back(rows_[column]);
      map.fill(values, header_.place, contacts_);
    } catch (const Interruption&) {
      throw;
    } catch (const ToolError&) {
      return std::nullopt;
    }
    return balance_.residual(contacts_);
  }
  std::vector<std::string> others() const { return dialect_.others(header_); }

 private:
  const DumpDialect& dialect_;
  DumpHeader header_;
  ArchiveGrains grains_;
  std::vector<std::vector<double>> rows_;
  ArchiveContacts contacts_;
  ContactBalance balance_;
};

}  // namespace

std::optional<ColumnFit> fitting_columns(const std::vector<std::string>& grain_files,
                                         const std::vector<std::string>& contact_files,
                                         const DumpDialect& dialect, const std::string& in_use,
                                         const std::optional<Vec3>& gravity)
{
  constexpr double digits = 1e-6;                // of texts: by less, none is better than another
  constexpr std::size_t rows_at_most = 100'000;  // a second or two
  DumpPair dumps(grain_files, contact_files);
  for (std::size_t rows = 0; rows < rows_at_most && dumps.next();) {
    if (dumps.contacts().header().rows == 0) continue;
    ColumnTrial trial(dumps, dialect, gravity);
    rows += dumps.contacts().header().rows;
    const double tolerance = dialect.facts.tolerance;
    if (!in_use.empty() && trial.residual(in_use).value_or(INFINITY) <= tolerance) break;
    std::optional<ColumnFit> best;
    for (const auto& columns : trial.others()) {
      const auto residual = trial.residual(columns);
      if (residual && *residual < (best ? best->residual - digits : tolerance))
        best = ColumnFit{columns, *residual};
    }
    if (best) return best;
  }
  return std::nullopt;
}

}  // namespace grseg
