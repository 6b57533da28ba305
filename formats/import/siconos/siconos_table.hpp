// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/errors.hpp"
#include "formats/import/common/archive.hpp"
#include "formats/trajectory/hdf5.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

/// Readers for the tables of a Siconos run: single precision, a row per body or contact; column 0
/// is the time. Columns as in siconos 4.4 (mechanics_run.py).
namespace grseg::siconos {

constexpr const char* written_by = "was it written by siconos.io.mechanics_run?";

/// True if two times are equal to within two units in the last place of single precision.
inline bool same_time(double a, double b)
{
  return std::abs(a - b) <= 2.4e-7 * std::max(std::abs(a), std::abs(b));
}

/// Opens a table. Throws FormatError if it is missing (with `remedy`), or too large for the file.
inline hdf5::CheckedDataset table_at(hid_t file, const std::string& at, const std::string& path,
                                     const char* remedy)
{
  if (!hdf5::exists(file, at))
    throw FormatError(fmt::format("{}: {} is missing; {}", path, at, remedy));
  hdf5::CheckedDataset table(file, at, H5T_FLOAT, 2, path);
  table.require_possible(table.dims()[0]);
  return table;
}

/// Reads a table whose first column is the time, in the order of its rows.
template <std::size_t columns>
class TableInTime {
 public:
  using Row = std::array<float, columns>;

  TableInTime(hid_t file, const std::string& at, const std::string& path, const char* remedy)
      : path_(path)
  {
    table_ = table_at(file, at, path, remedy);
    table_.require(1, columns);
  }

  /// Time of the next row; empty at the end.
  std::optional<double> time()
  {
    if (at_ == block_.size() && !fill()) return {};
    return static_cast<double>(block_[at_][0]);
  }

  /// Reads the rows at `time` and skips earlier rows. Returns the number of the first row read.
  hsize_t rows_of(double time, std::vector<Row>& rows)
  {
    rows.clear();
    hsize_t first = 0;
    for (auto t = this->time(); t && (*t < time || same_time(*t, time)); t = this->time()) {
      if (same_time(*t, time)) {
        if (rows.empty()) first = number_of_next();
        rows.push_back(block_[at_]);
      }
      ++at_;
    }
    return first;
  }

 private:
  static constexpr hsize_t block_rows = 4096;

  hsize_t number_of_next() const { return done_ - block_.size() + at_; }

  /// Reads the next block of rows. Skips rows of zeros at its start: Siconos leaves them if it made
  /// a table longer than needed.
  bool fill()
  {
    do {
      const auto count = std::min(block_rows, table_.dims()[0] - done_);
      if (count == 0) return false;
      block_.resize(count);
      table_.read_rows(H5T_NATIVE_FLOAT, done_, count, block_.data());
      done_ += count;
      at_ = 0;
      for (; at_ < block_.size(); ++at_) {
        check(block_[at_]);
        if (block_[at_] != Row{}) break;
      }
    } while (at_ == block_.size());
    for (auto k = at_ + 1; k < block_.size(); ++k) check(block_[k]);
    return true;
  }

  void check(const Row& row)
  {
    const auto fail = [this, &row](const char* why) {
      const auto number = done_ - block_.size() + static_cast<hsize_t>(&row - block_.data());
      throw FormatError(fmt::format("{}: row {} of {} {}", path_, number, table_.path(), why));
    };
    for (const float value : row)
      if (!std::isfinite(value)) fail("contains a value that is not finite");
    if (row == Row{}) return;
    if (static_cast<double>(row[0]) < latest_ && !same_time(static_cast<double>(row[0]), latest_))
      fail("is earlier than the previous row; the file is damaged");
    latest_ = static_cast<double>(row[0]);
  }

  std::string path_;
  hdf5::CheckedDataset table_;
  std::vector<Row> block_;
  std::size_t at_ = 0;
  hsize_t done_ = 0;
  double latest_ = -HUGE_VAL;
};

// The names in the comments are the columns.
using Places = TableInTime<9>;      // time id x y z q0 q1 q2 q3
using Velocities = TableInTime<8>;  // time id vx vy vz wx wy wz
using Points = TableInTime<26>;     // time mu A[3] B[3] n[3] impulse[3] gap[3] u[3] r[3] id ds1 ds2

template <class Row>
Vec3 vector_at(const Row& row, std::size_t column)
{
  return {static_cast<double>(row[column]), static_cast<double>(row[column + 1]),
          static_cast<double>(row[column + 2])};
}

template <class Row>
std::int64_t id_at(const Row& row, std::size_t column)
{
  return std::llround(row[column]);
}

constexpr std::size_t second_point_at = 5, normal_at = 8, impulse_at = 11, gap_at = 14;
constexpr std::size_t velocity_at = 17, reaction_at = 20, interaction_at = 23;
constexpr std::size_t first_at = 24, second_at = 25;

}  // namespace grseg::siconos
