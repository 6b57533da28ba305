// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/facts/proposals.hpp"

#include "formats/cli/words.hpp"
#include "formats/core/species.hpp"
#include "formats/import/common/frame_tools.hpp"
#include "formats/import/facts/axes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace grseg {
namespace {

bool is_at_rest(const ArchiveGrains& grains, std::size_t g)
{
  return g < grains.velocity.size() && grains.velocity[g].isZero(0);
}

/// Sum of the contact forces on each grain.
std::vector<Vec3> contact_sums(const ArchiveFrame& frame)
{
  const auto row = rows_by_id(frame.grains);
  std::vector<Vec3> sum(frame.grains.size(), Vec3::Zero());
  const auto& contacts = frame.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (const auto i = row.find(contacts.i[c]); i != row.end()) sum[i->second] += contacts.force[c];
    if (contacts.at_wall(c)) continue;
    if (const auto j = row.find(contacts.j[c]); j != row.end()) sum[j->second] -= contacts.force[c];
  }
  return sum;
}

/// Number, number at rest, and diameters of the grains of one type.
struct OfType {
  std::size_t count = 0, resting = 0, moving = 0;
  Range diameters;
};

std::map<std::int32_t, OfType> types_of(const ArchiveGrains& grains,
                                        const std::vector<bool>& resting)
{
  std::map<std::int32_t, OfType> types;
  for (std::size_t g = 0; g < grains.type.size(); ++g) {
    auto& of = types[grains.type[g]];
    ++of.count;
    of.resting += !resting.empty() && resting[g] ? 1 : 0;
    of.moving += !grains.velocity.empty() && !grains.velocity[g].isZero(0) ? 1 : 0;
    of.diameters.add(2 * grains.radius[g]);
  }
  return types;
}

std::string range_in_words(const Range& range)
{
  const auto first = fmt::format("{:.4g}", range.low), last = fmt::format("{:.4g}", range.high);
  return first == last ? first : first + " to " + last;
}

/// Describes the types of the grains: "type 1: 300 grains, 0.9 to 1.1 wide".
std::string in_words(const ArchiveGrains& grains, const std::vector<bool>& resting)
{
  const auto types = types_of(grains, resting);
  constexpr std::size_t most = 8;
  std::vector<std::string> parts;
  for (const auto& [type, of] : types) {
    parts.push_back(fmt::format("type {}: {} grain{}, {} wide{}", grains.type_word(type), of.count,
                                of.count == 1 ? "" : "s", range_in_words(of.diameters),
                                of.resting < of.count ? ""
                                : of.moving > 0       ? ", with one velocity"
                                                      : ", at rest"));
    if (parts.size() < most || types.size() == most) continue;
    parts.push_back(fmt::format("{} types in all", types.size()));
    break;
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

/// The ids of grains at rest, "1-35,70"; "" for more than 12 ranges.
std::string ids_at_rest(const ArchiveGrains& grains, const std::vector<bool>& resting)
{
  constexpr std::size_t most_ranges = 12;
  std::vector<std::int64_t> ids;
  for (std::size_t g = 0; g < grains.size(); ++g)
    if (resting[g]) ids.push_back(grains.id[g]);
  std::sort(ids.begin(), ids.end());
  std::vector<std::string> ranges;
  for (std::size_t k = 0; k < ids.size();) {
    const auto first = ids[k];
    while (k + 1 < ids.size() && ids[k + 1] == ids[k] + 1) ++k;
    ranges.push_back(first == ids[k] ? fmt::format("{}", first)
                                     : fmt::format("{}-{}", first, ids[k]));
    ++k;
  }
  return ranges.size() > most_ranges ? "" : fmt::format("{}", fmt::join(ranges, ","));
}

}  // namespace

namespace {

/// True for each grain whose velocity, which is not zero, is exactly the one of at least nine
/// others: grains of a wall that moves as one body, such as a lid.
std::vector<bool> grains_of_one_velocity(const ArchiveGrains& grains)
{
  constexpr std::size_t enough = 10;
  const auto key = [&](std::size_t g) {
    const Vec3& v = grains.velocity[g];
    return std::array{v.x(), v.y(), v.z()};
  };
  std::map<std::array<double, 3>, std::size_t> count;
  std::vector<bool> are(grains.size());
  if (grains.velocity.empty()) return are;
  for (std::size_t g = 0; g < grains.size(); ++g) ++count[key(g)];
  for (std::size_t g = 0; g < grains.size(); ++g)
    are[g] = !grains.velocity[g].isZero(0) && count[key(g)] >= enough;
  return are;
}

}  // namespace

std::vector<bool> resting_grains(const ArchiveGrains& first, const ArchiveGrains* later)
{
  const auto as_one = grains_of_one_velocity(first);
  const auto as_one_later = later == nullptr ? as_one : grains_of_one_velocity(*later);
  const auto row = rows_by_id(later == nullptr ? ArchiveGrains{} : *later);
  std::vector<bool> resting(first.size());
  std::size_t count = 0;
  for (std::size_t g = 0; g < first.size(); ++g) {
    resting[g] = is_at_rest(first, g);
    const auto at = row.find(first.id[g]);
    if (resting[g] && at != row.end())
      resting[g] =
          is_at_rest(*later, at->second) && first.position[g] == later->position[at->second];
    if (as_one[g]) resting[g] = at == row.end() || as_one_later[at->second];
    count += resting[g] ? 1 : 0;
  }
  if (count == first.size()) resting.clear();
  return resting;
}

std::optional<Vec3> suggested_gravity(const ArchiveFrame& frame, const std::vector<double>& mass,
                                      const std::vector<bool>& resting)
{
  const auto& grains = frame.grains;
  const bool understood = frame.questions.empty() || frame.contacts.size() > 0;
  if (grains.force.empty() || !understood || mass.empty()) return std::nullopt;
  const auto sum = contact_sums(frame);
  std::array<std::vector<double>, 3> values;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if ((!resting.empty() && resting[g]) || !(mass[g] > 0)) continue;
    const Vec3 weight = (grains.force[g] - sum[g]) / mass[g];
    for (std::size_t k = 0; k < 3; ++k) values[k].push_back(weight[static_cast<int>(k)]);
  }
  if (values[0].empty()) return std::nullopt;
  Vec3 gravity(median(values[0]), median(values[1]), median(values[2]));
  constexpr double negligible = 1e-3;
  for (double& component : gravity)
    if (std::abs(component) < negligible * gravity.norm()) component = 0;
  if (!gravity.allFinite() || gravity.isZero(0)) return std::nullopt;
  return gravity;
}

std::optional<ProposedPeriod> suggested_period(const ArchiveFrame& frame, int axis)
{
  const auto& grains = frame.grains;
  const auto row = rows_by_id(grains);
  // Grains that touch across the ends are a period minus their branch apart.
  Range period, along;
  std::size_t count = 0;
  double smallest = INFINITY;
  for (std::size_t c = 0; !grains.radius.empty() && c < frame.contacts.size(); ++c) {
    const auto i = row.find(frame.contacts.i[c]), j = row.find(frame.contacts.j[c]);
    if (frame.contacts.at_wall(c) || i == row.end() || j == row.end()) continue;
    Vec3 between = grains.position[i->second] - grains.position[j->second];
    const double apart = std::abs(between[axis]);
    between[axis] = 0;
    const double reach = grains.radius[i->second] + grains.radius[j->second];
    if (apart < 2 * reach || between.norm() > reach) continue;
    period.add(apart + std::sqrt(reach * reach - between.squaredNorm()));
    smallest = std::min(smallest, reach);
    ++count;
  }
  for (const auto& at : grains.position) along.add(at[axis]);
  const double spread = period.high - period.low;
  if (count < 2 || spread > 0.2 * smallest || along.high - along.low > period.low + spread)
    return std::nullopt;
  // Overlaps make the values too large: the roundest number near the least one is the best guess.
  double length = period.low;
  for (int digits = 1; digits < 10; ++digits) {
    const double rounded = std::stod(fmt::format("{:.{}e}", period.low, digits - 1));
    if (std::abs(rounded - period.low) > std::max(spread, 1e-6 * period.low)) continue;
    length = rounded;
    break;
  }
  const bool from_zero = along.low >= 0 && along.high <= length;
  const double low = from_zero ? 0 : along.low;
  return ProposedPeriod{low, low + length, count};
}

std::string gravity_option(const Vec3& gravity)
{
  return fmt::format("{:.6g},{:.6g},{:.6g}", gravity.x(), gravity.y(), gravity.z());
}

Question question_of_base(const ArchiveGrains& grains, const std::vector<bool>& resting)
{
  const bool has_types = !grains.type.empty();
  Question question{"which grains are the base",
                    has_types ? "--boundary TYPES" : "--boundary-ids IDS", "or --boundary none"};
  if (has_types) question.reason += "; " + in_words(grains, resting);
  if (resting.empty()) return question;
  question.option = "--boundary none";
  if (has_types) {
    std::vector<std::string> types;
    for (const auto& [type, of] : types_of(grains, resting))
      if (of.resting == of.count) types.push_back(grains.type_word(type));
    if (!types.empty())
      question.option = "--boundary " + shell_word(fmt::format("{}", fmt::join(types, ",")));
    question.reason = in_words(grains, resting);
  } else if (const auto ids = ids_at_rest(grains, resting); !ids.empty()) {
    question.option = "--boundary-ids " + ids;
    question.reason = "these grains are at rest, the others are not";
  } else {
    question.reason = "or --boundary-ids IDS";
  }
  return question;
}

Question question_of_species(const ArchiveGrains& grains, const std::vector<bool>& boundary,
                             const std::string& diameters)
{
  Question question{"how species differ", "--species grains=all",
                    "one species; diameters are " + diameters +
                        "; or --small TYPES --large TYPES, --split-diameter D, or --species "
                        "NAME=TYPES for each"};
  std::vector<std::int32_t> mobile;
  for (std::size_t g = 0; g < grains.type.size(); ++g)
    if (!boundary[g]) mobile.push_back(grains.type[g]);
  std::sort(mobile.begin(), mobile.end());
  mobile.erase(std::unique(mobile.begin(), mobile.end()), mobile.end());
  if (mobile.size() < 2 || mobile.size() > 20) return question;
  question.option.clear();
  for (const auto type : mobile) {
    const auto word = grains.type_word(type);
    const bool is_name = !grains.type_names.empty() && is_species_name(word);
    question.option += fmt::format("{}--species {}={}", question.option.empty() ? "" : " ",
                                   is_name ? word : fmt::format("type{}", type), shell_word(word));
  }
  question.reason = in_words(grains, {}) + "; or --species grains=all";
  return question;
}

std::optional<Question> question_of_axes(const ArchiveFrame& frame, bool in_space,
                                         const std::optional<Vec3>& gravity)
{
  const auto plane = in_space ? "" : plane_of(frame.grains);
  if (!plane.empty()) {
    if (plane == "xy") return std::nullopt;
    return Question{"the axes of the flow", "--axes " + plane,
                    "along the base, away from it; the grains lie in this plane"};
  }
  if (!gravity && frame.periodic[1] && !frame.periodic[2])
    return Question{"the axes of the flow", "--axes xz",
                    "along the base, away from it; the cell is periodic along y, but not along z"};
  if (!gravity) return std::nullopt;
  int normal = 0;
  gravity->cwiseAbs().maxCoeff(&normal);
  if (normal == 1) return std::nullopt;
  return Question{"the axes of the flow", normal == 2 ? "--axes xz" : "--axes yx",
                  "along the base, away from it; gravity is nearest to the second axis"};
}

}  // namespace grseg
