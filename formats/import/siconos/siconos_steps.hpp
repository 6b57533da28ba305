// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/trajectory/hdf5.hpp"

#include <cstdint>
#include <string>

namespace grseg {

/// The steps of a Siconos run, all of one length.
struct SiconosSteps {
  double length = 0;       // in units of time
  std::int64_t every = 1;  // most steps between two that were written (output_frequency)
  bool has_start = true;   // the state before the first one is there
};

/// From the first time of /data/dynamic, which is before the first step, and /data/solv, which has a
/// row per step that was written: the first step, and then every output_frequency-th. Where the first
/// rows of a run were taken away, so that /data/dynamic does not begin before /data/solv, the first
/// two rows of /data/solv give the step. FormatError where the steps differ in length.
SiconosSteps read_siconos_steps(hid_t file, const std::string& path);

}  // namespace grseg
