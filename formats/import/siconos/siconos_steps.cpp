// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/siconos/siconos_steps.hpp"

#include "formats/core/errors.hpp"
#include "formats/trajectory/hdf5.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

namespace grseg {

SiconosSteps read_siconos_steps(hid_t file, const std::string& path)
{
  const hdf5::CheckedDataset table(file, "/data/solv", H5T_FLOAT, 2, path);
  table.require(1, 1, true);
  table.require(0, 2, true);
  const auto rows = table.dims()[0], columns = table.dims()[1];
  std::vector<float> values(rows * columns);
  table.read_all(H5T_NATIVE_FLOAT, values.data());
  const auto time = [&](hsize_t k) { return static_cast<double>(values[k * columns]); };
  const SiconosSteps steps{time(0), (time(rows - 1) - time(0)) / static_cast<double>(rows - 1)};
  if (!(steps.length > 0) || !std::isfinite(steps.length))
    throw FormatError(
        fmt::format("{}: the times of /data/solv do not increase, so they give no step", path));
  for (hsize_t k = 0; k < rows; ++k) {
    const double expected = steps.first + static_cast<double>(k) * steps.length;
    if (!(std::abs(time(k) - expected) < 0.1 * steps.length + 2.4e-7 * std::abs(expected)))
      throw FormatError(fmt::format(
          "{}: row {} of /data/solv is not at a multiple of {:.6g} s: the steps are not all "
          "of the same length, so the impulses give no forces",
          path, k, steps.length));
  }
  return steps;
}

}  // namespace grseg
