// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/csv/csv_comments.hpp"

#include "formats/import/common/number_row.hpp"

#include <fmt/format.h>

#include <cmath>
#include <sstream>

namespace grseg {
namespace {

/// NaN where the next word is not a number.
double next_number(std::istream& text)
{
  std::string word;
  double number = NAN;
  return text >> word && read_number(word, number) ? number : NAN;
}

bool read_period(std::istream& text, CsvComments& found)
{
  std::string axis;
  text >> axis;
  const double low = next_number(text), high = next_number(text);
  const auto k = std::string_view("xyz").find(axis);
  if (axis.size() != 1 || k == std::string_view::npos || !(low < high)) return false;
  found.periodic[k] = true;
  found.low[static_cast<Eigen::Index>(k)] = low;
  found.high[static_cast<Eigen::Index>(k)] = high;
  return true;
}

bool read_gravity(std::istream& text, CsvComments& found)
{
  Vec3 gravity;
  for (double& component : gravity) component = next_number(text);
  found.facts.gravity = gravity;
  return gravity.allFinite();
}

bool read_step(std::istream& text, CsvComments& found)
{
  const double step = next_number(text);
  found.facts.step = step;
  return step > 0;
}

bool read_units(std::istream& text, CsvComments& found)
{
  std::string units;
  text >> units;
  found.facts.units = units;
  return units == "si" || units == "cgs" || units == "lj";
}

bool read_grains(std::istream& text, CsvComments& found)
{
  std::string grains;
  text >> grains;
  found.facts.discs = grains == "discs";
  return grains == "discs" || grains == "spheres";
}

struct Line {
  std::string_view word;
  bool (*read)(std::istream&, CsvComments&);
  const char* form;
};

constexpr Line lines[] = {{"# periodic:", read_period, "# periodic: x 0 0.35"},
                          {"# gravity:", read_gravity, "# gravity: 3.83 -9.02 0"},
                          {"# step:", read_step, "# step: 1e-5"},
                          {"# units:", read_units, "# units: si"},
                          {"# grains:", read_grains, "# grains: spheres"}};

}  // namespace

CsvComments read_csv_comments(const std::vector<std::string>& comments)
{
  CsvComments found;
  for (const auto& comment : comments)
    for (const auto& [word, read, form] : lines) {
      if (!comment.starts_with(word)) continue;
      std::istringstream text(comment.substr(word.size()));
      std::string more;
      if (!read(text, found) || text >> more)
        throw FormatError(fmt::format("{} is not of the form '{}'", in_quotes(comment), form));
    }
  return found;
}

}  // namespace grseg
