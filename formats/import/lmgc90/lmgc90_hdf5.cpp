// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/errors.hpp"
#include "formats/import/common/archive_files.hpp"
#include "formats/import/lmgc90/lmgc90.hpp"
#include "formats/trajectory/hdf5.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace grseg {
namespace {

using namespace hdf5;

/// A table with a row per body or pair. Columns count from 0.
struct Table {
  std::vector<double> values;
  hsize_t rows = 0, columns = 0;

  double at(hsize_t row, hsize_t column) const { return values[row * columns + column]; }
  std::int64_t whole(hsize_t row, hsize_t column) const { return std::llround(at(row, column)); }
  Vec3 vector(hsize_t row, hsize_t column, hsize_t size) const
  {
    return {at(row, column), at(row, column + 1), size == 3 ? at(row, column + 2) : 0};
  }
};

class Lmgc90Hdf5 {
 public:
  explicit Lmgc90Hdf5(const std::string& path) : path_(path), file_(open_for_reading(path))
  {
    d_ = number("/Simulation/dimension", H5T_INTEGER) == 3 ? 3 : 2;
    const bool is_new = exists(file_, "/Simulation/MecaIntegrator");  // from version 0.3 on
    constexpr double moreau = 1;
    if (number(is_new ? "/Simulation/MecaIntegrator" : "/Simulation/Integrator", H5T_INTEGER) !=
        moreau)
      fail("the integrator is not MOREAU: this is not a run of contact dynamics");
    theta_ = number(is_new ? "/Simulation/MecaIntegParam" : "/Simulation/Theta", H5T_FLOAT);
    if (theta_ < 0 || theta_ > 1) fail("theta of the integrator is not between 0 and 1");
    steps_ = names_in(file_, "/Evolution");
    std::sort(steps_.begin(), steps_.end(), natural_less);
  }

  std::vector<std::int64_t> numbers() const
  {
    std::vector<std::int64_t> numbers;
    for (const auto& step : steps_)
      numbers.push_back(std::llround(number("/Evolution/" + step + "/NStep", H5T_INTEGER)));
    return numbers;
  }

  Lmgc90Step read(std::size_t k) const
  {
    const auto group = "/Evolution/" + steps_[k];
    Lmgc90Step step{number(group + "/TPS", H5T_FLOAT),
                    number(group + "/dt", H5T_FLOAT),
                    theta_,
                    {},
                    {},
                    path_ + ": " + group};
    if (step.length <= 0) fail(group + "/dt is not positive");
    read_bodies(group + (d_ == 3 ? "/RBDY3" : "/RBDY2"), step);
    if (exists(file_, group + "/VlocRloc")) read_pairs(group + "/VlocRloc", step);
    return step;
  }

 private:
  double number(const std::string& at, H5T_class_t kind) const
  {
    double number = 0;
    CheckedDataset(file_, at, kind, 0, path_).read_all(H5T_NATIVE_DOUBLE, &number);
    if (!std::isfinite(number)) fail(at + " is not finite");
    return number;
  }

  Table table(const std::string& at, H5T_class_t kind, hsize_t columns) const
  {
    const CheckedDataset dataset(file_, at, kind, 2, path_);
    dataset.require(1, columns, true);
    dataset.require_possible(dataset.dims()[0]);
    Table table{{}, dataset.dims()[0], dataset.dims()[1]};
    table.values.resize(table.rows * table.columns);
    dataset.read_all(H5T_NATIVE_DOUBLE, table.values.data());
    for (const double value : table.values)
      if (!std::isfinite(value)) fail(at + " contains a number that is not finite");
    return table;
  }

  /// Tables idata and rdata of a group, which have as many rows.
  std::pair<Table, Table> tables(const std::string& group, hsize_t ids, hsize_t numbers) const
  {
    std::pair both{table(group + "/idata", H5T_INTEGER, ids),
                   table(group + "/rdata", H5T_FLOAT, numbers)};
    if (both.first.rows != both.second.rows) fail(group + " has idata and rdata of unequal length");
    return both;
  }

  /// rdata: X (3 columns, in 3D 6), V (likewise), in 3D the axes of inertia, in which V has the spin.
  void read_bodies(const std::string& group, Lmgc90Step& step) const
  {
    const auto [visible, now] = tables(group, 1, d_ == 3 ? 21 : 6);
    for (hsize_t b = 0; b < now.rows; ++b) {
      Vec3 spin(0, 0, d_ == 3 ? 0 : now.at(b, 5));
      for (hsize_t k = 0; d_ == 3 && k < 3; ++k)
        spin += now.at(b, 9 + k) * now.vector(b, 12 + 3 * k, 3);
      step.bodies.push_back(
          {now.vector(b, 0, d_), now.vector(b, 3 * d_ - 3, d_), spin, visible.at(b, 0) != 0});
    }
  }

  /// rdata: force along t, n (and s), velocity likewise, gap, point; then n in 2D, where
  /// t = (n_y, -n_x); t, n and s in 3D. The gap is expected at the next step if velocities stay.
  void read_pairs(const std::string& group, Lmgc90Step& step) const
  {
    const auto [ids, now] = tables(group, 14, d_ == 3 ? 19 : 9);
    for (hsize_t k = 0; k < ids.rows; ++k) {
      const Vec3 n = now.vector(k, d_ == 3 ? 13 : 7, d_);
      const Vec3 t = d_ == 3 ? now.vector(k, 10, 3) : Vec3(n.y(), -n.x(), 0);
      Vec3 force = now.at(k, 0) * t + now.at(k, 1) * n;
      if (d_ == 3) force += now.at(k, 2) * now.vector(k, 16, 3);
      const double gap = now.at(k, 2 * d_) - step.length * now.at(k, d_ + 1);
      step.pairs.push_back({ids.whole(k, 6), ids.whole(k, 7), ids.whole(k, 13), n, force, gap});
    }
  }

  [[noreturn]] void fail(const std::string& why) const { throw FormatError(path_ + ": " + why); }

  std::string path_;
  File file_;
  hsize_t d_ = 2;  // number of dimensions
  double theta_ = 0.5;
  std::vector<std::string> steps_;
};

}  // namespace

Lmgc90Steps open_lmgc90_hdf5(const std::string& path)
{
  const auto file = std::make_shared<const Lmgc90Hdf5>(path);
  return {file->numbers(), [file](std::size_t k) { return file->read(k); }};
}

}  // namespace grseg
