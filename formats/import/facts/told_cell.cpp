// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/facts/told_cell.hpp"

#include "formats/import/common/text_source.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <sstream>

namespace grseg {
namespace {

bool read(const std::string& text, double& number)
{
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, number);
  return error == std::errc() && end == last && std::isfinite(number);
}

ToldCell parse(const std::string& text)
{
  std::istringstream stream(text);
  std::vector<std::string> parts;
  for (std::string part; std::getline(stream, part, ':');) parts.push_back(part);
  ToldCell cell;
  cell.periodic = parts.size() == 4 && parts[3] == "periodic";
  const auto axis = parts.empty() || parts[0].size() != 1 ? std::string_view::npos
                                                          : std::string_view("xyz").find(parts[0]);
  if ((parts.size() != 3 && !cell.periodic) || axis == std::string_view::npos ||
      !read(parts[1], cell.low) || !read(parts[2], cell.high) || !(cell.low < cell.high))
    throw UsageError(fmt::format(
        "--cell {}: write AXIS:LOW:HIGH in the archive's axes and units, as in x:0:0.4, or "
        "x:0:0.4:periodic",
        in_quotes(text)));
  cell.axis = static_cast<int>(axis);
  return cell;
}

}  // namespace

std::string ToldCell::text() const
{
  return fmt::format("{}:{:.6g}:{:.6g}{}", "xyz"[axis], low, high, periodic ? ":periodic" : "");
}

std::vector<ToldCell> parse_cells(const std::vector<std::string>& texts)
{
  std::vector<ToldCell> cells;
  for (const auto& text : texts) {
    cells.push_back(parse(text));
    for (std::size_t k = 0; k + 1 < cells.size(); ++k)
      if (cells[k].axis == cells.back().axis)
        throw UsageError(fmt::format("--cell is given twice along {}", "xyz"[cells[k].axis]));
  }
  return cells;
}

void tell(const ToldCell& cell, ArchiveMoment& moment)
{
  const auto axis = static_cast<std::size_t>(cell.axis);
  const double low = moment.low[cell.axis], high = moment.high[cell.axis];
  const double digits = 1e-6 * (high - low);
  const bool differs =
      !cell.periodic || std::abs(cell.low - low) > digits || std::abs(cell.high - high) > digits;
  if (moment.periodic[axis] && differs)
    throw UsageError(fmt::format("--cell {}, but the archive says {}: leave the option out",
                                 cell.text(), ToldCell{cell.axis, low, high, true}.text()));
  moment.low[cell.axis] = cell.low;
  moment.high[cell.axis] = cell.high;
  moment.periodic[axis] = cell.periodic;
  moment.cell[axis] = CellSource::told;
}

}  // namespace grseg
