// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/run/checkpoint_check.hpp"

#include "formats/core/errors.hpp"
#include "sim/run/restart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace grseg {
namespace {

constexpr std::uint64_t largest_count = 1'000'000'000'000'000;  // a double counts up to there
constexpr double farthest = 1e12;     // in d_S: beyond, a double knows no distance of neighbours
constexpr double largest_radius = 1;  // in d_L, or in base-diameter
constexpr std::size_t most_in_cell = 64;  // grains whose centres lie in one square of side d_S
constexpr double unit_tolerance = 1e-9;   // of the length of a normal

bool finite(double x)
{
  return std::isfinite(x);
}
bool finite(const Vec2& x)
{
  return x.allFinite();
}
bool positive(double x)
{
  return std::isfinite(x) && x > 0;
}

class Check {
 public:
  Check(const Checkpoint& checkpoint, std::string name) : c_(checkpoint), name_(std::move(name)) {}

  void all() const
  {
    sizes();
    grains();
    surroundings();
    state();
    pairs();
    trajectory();
    in_scene(scene());
  }

 private:
  [[noreturn]] void fail(const std::string& what) const
  {
    throw FormatError(fmt::format(
        "{}: {}: this was not written by grseg-sim, or is damaged; use an older checkpoint", name_,
        what));
  }
  void require(bool valid, const std::string& what) const
  {
    if (!valid) fail(what);
  }
  template <class Values, class Valid>
  void each(const char* path, const Values& values, const Valid& valid, const char* what) const
  {
    for (std::size_t k = 0; k < values.size(); ++k)
      if (!valid(values[k])) fail(fmt::format("{}, entry {}, {}", path, k, what));
  }
  template <class Values>
  void all_finite(const char* path, const Values& values) const
  {
    each(
        path, values, [](const auto& x) { return finite(x); }, "is not a finite number");
  }
  /// Each of 0, 1, 2 ... or whatever number once.
  void each_once(const char* path, std::vector<std::int32_t> values) const
  {
    std::sort(values.begin(), values.end());
    const auto twice = std::adjacent_find(values.begin(), values.end());
    if (twice != values.end()) fail(fmt::format("{} has {} twice", path, *twice));
  }

  void sizes() const
  {
    const auto n = c_.grains.size(), pairs = c_.state.pairs.i.size();
    require(n > 0, "there are no grains");
    for (const auto& [path, size] : {std::pair{"/grains/id", c_.grains.id.size()},
                                     {"/grains/species", c_.grains.species.size()},
                                     {"/grains/mass", c_.grains.mass.size()},
                                     {"/grains/fixed", c_.grains.fixed.size()},
                                     {"/state/position", c_.state.position.size()},
                                     {"/state/image", c_.state.image.size()},
                                     {"/state/velocity", c_.state.velocity.size()},
                                     {"/state/rim_speed", c_.state.rim_speed.size()},
                                     {"/state/row", c_.state.row.size()}})
      require(size == n, fmt::format("{} has {} entries for {} grains", path, size, n));
    for (const auto& [path, size] : {std::pair{"j", c_.state.pairs.j.size()},
                                     {"impulse_n", c_.state.pairs.impulse_n.size()},
                                     {"impulse_t", c_.state.pairs.impulse_t.size()},
                                     {"approach", c_.state.pairs.approach.size()}})
      require(size == pairs,
              fmt::format("/state/pairs/{} has {} entries for {} pairs", path, size, pairs));
    const auto made_at = c_.state.pairs.made_at.size();
    require(made_at == (pairs == 0 ? 0 : n + 1),
            fmt::format("/state/pairs/made_at has {} entries for {} grains", made_at, n));
  }

  void grains() const
  {
    each_once("/grains/id", c_.grains.id);
    each(
        "/grains/species", c_.grains.species,
        [](Species species) { return Species::boundary <= species && species <= Species::large; },
        "is not -1, 0 or 1");
    each("/grains/radius", c_.grains.radius, positive, "is not a positive number");
    each("/grains/mass", c_.grains.mass, positive, "is not a positive number");
    each(
        "/grains/fixed", c_.grains.fixed, [](std::uint8_t fixed) { return fixed <= 1; },
        "is not 0 or 1");
  }

  void surroundings() const
  {
    each(
        "/walls", c_.walls,
        [](const Wall& wall) {
          return finite(wall.point) && std::abs(wall.normal.norm() - 1) <= unit_tolerance;
        },
        "is not a point and a normal of length 1");
    const auto& box = c_.box;
    require(finite(box.length_x) && box.length_x >= (box.periodic_x ? 1e-300 : 0),
            "/box/length_x is not a positive number");
    require(finite(box.length_y) && box.length_y >= 0, "/box/length_y is not a positive number");
    require(finite(c_.deposited_height), "/deposited_height is not a finite number");
  }

  void state() const
  {
    all_finite("/state/position", c_.state.position);
    all_finite("/state/velocity", c_.state.velocity);
    all_finite("/state/rim_speed", c_.state.rim_speed);
    each(
        "/state/image", c_.state.image,
        [](std::int32_t image) { return image >= -most_periods && image <= most_periods; },
        "is not a number of periods");
    const auto n = static_cast<std::int32_t>(c_.grains.size());
    each(
        "/state/row", c_.state.row, [n](std::int32_t row) { return row >= 0 && row < n; },
        "is not the row of a grain");
    each_once("/state/row", c_.state.row);
  }

  void pairs() const
  {
    const auto& pairs = c_.state.pairs;
    // An entry is twice the place of a body; the last body stands for walls.
    const auto bodies = c_.grains.size() + 1;
    const auto a_body = [bodies](std::uint32_t i) { return i % 2 == 0 && i / 2 < bodies; };
    each("/state/pairs/i", pairs.i, a_body, "is not a grain");
    each("/state/pairs/j", pairs.j, a_body, "is not a grain");
    all_finite("/state/pairs/made_at", pairs.made_at);
    all_finite("/state/pairs/impulse_n", pairs.impulse_n);
    all_finite("/state/pairs/impulse_t", pairs.impulse_t);
    all_finite("/state/pairs/approach", pairs.approach);
    require(positive(pairs.skin), "/state/pairs/skin is not a positive length");
    require(pairs.renewals <= largest_count, "/state/pairs/renewals is not a number of lists");
  }

  void totals(const char* group, const StepTotals& totals) const
  {
    require(totals.steps >= 0 && totals.missed >= 0 && totals.divided >= 0,
            fmt::format("{} has a negative number of steps", group));
    for (const double sum :
         {totals.sweeps, totals.residual_rms, totals.touching, totals.force_bearing,
          totals.sum_overlap, totals.sum_gap_bearing, totals.largest_residual,
          totals.largest_overlap, totals.fastest_approach, totals.farthest_approach,
          totals.base_impulse.x(), totals.base_impulse.y()})
      require(finite(sum), fmt::format("{} has a number that is not finite", group));
  }

  void trajectory() const
  {
    const auto& trajectory = c_.trajectory;
    require(trajectory.frames <= largest_count, "/trajectory/frames is not a number of frames");
    require(finite(trajectory.begin), "/trajectory/begin is not a finite number");
    require(finite(trajectory.wall) && trajectory.wall >= 0,
            "/trajectory/wall is not a duration in s");
    totals("/trajectory/since_frame", trajectory.recorder.since_frame);
    totals("/trajectory/totals", trajectory.recorder.totals);
  }

  Scene scene() const
  {
    try {
      return scene_of(c_, name_);
    } catch (const ToolError& wrong) {
      fail(fmt::format("/scene is not one ({})", wrong.what()));
    }
  }

  void in_scene(const Scene& scene) const
  {
    require(c_.state.steps_done >= 0 && c_.state.steps_done <= scene.steps_in_all(),
            fmt::format("/state/steps_done is {}, and the run has {} steps", c_.state.steps_done,
                        scene.steps_in_all()));
    const double most = largest_radius * std::max(scene.large_diameter, scene.base_diameter);
    each(
        "/grains/radius", c_.grains.radius, [most](double radius) { return radius <= most; },
        "is larger than the diameter of large grains and base grains");
    require(c_.state.pairs.skin <= 2 * most, "/state/pairs/skin is larger than a large grain");
    const double end = farthest * scene.small_diameter;
    const auto near = [end](const Vec2& x) { return x.cwiseAbs().maxCoeff() <= end; };
    for (const auto& [path, positions] : {std::pair{"/state/position", &c_.state.position},
                                          {"/state/pairs/made_at", &c_.state.pairs.made_at}}) {
      each(path, *positions, near, "is too far away");
      not_crowded(path, *positions, scene.small_diameter);
    }
  }

  /// Grains in one place would all be pairs of each other: more than fit into memory.
  void not_crowded(const char* path, const std::vector<Vec2>& positions, double cell) const
  {
    std::vector<std::pair<std::int64_t, std::int64_t>> cells;
    cells.reserve(positions.size());
    for (const auto& x : positions)
      cells.emplace_back(std::llround(x.x() / cell), std::llround(x.y() / cell));
    std::sort(cells.begin(), cells.end());
    for (std::size_t k = most_in_cell; k < cells.size(); ++k)
      require(cells[k] != cells[k - most_in_cell],
              fmt::format("{} has more than {} grains in one place", path, most_in_cell));
  }

  const Checkpoint& c_;
  std::string name_;
};

}  // namespace

void check_checkpoint(const Checkpoint& checkpoint, const std::string& name)
{
  Check(checkpoint, name).all();
}

}  // namespace grseg
