// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/text.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstddef>
#include <limits>

namespace grseg {
namespace {

/// Length (bytes) of the first character of `text`; 0 for invalid UTF-8 and control characters.
std::size_t character_size(std::string_view text)
{
  const auto byte = [text](std::size_t k) {
    return k < text.size() ? static_cast<unsigned char>(text[k]) : 0u;
  };
  const unsigned first = byte(0);
  if (first < 0x80) return first >= 0x20 && first != 0x7f ? 1 : 0;
  if (first < 0xc2 || first > 0xf4) return 0;
  const std::size_t size = first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
  unsigned code = first & (0xffu >> (size + 1));
  for (std::size_t k = 1; k < size; ++k) {
    if ((byte(k) & 0xc0u) != 0x80u) return 0;
    code = code << 6u | (byte(k) & 0x3fu);
  }
  const unsigned least = size == 2 ? 0xa0 : size == 3 ? 0x800 : 0x10000;  // < 0xa0: controls
  const bool surrogate = code >= 0xd800 && code < 0xe000;
  return code >= least && code <= 0x10ffff && !surrogate ? size : 0;
}

}  // namespace

std::string printable(std::string_view text)
{
  std::string safe;
  safe.reserve(text.size());
  while (!text.empty()) {
    const auto size = character_size(text);
    if (size == 0)
      safe += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[0]));
    else
      safe += text.substr(0, size);
    text.remove_prefix(size == 0 ? 1 : size);
  }
  return safe;
}

std::string printable_lines(std::string_view text)
{
  std::string safe;
  for (auto end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
    safe += printable(text.substr(0, end)) + '\n';
    text.remove_prefix(end + 1);
  }
  return safe + printable(text);
}

std::string excerpt(std::string_view text)
{
  constexpr std::size_t enough = 60;
  return text.size() <= enough ? printable(text) : printable(text.substr(0, enough)) + "...";
}

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

std::optional<double> parse_number(std::string_view text)
{
  using Limits = std::numeric_limits<double>;
  if (text == "nan") return Limits::quiet_NaN();
  if (text == "inf") return Limits::infinity();
  if (text == "-inf") return -Limits::infinity();
  // Without this check from_chars would accept other spellings of NaN and infinity.
  if (text.find_first_not_of("+-.0123456789eE") != std::string_view::npos) return {};
  double number = 0;
  const auto* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stop != end) return {};
  return number;
}

}  // namespace grseg
