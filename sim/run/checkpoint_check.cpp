// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/errors.hpp"
#include "sim/run/checkpoint_entries.hpp"
#include "sim/run/restart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace grseg {
namespace {

constexpr std::uint64_t largest_count = 1'000'000'000'000'000;  // exact in a double
constexpr double farthest = 1e12;         // in d_S; limited by the precision of a double
constexpr double largest_radius = 1;      // in d_L or base-diameter, whichever is larger
constexpr std::size_t most_in_cell = 64;  // centres of grains in a square or cube of side d_S
constexpr double unit_tolerance = 1e-9;   // accepted error of the length of a normal

bool finite(double x)
{
  return std::isfinite(x);
}
template <int n>
bool finite(const Eigen::Matrix<double, n, 1>& x)
{
  return x.allFinite();
}
template <std::size_t n>
bool finite(const std::array<double, n>& x)
{
  return vector_of(x).allFinite();
}

template <int D>
class Check {
 public:
  Check(const Checkpoint<D>& checkpoint, std::string name) : c_(checkpoint), name_(std::move(name))
  {
  }

  void all() const
  {
    require(c_.grains.size() > 0, "there are no grains");
    visit_all(*this, c_);
    grains();
    surroundings();
    state();
    pairs();
    trajectory();
    in_scene(scene());
  }

  /// Checks every entry: one value per grain or pair, and only finite numbers.
  template <class T>
  void operator()(const char* path, const T& value) const
  {
    if constexpr (std::is_same_v<T, double>)
      require(finite(value), fmt::format("{} is not a finite number", path));
  }
  template <class T>
  void operator()(const char* name, const std::vector<T>& values) const
  {
    const std::string_view path = name;
    const bool made_at = path == "/state/pairs/made_at";
    const bool of_pairs = path.starts_with("/state/pairs/") && !made_at;
    const auto grains = c_.grains.size(), pairs = c_.state.pairs.i.size();
    const auto size = of_pairs ? pairs : !made_at ? grains : pairs == 0 ? 0 : grains + 1;
    require(values.size() == size || path == "/walls",
            fmt::format("{} has {} entries for {} {}", path, values.size(),
                        of_pairs ? pairs : grains, of_pairs ? "pairs" : "grains"));
    if constexpr (requires(const T& x) { finite(x); } && !std::is_integral_v<T>)
      each(
          name, values, [](const T& x) { return finite(x); }, "is not a finite number");
  }

 private:
  [[noreturn]] void fail(const std::string& what) const
  {
    throw FormatError(fmt::format(
        "{}: {}: the file was not written by grseg-sim, or is damaged; use an older checkpoint",
        name_, what));
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
  /// Fails if a value occurs twice.
  void each_once(const char* path, std::vector<std::int32_t> values) const
  {
    std::sort(values.begin(), values.end());
    const auto twice = std::adjacent_find(values.begin(), values.end());
    if (twice != values.end()) fail(fmt::format("{} has {} twice", path, *twice));
  }

  void grains() const
  {
    each_once("/grains/id", c_.grains.id);
    each(
        "/grains/species", c_.grains.species,
        [](Species species) { return Species::boundary <= species && species <= Species::large; },
        "is not -1, 0 or 1");
    const auto positive = [](double x) { return x > 0; };
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
        [](const Wall<D>& wall) {
          return finite(wall.point) && std::abs(wall.normal.norm() - 1) <= unit_tolerance;
        },
        "is not a point and a normal of length 1");
    const auto& box = c_.box;
    require(box.length_x >= (box.periodic_x ? 1e-300 : 0),
            "/box/length_x is not a positive number");
    require(box.length_y >= 0, "/box/length_y is not a positive number");
    require(box.length_z >= (box.periodic_z ? 1e-300 : 0),
            "/box/length_z is not a positive number");
  }

  void state() const
  {
    each(
        "/state/image", c_.state.image,
        [](const Periods<D>& image) {
          return std::all_of(image.begin(), image.end(), [](std::int32_t periods) {
            return periods >= -most_periods && periods <= most_periods;
          });
        },
        "is not a number of periods from -1e9 to 1e9");
    const auto n = static_cast<std::int32_t>(c_.grains.size());
    each(
        "/state/row", c_.state.row, [n](std::int32_t row) { return row >= 0 && row < n; },
        "is not the row of a grain");
    each_once("/state/row", c_.state.row);
  }

  void pairs() const
  {
    const auto& pairs = c_.state.pairs;
    // Entries are offsets of positions; the last body is the immobile one.
    const auto bodies = c_.grains.size() + 1;
    const auto a_body = [bodies](std::uint32_t i) {
      return i % position_doubles<D> == 0 && i / position_doubles<D> < bodies;
    };
    each("/state/pairs/i", pairs.i, a_body, "is not a grain");
    each("/state/pairs/j", pairs.j, a_body, "is not a grain");
    require(pairs.skin > 0, "/state/pairs/skin is not a positive length");
    require(pairs.renewals <= largest_count,
            "/state/pairs/renewals is too large for a number of pair lists");
  }

  void trajectory() const
  {
    const auto& trajectory = c_.trajectory;
    require(trajectory.frames <= largest_count,
            "/trajectory/frames is too large for a number of frames");
    require(trajectory.wall >= 0, "/trajectory/wall is not a duration in s");
    const auto& [since_frame, totals] = trajectory.recorder;
    for (const auto& [group, t] :
         {std::pair{"/trajectory/since_frame", &since_frame}, {"/trajectory/totals", &totals}})
      require(t->steps >= 0 && t->missed >= 0 && t->divided >= 0 && t->solved_again >= 0,
              fmt::format("{} has a negative number of steps", group));
  }

  Scene scene() const
  {
    try {
      return scene_of(c_.scene, name_);
    } catch (const ToolError& wrong) {
      fail(fmt::format("/scene is not a scene ({})", wrong.what()));
    }
  }

  void in_scene(const Scene& scene) const
  {
    require(c_.box.dimension == scene.dimension,
            fmt::format("/box/dimension is {}, and the dimension of /scene is {}", c_.box.dimension,
                        scene.dimension));
    require(c_.state.steps_done >= 0 && c_.state.steps_done <= scene.steps_in_all(),
            fmt::format("/state/steps_done is {}, and the run has {} steps", c_.state.steps_done,
                        scene.steps_in_all()));
    const double most = largest_radius * std::max(scene.large_diameter, scene.base_diameter);
    each(
        "/grains/radius", c_.grains.radius, [most](double radius) { return radius <= most; },
        "is larger than the diameters of large grains and base grains");
    require(c_.state.pairs.skin <= 2 * most, "/state/pairs/skin is larger than a large grain");
    const double end = farthest * scene.small_diameter;
    const auto check = [&](const char* path, const auto& positions) {
      each(
          path, positions, [end](const auto& x) { return x.cwiseAbs().maxCoeff() <= end; },
          "is farther than 1e12 d_S from the origin");
      not_crowded(path, positions, scene.small_diameter);
    };
    check("/state/position", c_.state.position);
    check("/state/pairs/made_at", c_.state.pairs.made_at);
  }

  /// Fails if many grains are in one place: the pairs of all with each other would fill the memory.
  template <class Positions>
  void not_crowded(const char* path, const Positions& positions, double cell) const
  {
    std::vector<std::array<std::int64_t, D>> cells(positions.size());
    for (std::size_t g = 0; g < cells.size(); ++g)
      for (std::size_t k = 0; k < D; ++k)
        cells[g][k] = std::llround(positions[g][static_cast<Eigen::Index>(k)] / cell);
    std::sort(cells.begin(), cells.end());
    for (std::size_t k = most_in_cell; k < cells.size(); ++k)
      require(cells[k] != cells[k - most_in_cell],
              fmt::format("{} has more than {} grains in one place", path, most_in_cell));
  }

  const Checkpoint<D>& c_;
  std::string name_;
};

}  // namespace

template <int D>
void check_checkpoint(const Checkpoint<D>& checkpoint, const std::string& name)
{
  Check<D>(checkpoint, name).all();
}

template void check_checkpoint(const Checkpoint<2>&, const std::string&);
template void check_checkpoint(const Checkpoint<3>&, const std::string&);

}  // namespace grseg
