// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/explore/player_data.hpp"

#include "analysis/explore/quantisation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace grseg {
namespace {

using Json = nlohmann::ordered_json;

/// What lies across the branch counts up to this many times what lies along it.
constexpr double steepest = 4;

Json bounds_of(const Quantisation& q)
{
  return {{"from", q.from()}, {"step", q.step()}};
}

/// The codes of a list of each frame, one after the other.
std::vector<std::uint16_t> codes(const ShownRun& run, std::vector<float> ShownFrame::*list,
                                 const Quantisation& q)
{
  std::vector<std::uint16_t> all;
  for (const auto& frame : run.frames)
    for (const float value : frame.*list) all.push_back(q.code(value));
  return all;
}

Quantisation bounds(const ShownRun& run, std::vector<float> ShownFrame::*list)
{
  Quantisation q;
  for (const auto& frame : run.frames)
    for (const float value : frame.*list) q.include(value);
  return q;
}

/// Where grains are; along a periodic axis codes fill the cell.
Json add_positions(const ShownRun& run, const Box& box, BinaryArrays& arrays)
{
  const Quantisation x = box.periodic_x ? Quantisation(0, box.length_x)
                                        : bounds(run, &ShownFrame::x),
                     y = bounds(run, &ShownFrame::y);
  arrays.add("x", codes(run, &ShownFrame::x, x));
  arrays.add("y", codes(run, &ShownFrame::y, y));
  Json all{{"x", bounds_of(x)}, {"y", bounds_of(y)}};
  if (box.dimension == 3) {
    const Quantisation cut = bounds(run, &ShownFrame::radius);
    arrays.add("cut_radius", codes(run, &ShownFrame::radius, cut));
    all["cut"] = bounds_of(cut);
  }
  return all;
}

double across_over_along(const ShownFrame& frame, std::size_t k)
{
  const double ratio = frame.across[k] / frame.along[k];
  return std::isnan(ratio) ? 0 : std::clamp(ratio, -steepest, steepest);
}

/// The grains of the contacts, in as few bytes as their number allows.
template <class Index>
void add_pairs(const ShownRun& run, BinaryArrays& arrays)
{
  std::vector<Index> first, second;
  for (const auto& frame : run.frames) {
    std::int32_t before = 0;
    for (std::size_t k = 0; k < frame.i.size(); ++k) {
      first.push_back(static_cast<Index>(frame.i[k] - before));
      second.push_back(static_cast<Index>(frame.j[k]));  // -1 becomes the highest number
      before = frame.i[k];
    }
  }
  arrays.add("i", first);
  arrays.add("j", second);
}

Json add_contacts(const ShownRun& run, BinaryArrays& arrays)
{
  if (run.row.size() <= 1u << 15)
    add_pairs<std::uint16_t>(run, arrays);
  else
    add_pairs<std::uint32_t>(run, arrays);
  auto along = bounds(run, &ShownFrame::along);
  along.include(0);
  arrays.add("along", codes(run, &ShownFrame::along, along));

  double largest = 0;
  for (const auto& frame : run.frames)
    for (std::size_t k = 0; k < frame.i.size(); ++k)
      largest = std::max(largest, std::abs(across_over_along(frame, k)));
  const double step = largest / 127;
  std::vector<std::int8_t> across;
  std::vector<std::uint32_t> offset{0};
  for (const auto& frame : run.frames) {
    for (std::size_t k = 0; k < frame.i.size(); ++k)
      across.push_back(
          static_cast<std::int8_t>(step > 0 ? std::lround(across_over_along(frame, k) / step) : 0));
    offset.push_back(static_cast<std::uint32_t>(across.size()));
  }
  arrays.add("across", across);
  arrays.add("contact_offset", offset);
  return {{"along", bounds_of(along)}, {"across_step", step}};
}

/// Walls as the last frame knows them, in those before by number; returns how many.
std::size_t add_walls(const ShownRun& run, BinaryArrays& arrays)
{
  const std::size_t count = run.frames.empty() ? 0 : run.frames.back().walls.size();
  std::vector<float> all;
  for (const auto& frame : run.frames)
    for (std::size_t w = 0; w < count; ++w) {
      const ShownWall wall = w < frame.walls.size() ? frame.walls[w] : ShownWall{NAN, NAN, NAN};
      all.insert(all.end(), {wall.normal_x, wall.normal_y, wall.offset});
    }
  arrays.add("walls", all);
  return count;
}

void add_grains(const ShownRun& run, BinaryArrays& arrays)
{
  std::vector<std::uint8_t> species;
  species.reserve(run.species.size());
  for (const auto one : run.species)
    species.push_back(one == Species::boundary ? 255 : static_cast<std::uint8_t>(one));
  arrays.add("species", species);
  arrays.add("radius", run.radius);
  arrays.add("row", run.row);
}

}  // namespace

Json player_data(const ShownRun& run, const Box& box, BinaryArrays& arrays)
{
  add_grains(run, arrays);
  Json player{{"grains", run.row.size()},
              {"length_x", box.length_x},
              {"periodic_x", box.periodic_x},
              {"bounds", add_positions(run, box, arrays)}};
  player["bounds"].update(add_contacts(run, arrays));
  player["walls"] = add_walls(run, arrays);
  player["times"] = Json::array();
  player["steps"] = Json::array();
  for (const auto& frame : run.frames) {
    player["times"].push_back(frame.time);
    player["steps"].push_back(frame.step);
  }
  player["contact_point_from_size"] = run.contact_point_from_size;
  if (box.dimension == 3) player["plane"] = box.length_z / 2;
  return player;
}

}  // namespace grseg
