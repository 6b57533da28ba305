// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/import/common/archive.hpp"

#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// Question about the columns of a table that no reader uses and whose meaning is not known; empty
/// if there are none. Throws FormatError if a name is of another shape than disc and sphere, such as
/// shapex or quat1. The user leaves a column out by --map NAME=.
std::optional<Question> question_of_columns(const std::vector<std::string>& unused,
                                            const std::string& place);

/// The names that --map leaves out: "a" and "b" of "a=,b=". Throws UsageError for other parts.
std::vector<std::string> left_out(const std::vector<std::string>& map);

}  // namespace grseg
