// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace grseg {

/// The text as it stands in XML, between tags or quotes.
std::string xml_escaped(const std::string& text);

}  // namespace grseg
