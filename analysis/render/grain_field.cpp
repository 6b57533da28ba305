// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/render/grain_field.hpp"

#include "analysis/frames/contacts.hpp"
#include "analysis/frames/sums.hpp"
#include "analysis/stress/partition_rule.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/length.hpp"
#include "formats/core/species.hpp"
#include "formats/core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace grseg {
namespace {

constexpr TrajectoryReader::Fields nothing{.velocity = false, .contacts = false, .force = false};
constexpr TrajectoryReader::Fields velocity{.velocity = true, .contacts = false, .force = false};
constexpr TrajectoryReader::Fields contacts{.velocity = false, .contacts = true, .force = false};
constexpr TrajectoryReader::Fields image{.velocity = false, .contacts = false, .force = true};

/// All fields. A new field needs a FieldKind, a row here, and a function for its values.
constexpr FieldDefinition definitions[] = {
    {FieldKind::radius, "radius", "radius of the grain", FieldEnds::least_to_most, "radius", "m",
     nothing},
    {FieldKind::speed, "speed", "magnitude of the velocity", FieldEnds::zero_to_most, "speed",
     "m/s", velocity},
    {FieldKind::velocity, "velocity", "component of the velocity: x (default), y or z",
     FieldEnds::both_signs, "velocity along", "m/s", velocity, "[:AXIS]"},
    {FieldKind::spin, "spin", "angular velocity about z, counter-clockwise", FieldEnds::both_signs,
     "spin", "rad/s", velocity},
    {FieldKind::pressure, "pressure",
     "sum over the grain's contacts of its share of trace(force x branch)/D, divided by its area or "
     "volume; --partition sets the share in mixed contacts",
     FieldEnds::zero_to_most, "pressure", "N/m", contacts},
    {FieldKind::contacts, "contacts", "number of the grain's contacts with a force",
     FieldEnds::zero_to_most, "contacts", "", contacts},
    {FieldKind::composition, "composition",
     "share of the largest species among the grains within LENGTH (default: 2dL), weighted by area "
     "or volume and by Lucy's function",
     FieldEnds::zero_to_one, "share of", "", nothing, "[:LENGTH]"},
    {FieldKind::displacement, "displacement", "distance of the grain from its position at TIME (s)",
     FieldEnds::zero_to_most, "displacement since t =", "m", image, ":TIME"},
    {FieldKind::rise, "rise", "change of the grain's y since TIME (s)", FieldEnds::both_signs,
     "rise since t =", "m", nothing, ":TIME"},
};

constexpr const char* species_word = "species";

/// Throws UsageError if the run does not store how often grains have crossed its periods. `time` is the argument of --color displacement.
void require_images(const TrajectoryReader& run, const std::string& time)
{
  if (run.has_images()) return;
  throw UsageError(fmt::format(
      "--color displacement:{0}: {1} does not store how often grains have crossed its "
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

/// Radius of the neighbourhood for --color composition, m. It is no longer than a period, so that a grain
/// has at most one image beyond each end.
double radius_around(const std::string& length, const TrajectoryReader& run)
{
  const double radius =
      parse_length(length, "--color composition:", {run.small_diameter(), run.large_diameter()});
  if (!(radius > 0)) throw UsageError("--color composition: its radius must be positive");
  const auto require = [&](bool periodic, double period, char axis) {
    if (periodic && radius > period * (1 + 1e-9))  // 35dL may be a little more than 0.35 m
      throw UsageError(fmt::format(
          "--color composition:{}: {:.4g} m is longer than the period along {}, which is {:.4g} m",
          length, radius, axis, period));
  };
  require(run.box().periodic_x, run.box().length_x, 'x');
  require(run.box().periodic_z, run.box().length_z, 'z');
  return radius;
}

/// Position of the grain, m, plus the periods that it has crossed if the frame has them; the field rise
/// does not read them.
template <int D>
Vector<D> place(const Frame<D>& frame, std::size_t grain, const Box& box)
{
  Vector<D> place = frame.position[grain];
  if (frame.image.empty()) return place;
  place.x() += box.length_x * frame.image[grain][0];
  if constexpr (D == 3) place.z() += box.length_z * frame.image[grain][2];
  return place;
}

/// Positions of all grains, m, at the time from which displacements are measured.
template <int D>
std::vector<Vector<D>> places_at(const FieldChoice& choice, const TrajectoryReader& run)
{
  const auto asked = fmt::format("--color {}:{}", choice.definition->word, choice.argument);
  const auto time = parse_number(choice.argument);
  if (!time) throw UsageError(fmt::format("{}: '{}' is not a time", asked, choice.argument));
  Frame<D> frame;
  run.read(frame_nearest(run, *time, asked), frame, choice.definition->needs);
  std::vector<Vector<D>> places;
  for (std::size_t g = 0; g < frame.position.size(); ++g)
    places.push_back(place(frame, g, run.box()));
  return places;
}

double about_z(double spin)
{
  return spin;
}
double about_z(const Vec3& spin)
{
  return spin.z();
}

template <int D>
using Values = std::function<std::vector<double>(const Frame<D>&)>;

/// Function that computes a field: the value of each mobile grain g is number(frame, g).
template <int D, class Number>
Values<D> of_each(const Grains& grains, const Number& number)
{
  return [&grains, number](const Frame<D>& frame) {
    std::vector<double> all(grains.size(), no_number);
    for (std::size_t g = 0; g < all.size(); ++g)
      if (is_mobile(grains, frame, g)) all[g] = number(frame, g);
    return all;
  };
}

/// Function that computes a field as a sum over the contacts of each mobile grain for which
/// counts(frame, k) is true: parts(frame, k) is the pair of numbers that contact k adds to its two grains.
template <int D, class Counts, class Parts>
Values<D> over_contacts(const Grains& grains, const Counts& counts, const Parts& parts)
{
  return [&grains, counts, parts](const Frame<D>& frame) {
    std::vector<double> sums(grains.size());
    for (std::size_t k = 0; k < frame.contacts.size(); ++k) {
      if (!counts(frame, k)) continue;
      const auto [i, j] = partners(grains, frame, k);
      const auto [of_i, of_j] = parts(frame, k);
      sums[i] += of_i;
      if (j) sums[*j] += of_j;
    }
    for (std::size_t g = 0; g < sums.size(); ++g)
      if (!is_mobile(grains, frame, g)) sums[g] = no_number;
    return sums;
  };
}

template <int D>
Values<D> pressures(const Grains& grains, const PartitionRule& rule)
{
  const auto all_count = [](const Frame<D>&, auto) { return true; };
  const auto parts = [&grains, rule](const Frame<D>& frame, auto k) {
    const double trace = frame.contacts.force[k].dot(frame.contacts.branch[k]);
    const auto shares = contact_shares(grains, frame, k, rule);
    return std::pair(shares.i * trace, shares.j * trace);
  };
  const auto traces = over_contacts<D>(grains, all_count, parts);
  return [&grains, traces](const Frame<D>& frame) {
    auto all = traces(frame);
    for (std::size_t g = 0; g < all.size(); ++g) all[g] /= D * grain_volume<D>(grains.radius[g]);
    return all;
  };
}

template <int D>
Values<D> moved(const FieldChoice& choice, const TrajectoryReader& run, const Grains& grains)
{
  const bool rises = choice.definition->kind == FieldKind::rise;
  if (!rises) require_images(run, choice.argument);
  return of_each<D>(grains, [rises, box = run.box(), origin = places_at<D>(choice, run)](
                                const Frame<D>& frame, std::size_t g) {
    const Vector<D> way = place(frame, g, box) - origin[g];
    return rises ? way.y() : way.norm();
  });
}

}  // namespace

std::span<const FieldDefinition> field_definitions()
{
  return definitions;
}

std::string list_of_fields()
{
  std::string text = fmt::format("{}: the species of each grain", species_word);
  for (const auto& field : definitions)
    text += fmt::format("\n{}{}: {}", field.word, field.argument, field.meaning);
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
        throw UsageError(fmt::format("--color {}: {} takes no argument", text, word));
      if (field.needs_argument() && argument.empty())
        throw UsageError(
            fmt::format("--color {}: give the time to compare with, as in {}:0", text, word));
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
    : definition_(choice.definition), title_(definition_->title)
{
  std::string unit = definition_->unit;
  const auto set = [&](const auto& number) { values_ = of_each<D>(grains, number); };
  switch (definition_->kind) {
    case FieldKind::radius:
      set([&grains](const Frame<D>&, auto g) { return grains.radius[g]; });
      break;
    case FieldKind::speed:
      set([](const Frame<D>& frame, auto g) { return frame.velocity[g].norm(); });
      break;
    case FieldKind::velocity: {
      const auto axis = axis_of(choice.argument, D);
      title_ += fmt::format(" {}", "xyz"[axis]);
      set([axis](const Frame<D>& frame, auto g) { return frame.velocity[g][axis]; });
      break;
    }
    case FieldKind::spin:
      set([](const Frame<D>& frame, auto g) { return about_z(frame.angular_velocity[g]); });
      break;
    case FieldKind::pressure:
      title_ += fmt::format(" (rule: {})", rule.name());
      if (D == 3) unit = "Pa";
      values_ = pressures<D>(grains, rule);
      break;
    case FieldKind::contacts:
      values_ = over_contacts<D>(
          grains, [](const Frame<D>& frame, auto k) { return bears_force(frame.contacts, k); },
          [](const Frame<D>&, auto) { return std::pair(1.0, 1.0); });
      break;
    case FieldKind::composition: {
      const auto length = choice.argument.empty() ? std::string("2dL") : choice.argument;
      title_ += fmt::format(" {} within {}", species.back().name, length);
      values_ = [&grains, box = run.box(), radius = radius_around(length, run),
                 largest = static_cast<Species>(species.size() - 1)](const Frame<D>& frame) {
        return local_composition<D>(grains, frame, box, largest, radius);
      };
      break;
    }
    case FieldKind::displacement:
    case FieldKind::rise:
      title_ += fmt::format(" {} s", choice.argument);
      values_ = moved<D>(choice, run, grains);
      break;
  }
  if (!unit.empty()) title_ += fmt::format(", {}", unit);
}

template class GrainField<2>;
template class GrainField<3>;

}  // namespace grseg
