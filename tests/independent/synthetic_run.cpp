// SPDX-License-Identifier: GPL-3.0-or-later
// Writes a run of discs or spheres without any symmetry: oblique contacts of all pairs of species,
// forces and velocities with all components, sizes that differ within a species. The only law of
// mechanics that it obeys is the force balance of each grain.
// Usage: synthetic_run FILE DIMENSION NAME,NAME,... [changing]    species by increasing diameter;
// changing: in each frame other mobile grains are absent
#include "formats/core/frame.hpp"
#include "formats/trajectory/writer.hpp"

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace grseg;

constexpr int mobile = 160, fixed = 24, frames = 8, steps_apart = 100;
constexpr double step = 1e-4, smallest = 0.005, ratio = 1.5, height = 0.09;

template <int D>
class Synthetic {
 public:
  Synthetic(const std::vector<std::string>& names, bool changing)
  {
    run_.grains_come_and_go = changing;
    run_.box = {0.1, height, true};
    if (D == 3) run_.box = {0.1, height, true, 3, 0.07, true};
    double diameter = smallest;
    for (const auto& name : names) {
      run_.species.push_back({name, diameter});
      diameter *= ratio;
    }
    add_grains();
    gravity_ = Vector<D>::Constant(0.7);
    gravity_.x() = 4;
    gravity_.y() = -9;
    run_.parameters.numbers = {
        {"gravity", {gravity_.begin(), gravity_.end()}},    {"step", {step}},
        {"frame_interval", {steps_apart * step}},           {"small_diameter", {smallest}},
        {"large_diameter", {run_.species.back().diameter}}, {"density", {D == 2 ? 1.0 : 2500.0}}};
    run_.parameters.texts = {{"history", "synthetic_run"}};
  }

  const RunDescription& description() const { return run_; }

  Frame<D> frame(int number)
  {
    Frame<D> f;
    f.step = number * steps_apart;
    f.time = (static_cast<double>(f.step) + 0.5) * step;
    for (std::size_t g = 0; g < run_.grains.size(); ++g) {
      if (run_.grains.fixed[g] != 0)
        f.position.push_back(on_the_base());
      else
        place_beside_another(g, f);
      f.image.push_back({});
    }
    add_walls(f);
    std::vector<bool> absent(run_.grains.size());
    if (run_.grains_come_and_go) absent = remove_some(f);
    add_motion(f);
    for (std::size_t g = 0; g < absent.size(); ++g)
      if (absent[g]) make_absent(f, g);
    return f;
  }

 private:
  double uniform(double low, double high)
  {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Vector<D> vector(double size)
  {
    Vector<D> v;
    for (auto& component : v) component = uniform(-size, size);
    return v;
  }

  void add_grains();
  Vector<D> on_the_base();
  void place_beside_another(std::size_t g, Frame<D>& f);
  void add_contact(std::size_t i, std::int32_t j, const Vector<D>& branch, double gap,
                   ContactList<D>& contacts);
  void add_walls(Frame<D>& f);
  std::vector<bool> remove_some(Frame<D>& f);
  void add_motion(Frame<D>& f);

  RunDescription run_;
  Vector<D> gravity_;
  std::mt19937_64 random_{16};
};

/// Adds boundary grains first, then the species in turn.
template <int D>
void Synthetic<D>::add_grains()
{
  auto& grains = run_.grains;
  const double density = D == 2 ? 1 : 2500;
  for (int g = 0; g < fixed + mobile; ++g) {
    const bool base = g < fixed;
    const auto species = static_cast<std::size_t>(g) % run_.species.size();
    const double nominal = base ? smallest : run_.species[species].diameter / 2;
    grains.id.push_back(g + 1);
    grains.species.push_back(base ? Species::boundary : static_cast<Species>(species));
    grains.radius.push_back(nominal * uniform(0.9, 1.1));
    grains.mass.push_back(density * grain_volume<D>(grains.radius.back()));
    grains.fixed.push_back(base ? 1 : 0);
  }
}

template <int D>
Vector<D> Synthetic<D>::on_the_base()
{
  Vector<D> x = Vector<D>::Constant(-smallest / 2);
  x.x() = uniform(0, run_.box.length_x);
  if constexpr (D == 3) x.z() = uniform(0, run_.box.length_z);
  return x;
}

/// Position of a grain that touches a placed one, in a random direction in which it stays above the base.
template <int D>
void Synthetic<D>::place_beside_another(std::size_t g, Frame<D>& f)
{
  const auto& radius = run_.grains.radius;
  const auto wrap = [](double& x, double length) { x -= length * std::floor(x / length); };
  for (;;) {
    const auto other = static_cast<std::size_t>(uniform(0, static_cast<double>(g)));
    const double gap = smallest * uniform(-0.02, 0.005);
    const Vector<D> branch = (radius[g] + radius[other] + gap) * vector(1).normalized();
    Vector<D> x = f.position[other] + branch;
    if (x.y() < radius[g] || x.y() > height) continue;
    wrap(x.x(), run_.box.length_x);
    if constexpr (D == 3) wrap(x.z(), run_.box.length_z);
    f.position.push_back(x);
    const bool first = run_.grains.fixed[other] != 0 || uniform(0, 1) < 0.5;
    add_contact(first ? g : other, static_cast<std::int32_t>(first ? other : g),
                first ? branch : Vector<D>(-branch), gap, f.contacts);
    return;
  }
}

/// Random force: repulsive, with friction in any direction; one in eight is zero.
template <int D>
void Synthetic<D>::add_contact(std::size_t i, std::int32_t j, const Vector<D>& branch, double gap,
                               ContactList<D>& contacts)
{
  contacts.i.push_back(static_cast<std::int32_t>(i));
  contacts.j.push_back(j);
  contacts.branch.push_back(branch);
  contacts.gap.push_back(gap);
  const Vector<D> force = uniform(0.5, 1.5) * branch.normalized() + vector(0.4);
  contacts.force.push_back(contacts.size() % 8 == 0 ? Vector<D>(Vector<D>::Zero()) : force);
}

/// Adds contacts of the lowest grains with straight wall 0, y = 0.
template <int D>
void Synthetic<D>::add_walls(Frame<D>& f)
{
  for (std::size_t g = fixed; g < run_.grains.size(); ++g) {
    const double y = f.position[g].y();
    if (y > 1.2 * run_.grains.radius[g]) continue;
    add_contact(g, -1, y * Vector<D>::Unit(1), y - run_.grains.radius[g], f.contacts);
  }
}

/// Makes randomly chosen mobile grains absent and removes their contacts.
template <int D>
std::vector<bool> Synthetic<D>::remove_some(Frame<D>& f)
{
  std::vector<bool> absent(run_.grains.size());
  for (std::size_t g = fixed; g < absent.size(); ++g) absent[g] = uniform(0, 1) < 0.15;
  const auto all = std::exchange(f.contacts, {});
  for (std::size_t c = 0; c < all.size(); ++c) {
    const auto i = all.i[c], j = all.j[c];
    if (absent[static_cast<std::size_t>(i)] || (j >= 0 && absent[static_cast<std::size_t>(j)]))
      continue;
    f.contacts.i.push_back(i);
    f.contacts.j.push_back(j);
    f.contacts.force.push_back(all.force[c]);
    f.contacts.branch.push_back(all.branch[c]);
    f.contacts.gap.push_back(all.gap[c]);
  }
  return absent;
}

/// A sheared flow with fluctuations; forces on grains balance those of contacts.
template <int D>
void Synthetic<D>::add_motion(Frame<D>& f)
{
  const auto& grains = run_.grains;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    const bool still = grains.fixed[g] != 0;
    const Vector<D> flow = (0.2 + 3 * f.position[g].y()) * Vector<D>::Unit(0);
    f.velocity.push_back(still ? Vector<D>(Vector<D>::Zero()) : Vector<D>(flow + vector(0.1)));
    const Vec3 spin =
        still ? Vec3(Vec3::Zero()) : Vec3(uniform(-9, 9), uniform(-9, 9), uniform(-9, 9));
    if constexpr (D == 2)
      f.angular_velocity.push_back(spin.z());
    else
      f.angular_velocity.push_back(spin);
    f.force.push_back(still ? Vector<D>(Vector<D>::Zero()) : Vector<D>(grains.mass[g] * gravity_));
  }
  const auto& contacts = f.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    f.force[static_cast<std::size_t>(contacts.i[c])] += contacts.force[c];
    const auto j = contacts.j[c];
    if (j >= fixed) f.force[static_cast<std::size_t>(j)] -= contacts.force[c];
  }
}

template <int D>
void write(const std::string& path, const std::vector<std::string>& names, bool changing)
{
  Synthetic<D> synthetic(names, changing);
  TrajectoryWriter writer(path, synthetic.description());
  for (int number = 0; number < frames; ++number) writer.append(synthetic.frame(number), {});
  writer.close();
}

}  // namespace

int main(int argc, char** argv)
{
  const bool changing = argc == 5 && std::string(argv[4]) == "changing";
  if (argc != 4 && !changing) {
    std::cerr << "synthetic_run: FILE DIMENSION NAME,NAME,... [changing]\n";
    return 2;
  }
  std::vector<std::string> names;
  std::istringstream list(argv[3]);
  for (std::string name; std::getline(list, name, ',');) names.push_back(name);
  with_dimension(std::atoi(argv[2]), [&](auto d) { write<d>(argv[1], names, changing); });
  return 0;
}
