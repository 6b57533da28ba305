// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <hdf5.h>

#include <string>

namespace grseg {

/// The steps of a Siconos run, all of one length.
struct SiconosSteps {
  double first = 0;   // time of the first
  double length = 0;  // in units of time
};

/// From /data/solv, which has a row per step. FormatError where the steps differ in length.
SiconosSteps read_siconos_steps(hid_t file, const std::string& path);

}  // namespace grseg
