// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/trajectory/hdf5_failure.hpp"

#include "formats/core/files.hpp"
#include "formats/trajectory/hdf5.hpp"

#include <cstdio>
#include <cstring>

namespace grseg::hdf5 {
namespace {

/// The library passes an errno on only as part of a text.
herr_t find_errno(unsigned, const H5E_error2_t* entry, void* found)
{
  const char* place = entry->desc == nullptr ? nullptr : std::strstr(entry->desc, "errno = ");
  int error = 0;
  if (place != nullptr && std::sscanf(place, "errno = %d", &error) == 1 && error != 0)
    *static_cast<int*>(found) = error;
  return 0;
}

}  // namespace

std::string reason_of_failure()
{
  int error = 0;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, find_errno, &error);
  return error != 0 ? reason(error) : "the HDF5 library does not say why";
}

}  // namespace grseg::hdf5
