// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/explore/player_data.hpp"

#include "analysis/explore/quantisation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace grseg {
namespace {

using Json = nlohmann::ordered_json;

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

/// 0 lies between the bounds.
Json add_forces(const ShownRun& run, const char* name, std::vector<float> ShownFrame::*list,
                BinaryArrays& arrays)
{
  auto q = bounds(run, list);
  q.include(0);
  arrays.add(name, codes(run, list, q));
  return bounds_of(q);
}

Json add_contacts(const ShownRun& run, BinaryArrays& arrays)
{
  if (run.row.size() <= 1u << 15)
    add_pairs<std::uint16_t>(run, arrays);
  else
    add_pairs<std::uint32_t>(run, arrays);
  std::vector<std::uint32_t> offset{0};
  offset.reserve(run.frames.size() + 1);
  for (const auto& frame : run.frames)
    offset.push_back(offset.back() + static_cast<std::uint32_t>(frame.i.size()));
  arrays.add("contact_offset", offset);
  return {{"along", add_forces(run, "along", &ShownFrame::along, arrays)},
          {"across", add_forces(run, "across", &ShownFrame::across, arrays)}};
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
  player["gravity"] = Json::array();
  for (const auto& frame : run.frames) {
    player["times"].push_back(frame.time);
    player["steps"].push_back(frame.step);
    player["gravity"].push_back({frame.gravity.x(), frame.gravity.y()});
  }
  player["contact_point_from_size"] = run.contact_point_from_size;
  if (box.dimension == 3) player["plane"] = box.length_z / 2;
  return player;
}

double player_bytes(const TrajectoryReader& run, std::size_t frames)
{
  const auto& box = run.box();
  const double grains = static_cast<double>(run.grains().size()),
               index = grains <= 1u << 15 ? sizeof(std::uint16_t) : sizeof(std::uint32_t),
               contacts = static_cast<double>(run.contacts()) / static_cast<double>(run.size());
  constexpr double code = sizeof(std::uint16_t);
  // A plane cuts the contacts that lie no further away than a grain is wide.
  const double cut = box.dimension == 3 ? std::min(1.0, run.large_diameter() / box.length_z) : 1;
  return static_cast<double>(frames) *
         (grains * box.dimension * code + cut * contacts * (2 * index + 2 * code));
}

}  // namespace grseg
