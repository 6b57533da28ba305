// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace grseg {

/// A species of mobile grains; its place in a list is its number (Species).
struct SpeciesEntry {
  std::string name;
  double diameter = 0;  // nominal, m; 0: unknown
};

/// The mobile species of a run or table in order of their diameters.
using SpeciesList = std::vector<SpeciesEntry>;

/// Bytes of a name in a file.
inline constexpr std::size_t longest_species_name = 16;
inline constexpr const char* name_of_boundary = "boundary";

/// The species of most runs: "small" and "large".
SpeciesList two_sizes(double small_diameter, double large_diameter);

/// True where tables must name the species because they are not just small and large.
bool names_species(const SpeciesList& species);

/// "small 0.005, large 0.01", and the list that such a text stands for; empty for any other text.
std::string species_text(const SpeciesList& species);
SpeciesList parse_species(const std::string& text);

/// The names of species in columns: S and L where there are two, otherwise their own.
std::vector<std::string> column_words(const SpeciesList& species);

/// True for a name that can stand in files, command lines and names of columns: 1 to 15 of A-Z a-z
/// 0-9 _ - ., and neither "boundary" nor "b", which stand for the base.
bool is_species_name(const std::string& name);
inline constexpr const char* rule_of_species_names =
    "names have 1 to 15 of the characters A-Z a-z 0-9 _ - . and are neither boundary nor b";

/// Species as files number them: rows of a list in which the boundary grains come last.
std::vector<std::int32_t> species_numbers(const std::vector<Species>& species, std::size_t mobile);

/// The species of the number `number` in such a list.
inline Species species_of_number(std::int32_t number, std::size_t mobile)
{
  return static_cast<std::size_t>(number) == mobile ? Species::boundary
                                                    : static_cast<Species>(number);
}

/// The rows of the grains of a contact; no second one at the base (boundary grains and walls).
/// FormatError where the first is not mobile.
struct Partners {
  std::size_t i;
  std::optional<std::size_t> j;
};
template <int D>
Partners partners(const Grains& grains, const Frame<D>& frame, std::size_t contact);

/// Kinds of contacts in a mixture of two species: two small grains, a large and a small one, two
/// large ones, or a small or large grain and the base (boundary grains and straight walls).
enum class PairType { SS, LS, LL, Sb, Lb };
constexpr std::size_t pair_types = 5;
constexpr std::array<const char*, pair_types> pair_type_names{"SS", "LS", "LL", "Sb", "Lb"};

/// FormatError where the first grain of the contact is not mobile.
template <int D>
PairType pair_type(const Grains& grains, const Frame<D>& frame, std::size_t contact);

}  // namespace grseg
