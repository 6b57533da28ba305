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

/// A number for each grain, to colour it by. Boundary grains have none.
namespace grseg {

/// How the colours of a field begin and end where nobody says so.
enum class FieldEnds {
  zero_to_most,  ///< what is never negative
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
  /// What must be read: `force` stands for how often grains have crossed the cell.
  TrajectoryReader::Fields needs;
  /// What may follow the word behind a colon, "[:AXIS]", or must, ":TIME"; "": nothing.
  const char* argument = "";

  bool needs_argument() const { return *argument == ':'; }
};

/// All fields, in the order of --help.
std::span<const FieldDefinition> field_definitions();
/// What each means, for --help; and the words alone.
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
  /// For the colour bar: what it is, with its unit.
  const std::string& title() const { return title_; }
  /// A number for each grain; NaN for boundary grains and those that are absent.
  std::vector<double> values(const Frame<D>& frame) const { return values_(frame); }

 private:
  const FieldDefinition* definition_;
  std::string title_;
  std::function<std::vector<double>(const Frame<D>&)> values_;
};

/// The share of the grains of species `of` in the area or volume of mobile grains about each mobile
/// grain: sum_of A_j w(r_ij)/sum A_j w(r_ij), where A is a grain's area or volume, r the distance of
/// centres (m), and w Lucy's function (1 + 3u)(1 - u)^3 of u = r/radius, 0 from u = 1 on. The grain
/// itself is among them, and so are all images within the radius, which is positive and no longer than
/// a period. NaN for boundary grains and those that are absent.
template <int D>
std::vector<double> local_composition(const Grains& grains, const Frame<D>& frame, const Box& box,
                                      Species of, double radius);

/// The number of the frame whose time is nearest to `time` (s). UsageError naming `option` where
/// that is farther away than the run's frames are from each other.
std::size_t frame_nearest(const TrajectoryReader& run, double time, const std::string& option);

}  // namespace grseg
