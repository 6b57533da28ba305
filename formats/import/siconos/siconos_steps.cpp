// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/siconos/siconos_steps.hpp"

#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace grseg {
namespace {

/// The first column of a table.
std::vector<double> times_of(hid_t file, const std::string& at, const std::string& path)
{
  const hdf5::CheckedDataset table(file, at, H5T_FLOAT, 2, path);
  table.require(1, 1, true);
  table.require(0, 1, true);
  const auto rows = table.dims()[0], columns = table.dims()[1];
  std::vector<float> values(rows * columns);
  table.read_all(H5T_NATIVE_FLOAT, values.data());
  std::vector<double> times;
  for (hsize_t k = 0; k < rows; ++k) times.push_back(static_cast<double>(values[k * columns]));
  return times;
}

}  // namespace

SiconosSteps read_siconos_steps(hid_t file, const std::string& path)
{
  const auto solved = times_of(file, "/data/solv", path);
  const double start = times_of(file, "/data/dynamic", path).front();
  const auto fail = [&path](std::size_t row, const std::string& why) {
    throw FormatError(fmt::format("{}: row {} of /data/solv {}", path, row, why));
  };
  // The first step is always written. Where the run was continued from another file, of which the
  // initial state is not there, the steps that were written tell.
  double rough = solved[0] - start;
  if (!(rough > 0) && solved.size() > 1) rough = solved[1] - solved[0];
  if (!(rough > 0) || !std::isfinite(rough))
    fail(0, "is not later than the initial state, so there is no step");
  const double steps = std::round((solved.back() - start) / rough);
  SiconosSteps found{solved[0], (solved.back() - start) / std::max(1.0, steps), 1};
  double before = start;
  for (std::size_t k = 0; k < solved.size(); ++k) {
    const double apart = (solved[k] - before) / found.length, whole = std::round(apart);
    if (whole < 1) fail(k, "is not later than the row before, so the times give no step");
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
