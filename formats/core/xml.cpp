// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/xml.hpp"

namespace grseg {

std::string xml_escaped(const std::string& text)
{
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

}  // namespace grseg
