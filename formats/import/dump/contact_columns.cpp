// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/dump/contact_columns.hpp"

#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <cmath>

namespace grseg {
namespace {

const ColumnWords& contact_words()
{
  static const ColumnWords words{
      "--columns",
      "i=2,j=3,force=5",
      {"i", "j", "fx", "fy", "fz", "tx", "ty", "tz", "bx", "by", "bz", "dist", "overlap", "wall"},
      {{"force", 2}, {"tangential", 5}}};
  return words;
}

}  // namespace

ContactColumns::ContactColumns(const std::string& text) : map_(contact_words(), text)
{
  require_sense();
}

void ContactColumns::require_sense() const
{
  const bool has_force = has(fx) || has(fy) || has(fz);
  if (!has(i) || !has(j) || !has_force)
    throw UsageError(fmt::format(
        "--columns '{}' does not name the columns of i, j and a force, as in i=2,j=3,force=5",
        map_.text()));
  if (has(dist) && has(overlap))
    throw UsageError("--columns: dist and overlap both give the overlap; leave one out");
  if (has(wall) && !(has(bx) || has(by) || has(bz)))
    throw UsageError("--columns: wall needs the branch bx by bz to the contact point");
}

void ContactColumns::fill(const std::vector<std::vector<double>>& values, const std::string& place,
                          ArchiveContacts& contacts) const
{
  const auto of = [&](std::size_t meaning) -> const std::vector<double>& {
    return map_.of(meaning, values);
  };
  const auto ids = [&](Meaning meaning, std::vector<std::int64_t>& out) {
    out.clear();
    for (const double id : of(meaning)) {
      if (!(std::abs(id) < 9e15) || std::trunc(id) != id)
        throw FormatError(
            fmt::format("{}: {:g} in the column of {} is not an id of a grain; say "
                        "what the columns mean with --columns",
                        place, id, contact_words().words[meaning]));
      out.push_back(static_cast<std::int64_t>(id));
    }
  };
  const auto add = [&](Meaning x, std::vector<Vec3>& out) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto& column = of(x + axis);
      for (std::size_t c = 0; c < column.size(); ++c)
        out[c][static_cast<Eigen::Index>(axis)] += column[c];
    }
  };
  ids(i, contacts.i);
  ids(j, contacts.j);
  // To -0 everything adds without loss, the sign of 0 included.
  contacts.force.assign(contacts.size(), Vec3::Constant(-0.0));
  add(fx, contacts.force);
  add(tx, contacts.force);
  contacts.branch.assign(has(bx) || has(by) || has(bz) ? contacts.size() : 0, Vec3::Constant(-0.0));
  add(bx, contacts.branch);
  contacts.missing.clear();
  const auto& words = contact_words().words;
  for (const auto x : {fx, tx, bx})
    add_missing({has(x), has(x + 1), has(x + 2)}, {words[x], words[x + 1], words[x + 2]},
                contacts.missing);
  contacts.overlap = of(overlap);
  contacts.distance = of(dist);
  contacts.wall.clear();
  for (const double number : of(wall)) {
    if (!(std::abs(number) < 1e9) || std::trunc(number) != number)
      throw FormatError(
          fmt::format("{}: {:g} in the column of wall is not a number of a wall", place, number));
    contacts.wall.push_back(number < 0 ? -1 : static_cast<std::int32_t>(number));
  }
}

}  // namespace grseg
