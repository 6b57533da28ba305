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

/// Fields: a number for each grain, which gives its colour. Boundary grains have none.
namespace grseg {

/// First and last number of a field's colours, by default.
enum class FieldEnds {
  zero_to_most,  ///< of fields that are never negative
  least_to_most,
  zero_to_one,
  both_signs,  ///< as far below 0 as above
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
  const char* word;  // as typed
  const char* meaning;
  FieldEnds ends;
  const char* title;  // beside the colour bar
  const char* unit;   // in two dimensions; "": a number
  /// Parts of a frame that the field needs; `force` includes how often grains have crossed the cell.
  TrajectoryReader::Fields needs;
  /// Argument after the word: "[:AXIS]" may be given, ":TIME" must be; "": none.
  const char* argument = "";

  bool needs_argument() const { return *argument == ':'; }
};

/// All fields, in the order of --help.
std::span<const FieldDefinition> field_definitions();
/// The words with their meanings, for --help; and the words alone.
std::string list_of_fields();
std::vector<std::string> words_of_fields();

/// A field as typed: "speed", "displacement:12.5". UsageError, naming --color, where it is none, or
/// has an argument that it does not take.
struct FieldChoice {
  const FieldDefinition* definition = nullptr;  // null: --color species
  std::string argument;

  bool is_species() const { return definition == nullptr; }
};
FieldChoice parse_field(const std::string& text);

/// The numbers of one field for the frames of one run.
template <int D>
class GrainField {
 public:
  /// `grains` and `species` as told apart (analysis/frames/grouping.hpp); `rule` shares out the
  /// mixed contacts of pressure. UsageError where the argument is not a length, or not a time of the
  /// run, and where displacements are asked for of an import that does not know how often grains have
  /// crossed its periods. `grains` must outlive this.
  GrainField(const FieldChoice& choice, const TrajectoryReader& run, const Grains& grains,
             const SpeciesList& species, const PartitionRule& rule);

  const FieldDefinition& definition() const { return *definition_; }
  /// Title of the colour bar: the quantity with its unit.
  const std::string& title() const { return title_; }
  /// A number for each grain; NaN for boundary grains and absent ones.
  std::vector<double> values(const Frame<D>& frame) const { return values_(frame); }

 private:
  const FieldDefinition* definition_;
  std::string title_;
  std::function<std::vector<double>(const Frame<D>&)> values_;
};

/// Share of species `of` in the area or volume of the mobile grains around each mobile grain:
/// sum_of A_j w(r_ij)/sum A_j w(r_ij), where A is a grain's area or volume, r the distance of
/// centres (m), and w Lucy's function (1 + 3u)(1 - u)^3 of u = r/radius, 0 from u = 1 on. The sums include
/// the grain itself and all images within the radius, which is positive and no longer than a period.
/// NaN for boundary grains and absent ones.
template <int D>
std::vector<double> local_composition(const Grains& grains, const Frame<D>& frame, const Box& box,
                                      Species of, double radius);

/// Number of the frame nearest to `time` (s). UsageError naming `option` where `time` lies outside of the
/// run by more than the time between frames.
std::size_t frame_nearest(const TrajectoryReader& run, double time, const std::string& option);

}  // namespace grseg
