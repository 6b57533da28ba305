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

/// A species of mobile grains; its index in a SpeciesList is its number (Species).
struct SpeciesEntry {
  std::string name;
  double diameter = 0;  // nominal diameter, m; 0: unknown
};

/// The mobile species of a run or table in order of their diameters.
using SpeciesList = std::vector<SpeciesEntry>;

/// Size (bytes) of a species name in a file, padded with zero bytes (at least one).
inline constexpr std::size_t longest_species_name = 16;
inline constexpr const char* name_of_boundary = "boundary";

/// The species of most runs: "small" and "large".
SpeciesList two_sizes(double small_diameter, double large_diameter);

/// True if tables must name the species, because they are not just "small" and "large".
bool names_species(const SpeciesList& species);

/// Text of a species list, "small 0.005, large 0.01" (diameters in m), and its inverse, which
/// returns an empty list for any other text.
std::string species_text(const SpeciesList& species);
SpeciesList parse_species(const std::string& text);

/// Species names in column names: S and L if there are two species, otherwise their own names.
std::vector<std::string> column_words(const SpeciesList& species);

/// True for a name that files, command lines and column names can contain: 1 to 15 characters of
/// A-Z a-z 0-9 _ - . , and neither "boundary" nor "b", which mean the base.
bool is_species_name(const std::string& name);
inline constexpr const char* rule_of_species_names =
    "names have 1 to 15 of the characters A-Z a-z 0-9 _ - . and are neither boundary nor b";

/// Species number of each grain as files store it: boundary grains have the number `mobile`, the
/// count of mobile species.
std::vector<std::int32_t> species_numbers(const std::vector<Species>& species, std::size_t mobile);

/// The species that a file stores as `number`; inverse of species_numbers().
inline Species species_of_number(std::int32_t number, std::size_t mobile)
{
  return static_cast<std::size_t>(number) == mobile ? Species::boundary
                                                    : static_cast<Species>(number);
}

/// Rows of the two grains of a contact; j is empty at the base (boundary grains and walls).
/// partners() throws FormatError if the first grain is not mobile.
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

/// Pair type of a contact. Throws FormatError if the first grain of the contact is not mobile.
template <int D>
PairType pair_type(const Grains& grains, const Frame<D>& frame, std::size_t contact);

}  // namespace grseg
