// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/render/colours.hpp"
#include "analysis/stress/partition_rule.hpp"
#include "formats/core/frame.hpp"
#include "formats/trajectory/reader.hpp"

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

/// Fields of --color: a field has a value for each mobile grain, which sets its colour.
namespace grseg {

/// Default range of values that a field's colour scale covers.
enum class FieldEnds {
  zero_to_most,  ///< 0 to the largest value, for fields that are never negative
  least_to_most,
  zero_to_one,
  both_signs,  ///< -x to x, symmetric about 0
};

enum class FieldKind {
  radius,
  speed,
  velocity,
  spin,
  pressure,
  contacts,
  composition,
  displacement,
  rise
};

struct FieldDefinition {
  FieldKind kind;
  const char* word;  // name after --color
  const char* meaning;
  FieldEnds ends;
  const char* title;  // title of the colour bar
  const char* unit;   // unit in two dimensions; "": dimensionless
  /// Data of a frame that the field needs; `force` includes how often grains have crossed the cell.
  TrajectoryReader::Fields needs;
  /// Argument after the word: "[:AXIS]" is optional, ":TIME" is required; "": no argument.
  const char* argument = "";

  bool needs_argument() const { return *argument == ':'; }
};

/// All fields, in the order of --help.
std::span<const FieldDefinition> field_definitions();
/// Words of all fields: with their meanings, as text for --help; and the words alone.
std::string list_of_fields();
std::vector<std::string> words_of_fields();

/// A field as the user typed it: "speed", "displacement:12.5". parse_field() throws UsageError, naming
/// --color, if the text is no field or has an argument that the field does not accept.
struct FieldChoice {
  const FieldDefinition* definition = nullptr;  // null: --color species
  std::string argument;

  bool is_species() const { return definition == nullptr; }
};
FieldChoice parse_field(const std::string& text);

/// Values of one field in the frames of one run.
template <int D>
class GrainField {
 public:
  /// `grains` and `species`: as group_grains() returns them (analysis/frames/grouping.hpp). `rule`
  /// shares mixed contacts in the field pressure. Throws UsageError if the argument is not a length, or
  /// not a time of the run, or if the field is displacement and the file, an import, does not store how
  /// often grains have crossed its periods. `grains` must outlive this object.
  GrainField(const FieldChoice& choice, const TrajectoryReader& run, const Grains& grains,
             const SpeciesList& species, const PartitionRule& rule);

  const FieldDefinition& definition() const { return *definition_; }
  /// Title of the colour bar: the quantity with its unit.
  const std::string& title() const { return title_; }
  /// Value for each grain; NaN for boundary grains and absent ones.
  std::vector<double> values(const Frame<D>& frame) const { return values_(frame); }

 private:
  const FieldDefinition* definition_;
  std::string title_;
  std::function<std::vector<double>(const Frame<D>&)> values_;
};

/// Share of species `of` in the area or volume of the mobile grains around each mobile grain i:
/// sum_of A_j w(r_ij)/sum A_j w(r_ij). The numerator sums over grains j of species `of`, the denominator
/// over all grains. A is a grain's area or volume, r the distance of centres (m), and w Lucy's function
/// (1 + 3u)(1 - u)^3 of u = r/radius, which is 0 for u >= 1. The sums include the grain itself and all
/// periodic images within `radius` (m), which is positive and no longer than a period. NaN for boundary
/// grains and absent ones.
template <int D>
std::vector<double> local_composition(const Grains& grains, const Frame<D>& frame, const Box& box,
                                      Species of, double radius);

/// Number of the frame nearest to `time` (s). Throws UsageError, naming `option`, if `time` lies outside of
/// the run by more than the time between frames.
std::size_t frame_nearest(const TrajectoryReader& run, double time, const std::string& option);

}  // namespace grseg
