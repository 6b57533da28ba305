// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/siconos/siconos_steps.hpp"

#include "formats/core/errors.hpp"
#include "formats/import/siconos/siconos_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace grseg {
namespace {

using namespace siconos;

/// The first column of /data/solv.
std::vector<double> solved_times(hid_t file, const std::string& path)
{
  const auto table = table_at(file, "/data/solv", path, written_by);
  table.require(1, 1, true);
  table.require(0, 1, true);
  const auto rows = table.dims()[0], columns = table.dims()[1];
  std::vector<float> values(rows * columns);
  table.read_all(H5T_NATIVE_FLOAT, values.data());
  std::vector<double> times;
  for (hsize_t k = 0; k < rows; ++k) times.push_back(static_cast<double>(values[k * columns]));
  return times;
}

/// The first time of /data/dynamic.
double first_time(hid_t file, const std::string& path)
{
  const auto time = Places(file, "/data/dynamic", path, written_by).time();
  if (!time) throw FormatError(fmt::format("{}: /data/dynamic has no rows; {}", path, written_by));
  return *time;
}

std::string why_not_later(double time, double before)
{
  if (same_time(time, before))
    return "has the time of the row before it: single precision no longer separates two steps; write "
           "fewer of them (output_frequency)";
  return "is not later than the row before it: the file is damaged, or holds two runs";
}

}  // namespace

SiconosSteps read_siconos_steps(hid_t file, const std::string& path)
{
  const auto solved = solved_times(file, path);
  const double start = first_time(file, path);
  const auto fail = [&path](std::size_t row, const std::string& why) {
    throw FormatError(fmt::format("{}: row {} of /data/solv {}", path, row, why));
  };
  const bool has_start = start < solved[0] && !same_time(start, solved[0]);
  const std::size_t first = has_start ? 0 : 1;
  if (solved.size() <= first)
    fail(
        0,
        "is the only one, and no state before it is in the file: nothing tells how long a step is");
  double before = has_start ? start : solved[0];
  const double begin = before, rough = solved[first] - begin;
  if (!(rough > 0) || !std::isfinite(rough)) fail(first, why_not_later(solved[first], before));
  const double steps = std::round((solved.back() - begin) / rough);
  SiconosSteps found{(solved.back() - begin) / std::max(1.0, steps), 1, has_start};
  for (std::size_t k = first; k < solved.size(); ++k) {
    const double apart = (solved[k] - before) / found.length, whole = std::round(apart);
    if (whole < 1) fail(k, why_not_later(solved[k], before));
    if (!(std::abs(solved[k] - before - whole * found.length) <
          0.1 * found.length + 2.4e-7 * std::abs(solved[k])))
      fail(k, fmt::format(
                  "is not at a multiple of {:.6g} s: the steps are not all of the same length, "
                  "so the impulses give no forces",
                  found.length));
    found.every = std::max(found.every, static_cast<std::int64_t>(whole));
    before = solved[k];
  }
  return found;
}

}  // namespace grseg
