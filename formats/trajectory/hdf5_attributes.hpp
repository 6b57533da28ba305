// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/trajectory/hdf5.hpp"

#include <string>
#include <vector>

namespace grseg::hdf5 {

/// Writes an attribute of `object`. Throws RunError if the attribute cannot be written.
void write_attribute(hid_t object, const std::string& name, const std::string& text);
void write_attribute(hid_t object, const std::string& name, const std::vector<std::string>& texts);
void write_attribute(hid_t object, const std::string& name, const std::vector<int>& values);

/// The texts of an attribute, at most 3 of at most 64 bytes each; empty if the attribute is absent,
/// larger or of another kind.
std::vector<std::string> read_texts(hid_t object, const std::string& name);

/// Content of the attribute `name` of the object at `path`; empty if it is absent. Throws
/// FormatError, which names `file`, if it is of another kind or longer than 4096 entries.
std::vector<double> numbers_in_attribute(hid_t parent, const std::string& path,
                                         const std::string& name, const std::string& file);
std::string text_in_attribute(hid_t parent, const std::string& path, const std::string& name,
                              const std::string& file);

}  // namespace grseg::hdf5
