// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/trajectory/hdf5.hpp"
#include "formats/trajectory/run_description.hpp"
#include "formats/trajectory/writer.hpp"

#include <string>

namespace grseg {

/// Creates the trajectory file `path` (formats/README.md) with everything that a run holds once, no
/// frame, and a seal of zeros. RunError where it cannot be written.
void create_trajectory(const std::string& path, const RunDescription& run,
                       const StorageSettings& storage);

/// For files that are written `live`. A kill can cut a write at the end of a page of memory (4096
/// bytes). A header or a part of a chunk index that crosses one would then be half old and half new,
/// which HDF5 takes for damage, and all chunks that it lists would be lost, those of old frames too.
/// So all that is added to a file opened with this `access` begins with a page. After 8,180 chunks,
/// that is, frames, the parts of an index are longer than a page.
void keep_in_pages(hid_t access);

/// Writes one of /parameters into `file`, or replaces it. In a `live` file it must be there already,
/// with the same number of values. RunError where it cannot be written.
void write_parameter(hid_t file, const std::string& name, const std::vector<double>& values,
                     bool live);
void write_parameter(hid_t file, const std::string& name, const std::string& text);

}  // namespace grseg
