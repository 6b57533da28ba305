// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/run/checkpoint.hpp"

#include <string>

namespace grseg {

template <class Visitor, class Totals>
void visit_totals(Visitor& visit, const std::string& group, Totals& totals)
{
  const auto at = [&](const char* name, auto& value) { visit((group + name).c_str(), value); };
  at("steps", totals.steps);
  at("missed", totals.missed);
  at("sweeps", totals.sweeps);
  at("residual_rms", totals.residual_rms);
  at("touching", totals.touching);
  at("force_bearing", totals.force_bearing);
  at("sum_overlap", totals.sum_overlap);
  at("sum_gap_bearing", totals.sum_gap_bearing);
  at("largest_residual", totals.largest_residual);
  at("largest_overlap", totals.largest_overlap);
  at("fastest_approach", totals.fastest_approach);
  at("base_impulse_x", totals.base_impulse.x());
  at("base_impulse_y", totals.base_impulse.y());
  at("base_impulse_z", totals.base_impulse.z());
  at("farthest_approach", totals.farthest_approach);
  at("divided", totals.divided);
  at("solved_again", totals.solved_again);
  at("largest_impulses", totals.largest_impulses);
  at("missed_impulse", totals.missed_impulse);
  at("missed_gain", totals.missed_gain);
  at("missed_overlap", totals.missed_overlap);
  at("last_missed", totals.last_missed);
}

/// Calls `visit` with the path and the value of every entry of a checkpoint. Writing, reading,
/// digest and check use this list.
template <class Visitor, class SomeCheckpoint>
void visit_all(Visitor& visit, SomeCheckpoint& c)
{
  visit("/scene", c.scene);
  visit("/program", c.program);
  visit("/history", c.history);
  visit("/deposited_height", c.deposited_height);
  visit("/grains/id", c.grains.id);
  visit("/grains/species", c.grains.species);
  visit("/grains/radius", c.grains.radius);
  visit("/grains/mass", c.grains.mass);
  visit("/grains/fixed", c.grains.fixed);
  visit("/walls", c.walls);
  visit("/box/length_x", c.box.length_x);
  visit("/box/length_y", c.box.length_y);
  visit("/box/periodic_x", c.box.periodic_x);
  visit("/box/dimension", c.box.dimension);
  visit("/box/length_z", c.box.length_z);
  visit("/box/periodic_z", c.box.periodic_z);
  visit("/state/steps_done", c.state.steps_done);
  visit("/state/held_back", c.state.held_back);
  visit("/state/stored", c.state.stored);
  visit("/state/position", c.state.position);
  visit("/state/image", c.state.image);
  visit("/state/velocity", c.state.velocity);
  visit("/state/rim_speed", c.state.rim);
  visit("/state/row", c.state.row);
  visit("/state/pairs/made_at", c.state.pairs.made_at);
  visit("/state/pairs/i", c.state.pairs.i);
  visit("/state/pairs/j", c.state.pairs.j);
  visit("/state/pairs/impulse_n", c.state.pairs.impulse_n);
  visit("/state/pairs/impulse_t", c.state.pairs.impulse_t);
  visit("/state/pairs/approach", c.state.pairs.approach);
  visit("/state/pairs/renewals", c.state.pairs.renewals);
  visit("/state/pairs/skin", c.state.pairs.skin);
  visit("/trajectory/frames", c.trajectory.frames);
  visit("/trajectory/digest", c.trajectory.digest);
  visit("/trajectory/begin", c.trajectory.begin);
  visit("/trajectory/wall", c.trajectory.wall);
  visit_totals(visit, "/trajectory/since_frame/", c.trajectory.recorder.since_frame);
  visit_totals(visit, "/trajectory/totals/", c.trajectory.recorder.totals);
}

/// Checks that a run can continue from a checkpoint: all indices, counts and physical values are in
/// range. The digest only proves that values have not changed since they were written, possibly by
/// another program. Throws FormatError, which names the file `name`, the entry and the remedy.
template <int D>
void check_checkpoint(const Checkpoint<D>& checkpoint, const std::string& name);

}  // namespace grseg
