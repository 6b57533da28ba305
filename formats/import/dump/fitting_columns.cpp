// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/dump/fitting_columns.hpp"

#include "formats/cli/interruption.hpp"
#include "formats/import/dump/contact_columns.hpp"
#include "formats/import/dump/dump_grains.hpp"
#include "formats/import/dump/dump_pair.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace grseg {
namespace {

constexpr std::size_t enough_grains =
    8;  // for an acceleration that they share by chance to be unlikely

/// A `share` of the values is smaller; `values` must not be empty.
double quantile(std::vector<double> values, double share)
{
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

double median(std::vector<double> values)
{
  return quantile(std::move(values), 0.5);
}

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

ContactBalance::ContactBalance(const ArchiveGrains& grains, const std::optional<Vec3>& gravity)
    : grains_(grains), gravity_(grains.mass.empty() ? std::nullopt : gravity)
{
  none_moves_ = std::all_of(grains.velocity.begin(), grains.velocity.end(),
                            [](const Vec3& velocity) { return velocity.isZero(0); });
  row_of_.reserve(grains.size());
  for (std::size_t g = 0; g < grains.size(); ++g) row_of_.emplace(grains.id[g], g);
}

std::optional<double> ContactBalance::residual(const ArchiveContacts& contacts) const
{
  if (grains_.force.empty()) return std::nullopt;
  auto left_over = grains_.force;
  std::vector<double> largest(grains_.size(), 0);
  const auto take_off = [&](std::int64_t id, const Vec3& force) {
    const auto row = row_of_.find(id);
    if (row == row_of_.end()) return false;
    left_over[row->second] -= force;
    largest[row->second] = std::max(largest[row->second], force.norm());
    return true;
  };
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const bool at_wall = !contacts.wall.empty() && contacts.wall[c] >= 0;
    if (!take_off(contacts.i[c], contacts.force[c])) return std::nullopt;
    if (!at_wall && !take_off(contacts.j[c], -contacts.force[c])) return std::nullopt;
  }

  std::vector<std::size_t> touched;
  std::vector<double> scale, missing;
  for (std::size_t g = 0; g < grains_.size(); ++g)
    if (largest[g] > 0 && moves(g)) touched.push_back(g), scale.push_back(largest[g]);
  if (touched.size() < (gravity_ ? 1 : enough_grains)) return std::nullopt;
  const Vec3 g = gravity_ ? *gravity_ : shared_acceleration(touched, left_over);
  missing.reserve(touched.size());
  for (const auto grain : touched) missing.push_back((left_over[grain] - weight(grain) * g).norm());
  const double ratio =
      quantile(std::move(missing), gravity_ ? 0.5 : 0.75) / median(std::move(scale));
  return std::isfinite(ratio) ? std::optional(ratio) : std::nullopt;
}

Vec3 ContactBalance::shared_acceleration(const std::vector<std::size_t>& touched,
                                         const std::vector<Vec3>& forces) const
{
  Vec3 shared;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::vector<double> accelerations;
    accelerations.reserve(touched.size());
    for (const auto grain : touched) accelerations.push_back(forces[grain][axis] / weight(grain));
    shared[axis] = median(std::move(accelerations));
  }
  return shared;
}

/// Grains of a base do not balance.
bool ContactBalance::moves(std::size_t grain) const
{
  return none_moves_ || !grains_.velocity[grain].isZero(0);
}

/// The mass, or what grows like it.
double ContactBalance::weight(std::size_t grain) const
{
  if (!grains_.mass.empty()) return grains_.mass[grain];
  return grains_.radius.empty() ? 1 : std::pow(grains_.radius[grain], 3);
}

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
