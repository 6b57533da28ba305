// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/render/grain_field.hpp"

#include "analysis/frames/contacts.hpp"
#include "analysis/frames/sums.hpp"
#include "analysis/render/local_composition.hpp"
#include "analysis/stress/partition_rule.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/length.hpp"
#include "formats/core/species.hpp"
#include "formats/core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace grseg {
namespace {

constexpr TrajectoryReader::Fields velocity{.velocity = true, .contacts = false, .force = false};
constexpr TrajectoryReader::Fields contacts{.velocity = false, .contacts = true, .force = false};
constexpr TrajectoryReader::Fields image{.velocity = false, .contacts = false, .force = true};

/// The fields. To add one: a FieldKind, a row here, and its number.
constexpr FieldDefinition definitions[] = {
    {.kind = FieldKind::radius,
     .word = "radius",
     .meaning = "radius of the grain",
     .ends = FieldEnds::least_to_most,
     .title = "radius",
     .unit_2d = "m",
     .unit_3d = "m"},
    {.kind = FieldKind::speed,
     .word = "speed",
     .meaning = "modulus of the velocity",
     .ends = FieldEnds::zero_to_most,
     .title = "speed",
     .unit_2d = "m/s",
     .unit_3d = "m/s",
     .needs = velocity},
    {.kind = FieldKind::velocity,
     .word = "velocity",
     .meaning = "component of the velocity: x (default), y or z",
     .ends = FieldEnds::both_signs,
     .title = "velocity along",
     .unit_2d = "m/s",
     .unit_3d = "m/s",
     .needs = velocity,
     .argument = "AXIS"},
    {.kind = FieldKind::spin,
     .word = "spin",
     .meaning = "angular velocity about z, counter-clockwise",
     .ends = FieldEnds::both_signs,
     .title = "spin",
     .unit_2d = "rad/s",
     .unit_3d = "rad/s",
     .needs = velocity},
    {.kind = FieldKind::pressure,
     .word = "pressure",
     .meaning = "the grain's share of trace(force x branch)/D summed over its contacts, over its "
                "area or volume; mixed contacts by --partition",
     .ends = FieldEnds::zero_to_most,
     .title = "pressure",
     .unit_2d = "N/m",
     .unit_3d = "Pa",
     .needs = contacts},
    {.kind = FieldKind::contacts,
     .word = "contacts",
     .meaning = "number of its contacts that bear a force",
     .ends = FieldEnds::zero_to_most,
     .title = "contacts",
     .unit_2d = "",
     .unit_3d = "",
     .needs = contacts},
    {.kind = FieldKind::composition,
     .word = "composition",
     .meaning = "share of the largest species in the grains around, weighed by Lucy's function of "
                "radius LENGTH (default: 2dL)",
     .ends = FieldEnds::zero_to_one,
     .title = "share of",
     .unit_2d = "",
     .unit_3d = "",
     .argument = "LENGTH"},
    {.kind = FieldKind::displacement,
     .word = "displacement",
     .meaning = "distance from where the grain was at TIME (s)",
     .ends = FieldEnds::zero_to_most,
     .title = "displacement since t =",
     .unit_2d = "m",
     .unit_3d = "m",
     .needs = image,
     .argument = "TIME",
     .needs_argument = true},
    {.kind = FieldKind::rise,
     .word = "rise",
     .meaning = "y minus what it was at TIME (s)",
     .ends = FieldEnds::both_signs,
     .title = "rise since t =",
     .unit_2d = "m",
     .unit_3d = "m",
     .argument = "TIME",
     .needs_argument = true},
};

constexpr const char* species_word = "species";

/// Of an import, which may lack them (formats/README.md).
void require_images(const TrajectoryReader& run, const std::string& time)
{
  const auto& told = run.parameters();
  const bool periodic = run.box().periodic_x || run.box().periodic_z;
  if (!periodic || told.text("import_format").empty() || told.text("import_images") == "known")
    return;
  throw UsageError(fmt::format(
      "--color displacement:{0}: {1} does not tell how often grains have crossed its "
      "periods; import the run again, from a dump with the columns ix iy iz or xu yu zu, or "
      "choose rise:{0}",
      time, run.path()));
}

Eigen::Index axis_of(const std::string& text, int dimension)
{
  if (text.empty() || text == "x") return 0;
  if (text == "y") return 1;
  if (text == "z" && dimension == 3) return 2;
  throw UsageError(fmt::format("--color velocity:{}: the components of this run are {}", text,
                               dimension == 3 ? "x, y and z" : "x and y"));
}

}  // namespace

std::span<const FieldDefinition> field_definitions()
{
  return definitions;
}

std::string list_of_fields()
{
  std::string text = fmt::format("{}: the species of each grain", species_word);
  for (const auto& field : definitions) {
    const bool takes_one = *field.argument != '\0';
    text += fmt::format("\n{}{}{}{}: {}", field.word, takes_one && !field.needs_argument ? "[" : "",
                        takes_one ? fmt::format(":{}", field.argument) : "",
                        takes_one && !field.needs_argument ? "]" : "", field.meaning);
  }
  return text;
}

std::vector<std::string> words_of_fields()
{
  std::vector<std::string> words{species_word};
  for (const auto& field : definitions) words.emplace_back(field.word);
  return words;
}

FieldChoice parse_field(const std::string& text)
{
  const auto colon = text.find(':');
  const std::string word = text.substr(0, colon);
  const std::string argument = colon == std::string::npos ? "" : text.substr(colon + 1);
  if (text == species_word) return {};
  for (const auto& field : definitions) {
    if (word == field.word) {
      if (*field.argument == '\0' && colon != std::string::npos)
        throw UsageError(fmt::format("--color {}: nothing follows {}", text, word));
      if (field.needs_argument && argument.empty())
        throw UsageError(fmt::format("--color {}: say since when, as in {}:0", text, word));
      return {&field, argument};
    }
  }
  throw UsageError(unknown_word("--color", word, words_of_fields()));
}

std::size_t frame_nearest(const TrajectoryReader& run, double time, const std::string& asked)
{
  const auto& times = run.times();
  if (times.empty()) throw RunError(fmt::format("{}: the run has no frames", run.path()));
  const double length = times.back() - times.front();
  const double between =
      times.size() > 1 ? length / static_cast<double>(times.size() - 1) : run.step();
  if (!(time >= times.front() - between && time <= times.back() + between))
    throw UsageError(fmt::format("{}: {} goes from {:.6g} s to {:.6g} s", asked, run.path(),
                                 times.front(), times.back()));
  const auto after = std::lower_bound(times.begin(), times.end(), time);
  if (after == times.begin()) return 0;
  const auto number = static_cast<std::size_t>(after - times.begin());
  if (after == times.end() || time - *(after - 1) <= *after - time) return number - 1;
  return number;
}

template <int D>
GrainField<D>::GrainField(const FieldChoice& choice, const TrajectoryReader& run,
                          const Grains& grains, const SpeciesList& species,
                          const PartitionRule& rule)
    : definition_(choice.definition),
      grains_(grains),
      box_(run.box()),
      rule_(rule),
      largest_(static_cast<Species>(species.size() - 1)),
      title_(definition_->title)
{
  const LengthUnits units{run.small_diameter(), run.large_diameter()};
  switch (definition_->kind) {
    case FieldKind::velocity:
      axis_ = axis_of(choice.argument, D);
      title_ += fmt::format(" {}", "xyz"[axis_]);
      break;
    case FieldKind::pressure:
      title_ += fmt::format(" (rule: {})", rule_.name());
      break;
    case FieldKind::composition: {
      const auto length = choice.argument.empty() ? std::string("2dL") : choice.argument;
      radius_ = parse_length(length, "--color composition:", units);
      if (!(radius_ > 0)) throw UsageError("--color composition: its radius must be positive");
      require_within_periods(length);
      title_ += fmt::format(" {} within {}", species.back().name, length);
      break;
    }
    case FieldKind::displacement:
      require_images(run, choice.argument);
      begin_at(choice.argument, run);
      break;
    case FieldKind::rise:
      begin_at(choice.argument, run);
      break;
    default:
      break;
  }
  const std::string unit = D == 3 ? definition_->unit_3d : definition_->unit_2d;
  if (!unit.empty()) title_ += fmt::format(", {}", unit);
}

/// Each grain then has one image at most beyond each end of a period.
template <int D>
void GrainField<D>::require_within_periods(const std::string& length) const
{
  const auto require = [&](bool periodic, double period, char axis) {
    if (periodic && radius_ > period * (1 + 1e-9))  // 35dL may be a little more than 0.35 m
      throw UsageError(fmt::format(
          "--color composition:{}: {:.4g} m is longer than the period along {}, which is {:.4g} m",
          length, radius_, axis, period));
  };
  require(box_.periodic_x, box_.length_x, 'x');
  require(D == 3 && box_.periodic_z, box_.length_z, 'z');
}

template <int D>
void GrainField<D>::begin_at(const std::string& time, const TrajectoryReader& run)
{
  const auto asked = fmt::format("--color {}:{}", definition_->word, time);
  const auto number = parse_number(time);
  if (!number) throw UsageError(fmt::format("{}: '{}' is not a time", asked, time));
  const auto index = frame_nearest(run, *number, asked);
  Frame<D> frame;
  run.read(index, frame, definition_->needs);
  for (std::size_t g = 0; g < grains_.size(); ++g) origin_.push_back(place(frame, g));
  title_ += fmt::format(" {} s", time);
}

/// Where the grain is, counting the periods that it has crossed. Rises need not know them.
template <int D>
Vector<D> GrainField<D>::place(const Frame<D>& frame, std::size_t grain) const
{
  Vector<D> place = frame.position[grain];
  if (frame.image.empty()) return place;
  place.x() += box_.length_x * frame.image[grain][0];
  if constexpr (D == 3) place.z() += box_.length_z * frame.image[grain][2];
  return place;
}

template <int D>
double GrainField<D>::number(const Frame<D>& frame, std::size_t grain) const
{
  switch (definition_->kind) {
    case FieldKind::radius:
      return grains_.radius[grain];
    case FieldKind::speed:
      return frame.velocity[grain].norm();
    case FieldKind::velocity:
      return frame.velocity[grain][axis_];
    case FieldKind::spin:
      if constexpr (D == 2)
        return frame.angular_velocity[grain];
      else
        return frame.angular_velocity[grain].z();
    case FieldKind::displacement:
      return (place(frame, grain) - origin_[grain]).norm();
    case FieldKind::rise:
      return frame.position[grain].y() - origin_[grain].y();
    default:
      return no_number;
  }
}

template <int D>
std::vector<double> GrainField<D>::pressures(const Frame<D>& frame) const
{
  std::vector<double> sums(grains_.size());
  const auto& list = frame.contacts;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const double trace = list.force[k].dot(list.branch[k]);
    const auto [i, j] = partners(grains_, frame, k);
    const auto shares = contact_shares(grains_, frame, k, rule_);
    sums[i] += shares.i * trace;
    if (j) sums[*j] += shares.j * trace;
  }
  for (std::size_t g = 0; g < sums.size(); ++g) sums[g] /= D * grain_volume<D>(grains_.radius[g]);
  return sums;
}

template <int D>
std::vector<double> GrainField<D>::contact_numbers(const Frame<D>& frame) const
{
  std::vector<double> numbers(grains_.size());
  for (std::size_t k = 0; k < frame.contacts.size(); ++k) {
    if (!bears_force(frame.contacts, k)) continue;
    const auto [i, j] = partners(grains_, frame, k);
    numbers[i] += 1;
    if (j) numbers[*j] += 1;
  }
  return numbers;
}

template <int D>
std::vector<double> GrainField<D>::values(const Frame<D>& frame) const
{
  const auto kind = definition_->kind;
  std::vector<double> all(grains_.size(), no_number);
  if (kind == FieldKind::composition)
    return local_composition<D>(grains_, frame, box_, largest_, radius_);
  if (kind == FieldKind::pressure) all = pressures(frame);
  if (kind == FieldKind::contacts) all = contact_numbers(frame);
  const bool summed = kind == FieldKind::pressure || kind == FieldKind::contacts;
  for (std::size_t g = 0; g < all.size(); ++g) {
    if (!is_mobile(grains_, frame, g))
      all[g] = no_number;
    else if (!summed)
      all[g] = number(frame, g);
  }
  return all;
}

template class GrainField<2>;
template class GrainField<3>;

}  // namespace grseg
