// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/check/file_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_set>

namespace grseg {

template <int D>
void ContentCheck::add(std::size_t index, const Frame<D>& frame)
{
  ++frames_;
  if (!run_.is_intact(index, frame) && damaged_++ == 0) first_damaged_ = index;
}

template void ContentCheck::add(std::size_t, const Frame<2>&);
template void ContentCheck::add(std::size_t, const Frame<3>&);

std::vector<CheckLine> ContentCheck::lines() const
{
  const bool closed = run_.closed();
  const char* not_closed = "/grseg/seal is empty: the run was interrupted or goes on";
  const auto damaged =
      damaged_ == 0 ? frames_ == 1 ? "the frame agrees with its digest"
                                   : fmt::format("{} frames agree with their digests", frames_)
                    : fmt::format("frame {} is the first that is not as written", first_damaged_);
  const auto missing = judged("not_closed", closed ? 0 : 1, 0, closed ? "" : not_closed),
             of_frames = judged("damaged_frames", static_cast<double>(damaged_), 0, damaged),
             empty = judged("no_frames", frames_ == 0 ? 1 : 0, 0);
  auto damage = run_.damage_outside_frames();
  const bool whole = damage.empty();
  if (whole)
    damage = closed ? "everything outside the frames agrees with its digests and the seal"
                    : "what the file holds once agrees with its digest";
  return {missing, empty, of_frames, judged("damaged_outside_frames", whole ? 0 : 1, 0, damage)};
}

SpecificationCheck::SpecificationCheck(const TrajectoryReader& run)
    : run_(run), layout_(check_layout(run))
{
  check_grains();
  check_parameters();
  check_observables();
}

/// Records a deviation from the specification. For each path the first deviation is described,
/// further ones are only counted.
void SpecificationCheck::depart(const std::string& path, const std::string& what)
{
  auto& all = layout_.departures;
  const auto same = [&](const Departure& d) { return d.path == path; };
  if (const auto known = std::ranges::find_if(all, same); known != all.end())
    ++known->count;
  else
    all.push_back({path, what});
}

void SpecificationCheck::check_grains()
{
  const auto& grains = run_.grains();
  std::unordered_set<std::int32_t> ids;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (!ids.insert(grains.id[g]).second)
      depart("/particles/grains/id", fmt::format("holds {} twice", grains.id[g]));
    const bool boundary = grains.species[g] == Species::boundary;
    if (grains.fixed[g] > 1 || (boundary && grains.fixed[g] == 0))
      depart("/particles/grains/fixed",
             fmt::format("is {} for grain {}, {}", grains.fixed[g], g,
                         boundary ? "which belongs to the boundary" : "and may be 0 or 1"));
  }
}

void SpecificationCheck::check_parameters()
{
  const auto& numbers = run_.parameters().numbers;
  for (const char* name : {"small_diameter", "large_diameter", "step"}) {
    const auto found = numbers.find(name);
    if (found == numbers.end() || found->second.size() != 1 || !(found->second[0] > 0))
      depart(fmt::format("/parameters/{}", name), "should be a positive number");
  }
  const auto gravity = numbers.find("gravity");
  if (gravity == numbers.end() ||
      gravity->second.size() != static_cast<std::size_t>(run_.dimension()))
    depart("/parameters/gravity",
           fmt::format("should be {} numbers", run_.dimension() == 2 ? "two" : "three"));
}

void SpecificationCheck::check_observables()
{
  for (const auto& [name, unit] : run_.observables()) {
    const auto values = run_.observable(name);
    for (std::size_t k = 0; k < values.size(); ++k)
      if (!std::isfinite(values[k]))
        depart(fmt::format("/observables/{}/value", name),
               fmt::format("is not a finite number in frame {}", k));
  }
}

/// Checks that positions along x (axis 0) or z (axis 2) are within the periodic cell.
template <int D>
void SpecificationCheck::check_wrapped(std::size_t index, const Frame<D>& frame, int axis,
                                       double length)
{
  // Single precision may round a position just below the length of the cell up to this length.
  const bool rounded = run_.stores_float32();
  const auto wrapped = [&](double x) {
    return x >= 0 && (rounded ? x <= static_cast<float>(length) : x < length);
  };
  for (std::size_t g = 0; g < frame.position.size(); ++g)
    if (const double x = frame.position[g][axis]; is_present(frame, g) && !wrapped(x))
      depart("/particles/grains/position/value",
             fmt::format("has {} = {} for grain {} in frame {}, which is not in [0, {})",
                         "xyz"[axis], x, g, index, length));
}

template <int D>
void SpecificationCheck::add(std::size_t index, const Frame<D>& frame)
{
  const auto& box = run_.box();
  if (box.periodic_x) check_wrapped(index, frame, 0, box.length_x);
  if (D == 3 && box.periodic_z) check_wrapped(index, frame, 2, box.length_z);
  for (std::size_t g = 0; g < frame.image.size(); ++g)
    if (!is_present(frame, g) && frame.image[g] != std::array<std::int32_t, D>{})
      depart("/particles/grains/image/value",
             fmt::format("grain {} is absent in frame {}: its image must be 0", g, index));
  const auto& grains = run_.grains();
  const auto& i = frame.contacts.i;
  for (std::size_t k = 0; k < i.size(); ++k)
    if (grains.fixed[static_cast<std::size_t>(i[k])] != 0)
      depart(
          "/grseg/contacts/i",
          fmt::format("is {} for contact {} of frame {}, a grain that is fixed", i[k], k, index));
}

template void SpecificationCheck::add(std::size_t, const Frame<2>&);
template void SpecificationCheck::add(std::size_t, const Frame<3>&);

std::vector<CheckLine> SpecificationCheck::lines() const
{
  std::vector<CheckLine> lines;
  const auto add = [&](const std::string& quantity, std::size_t count, const std::string& remark) {
    lines.push_back(judged(quantity, static_cast<double>(count), 0, remark));
  };
  add("specification", layout_.departures.size(),
      fmt::format("{} datasets read whole, {} chunks", layout_.datasets, layout_.chunks));
  for (const auto& departure : layout_.departures)
    add(departure.path, departure.count, departure.what);
  return lines;
}

}  // namespace grseg
