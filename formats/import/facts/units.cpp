// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/facts/units.hpp"

#include "formats/core/errors.hpp"
#include "formats/import/common/text_values.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace grseg {
namespace {

template <class Values>
void multiply(Values& values, double factor)
{
  for (auto& value : values) value *= factor;
}

}  // namespace

void Units::convert(Frame<3>& frame) const
{
  frame.time *= time;
  multiply(frame.position, length);
  multiply(frame.velocity, velocity());
  multiply(frame.angular_velocity, 1 / time);
  multiply(frame.force, force());
  multiply(frame.contacts.force, force());
  multiply(frame.contacts.branch, length);
  multiply(frame.contacts.gap, length);
}

void Units::convert(Grains& grains) const
{
  multiply(grains.radius, length);
  multiply(grains.mass, mass);
}

Units parse_units(const std::string& text)
{
  if (const auto known = find_choice(text, unit_words)) return *known;
  const auto value = finite_numbers(text, ':');
  if (value.size() != 3 || !(*std::min_element(value.begin(), value.end()) > 0))
    throw UsageError(
        fmt::format("--units '{}' is not si, cgs, or LENGTH:TIME:MASS, the archive's units in m, s "
                    "and kg, as in 0.005:0.02259:2.5e-5",
                    text));
  return {value[0], value[1], value[2]};
}

}  // namespace grseg
