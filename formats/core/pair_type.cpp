// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/pair_type.hpp"

#include "formats/core/errors.hpp"

#include <fmt/format.h>

namespace grseg {

template <int D>
Partners partners(const Grains& grains, const Frame<D>& frame, std::size_t contact)
{
  const auto i = static_cast<std::size_t>(frame.contacts.i[contact]);
  const auto j = frame.contacts.j[contact];
  if (!is_mobile(grains, i))
    throw FormatError(
        fmt::format("contact {} of the frame at t = {:.6g} s names boundary grain {} first; "
                    "the first grain of a contact is a mobile one",
                    contact, frame.time, i));
  if (j < 0 || !is_mobile(grains, static_cast<std::size_t>(j))) return {i, std::nullopt};
  return {i, static_cast<std::size_t>(j)};
}

template <int D>
PairType pair_type(const Grains& grains, const Frame<D>& frame, std::size_t contact)
{
  const auto [i, j] = partners(grains, frame, contact);
  const bool large = grains.species[i] == Species::large;
  if (!j) return large ? PairType::Lb : PairType::Sb;
  const bool other_large = grains.species[*j] == Species::large;
  if (large != other_large) return PairType::LS;
  return large ? PairType::LL : PairType::SS;
}

template Partners partners(const Grains&, const Frame<2>&, std::size_t);
template Partners partners(const Grains&, const Frame<3>&, std::size_t);
template PairType pair_type(const Grains&, const Frame<2>&, std::size_t);
template PairType pair_type(const Grains&, const Frame<3>&, std::size_t);

}  // namespace grseg
