// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/explore/player_data.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace grseg {
namespace {

using Json = nlohmann::ordered_json;

/// Adds the numbers of one list of every frame as codes of `q`. If `widen` is true, the bounds of `q` are
/// first widened to include all numbers. Returns the lower bound and the step of the codes.
Json add_codes(const ShownRun& run, const char* name, std::vector<float> ShownFrame::*list,
               BinaryArrays& arrays, Quantisation q = {}, bool widen = true)
{
  std::vector<std::uint16_t> codes;
  if (widen)
    for (const auto& frame : run.frames)
      for (const float value : frame.*list) q.include(value);
  for (const auto& frame : run.frames)
    for (const float value : frame.*list) codes.push_back(q.code(value));
  arrays.add(name, codes);
  return {{"from", q.from()}, {"step", q.step()}};
}

/// Adds the positions of grains. If x is periodic, its codes span the cell. Returns the bounds of the codes.
Json add_positions(const ShownRun& run, const Box& box, BinaryArrays& arrays)
{
  const auto cell = box.periodic_x ? Quantisation(0, box.length_x) : Quantisation();
  Json all{{"x", add_codes(run, "x", &ShownFrame::x, arrays, cell, !box.periodic_x)},
           {"y", add_codes(run, "y", &ShownFrame::y, arrays)}};
  if (box.dimension == 3) all["z"] = add_codes(run, "z", &ShownFrame::z, arrays);
  return all;
}

/// Adds the two grains of each contact, as numbers of type Index.
template <class Index>
void add_pairs(const ShownRun& run, BinaryArrays& arrays)
{
  std::vector<Index> first, second;
  for (const auto& frame : run.frames) {
    std::int32_t before = 0;
    for (std::size_t k = 0; k < frame.i.size(); ++k) {
      first.push_back(static_cast<Index>(frame.i[k] - before));
      second.push_back(static_cast<Index>(frame.j[k]));  // wall -1 becomes the largest Index
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
  std::vector<std::uint32_t> offset{0};
  offset.reserve(run.frames.size() + 1);
  for (const auto& frame : run.frames)
    offset.push_back(offset.back() + static_cast<std::uint32_t>(frame.i.size()));
  arrays.add("contact_offset", offset);
  const Quantisation zero(0, 0);  // so that 0 lies between the bounds
  return {{"along", add_codes(run, "along", &ShownFrame::along, arrays, zero)},
          {"across", add_codes(run, "across", &ShownFrame::across, arrays, zero)}};
}

/// Adds the walls of each frame. Every frame has as many as the last frame; walls not yet known are NaN.
/// Returns the number of walls.
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
  return player;
}

double player_bytes(const TrajectoryReader& run, std::size_t frames)
{
  const auto& box = run.box();
  const double grains = static_cast<double>(run.grains().size()),
               index = grains <= 1u << 15 ? sizeof(std::uint16_t) : sizeof(std::uint32_t),
               contacts = static_cast<double>(run.contacts()) / static_cast<double>(run.size());
  constexpr double code = sizeof(std::uint16_t);
  // The share of the cell that the slice shows.
  const double shown = box.dimension == 3 ? std::min(1.0, run.large_diameter() / box.length_z) : 1;
  return static_cast<double>(frames) *
         (grains * box.dimension * code + shown * contacts * (2 * index + 2 * code));
}

}  // namespace grseg
