// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/species.hpp"
#include "formats/trajectory/reader.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <string>

/// A frame of grseg in the files of MercuryDPM, written by the rules of its source.
namespace grseg::mercury_files {

struct Style {
  int format = 8;      // 7, 8, 14, 15
  bool flags = false;  // flags of parallel builds, at the end of each row of .data
  int point = 1;       // 1: cx cy cz are the contact point, 0: the middle of the centres
  double info = -1;    // number in the column of the species
};

/// A vector with three components, as in all files except those of format 8.
template <int D>
Vec3 in_space(const Vector<D>& v)
{
  Vec3 all = Vec3::Zero();
  all.head<D>() = v;
  return all;
}
inline Vec3 spin_in_space(double spin)
{
  return {0, 0, spin};
}
inline Vec3 spin_in_space(const Vec3& spin)
{
  return spin;
}

inline std::string text(const Vec3& v, int digits)
{
  return fmt::format("{:.{}g} {:.{}g} {:.{}g}", v.x(), digits, v.y(), digits, v.z(), digits);
}

template <int D>
std::string data(const Grains& grains, const Box& box, const Frame<D>& frame, const Style& style)
{
  const bool plane = style.format == 8;
  const double lx = box.length_x, ly = box.length_y;
  auto rows =
      plane ? fmt::format("{} {:.10g} 0 0 {:.15g} {:.15g}\n", grains.size(), frame.time, lx, ly)
            : fmt::format("{} {:.10g} 0 0 0 {}\n", grains.size(), frame.time,
                          text({lx, ly, box.length_z}, 15));
  for (std::size_t g = 0; g < grains.size(); ++g) {
    const Vec3 x = in_space<D>(frame.position[g]), v = in_space<D>(frame.velocity[g]);
    const Vec3 w = spin_in_space(frame.angular_velocity[g]);
    const double r = grains.radius[g];
    const double info =
        style.info >= 0 ? style.info : static_cast<double>(species_numbers(grains.species, 2)[g]);
    switch (style.format) {
      case 8:
        rows += fmt::format("{:.15g} {:.15g} {:.10g} {:.10g} {:.10g} 0 {:.10g} {}", x.x(), x.y(),
                            v.x(), v.y(), r, -w.z(), info);
        break;
      case 7:
        rows += fmt::format("{:.15g} {:.15g} {:.15g} {:.10g} {:.10g} {:.10g} {:.10g} {}", x.x(),
                            x.z(), x.y(), v.x(), v.z(), v.y(), r, info);
        break;
      default:
        rows += fmt::format("{} {} {:.10g} 0 0 0 {}{} {}", text(x, 15), text(v, 10), r, text(w, 10),
                            style.format == 15 ? " 3" : "", info);
    }
    rows += style.flags ? " 0 1\n" : "\n";
  }
  return rows;
}

inline std::string row(double time, std::int64_t i, std::int64_t j, const Vec3& c, double overlap,
                       const Vec3& force, const Vec3& n)
{
  const double fn = force.dot(n);
  const Vec3 slip = force - fn * n;
  const double ft = slip.norm();
  const Vec3 t = ft > 0 ? Vec3(slip / ft) : Vec3(0, 0, 0);
  return fmt::format("{:.10g} {} {} {} {:.10g} 0 {:.10g} {:.10g} {} {}\n", time, i, j, text(c, 10),
                     overlap, fn, ft, text(n, 10), text(t, 10));
}

/// Rows of contacts: pairs appear twice, unless one grain is fixed or they touch across the period;
/// walls with opposite sign.
template <int D>
std::string fstat(const Grains& grains, const Frame<D>& frame, const Style& style)
{
  auto rows = fmt::format("# {:.10g} {}\n# 0 0 0 1 1 0\n# 0 0 0 0 0 0\n", frame.time, style.point);
  const auto& contacts = frame.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto i = static_cast<std::size_t>(contacts.i[c]);
    const Vec3 branch = in_space<D>(contacts.branch[c]), n = branch.normalized();
    const Vec3 force = in_space<D>(contacts.force[c]), x = in_space<D>(frame.position[i]);
    const double overlap = -contacts.gap[c];
    if (contacts.j[c] < 0) {
      const Vec3 point = x - (grains.radius[i] - overlap / 2) * n;
      // n and t are reversed, fn and ft are not: the force is -(fn n + ft t).
      rows += row(frame.time, contacts.i[c], contacts.j[c], point, overlap, -force, -n);
      continue;
    }
    const auto j = static_cast<std::size_t>(contacts.j[c]);
    const double arm = style.point == 1 ? grains.radius[i] - overlap / 2 : branch.norm() / 2;
    const Vec3 point = x - arm * n;
    rows += row(frame.time, contacts.i[c], contacts.j[c], point, overlap, force, n);
    const bool direct = (x - in_space<D>(frame.position[j]) - branch).norm() < 1e-6;
    if (direct && !grains.fixed[j])
      rows += row(frame.time, contacts.j[c], contacts.i[c], point, overlap, -force, -n);
  }
  return rows;
}

/// Period along an axis of the archive.
struct Period {
  Vec3 normal;
  double left, right;
};

inline std::string restart(const Grains& grains, double step, const Vec3& gravity, int dimension,
                           const std::vector<Period>& periods)
{
  auto all = fmt::format(
      "MercuryDPM 0.14 name chute revision 5000\n"
      "dataFile    fileType ONE_FILE saveCount 10 counter 202 lastSavedTimeStep 2001\n"
      "xMin 0 xMax 1 yMin 0 yMax 1 zMin 0 zMax 0\n"
      "timeStep {:.15g} time 1 ntimeSteps 2001 timeMax 2\n"
      "systemDimensions {} particleDimensions {} gravity {} writeVTK 0 NO_FILE\n"
      "Species 3\n",
      step, dimension, dimension, text(gravity, 15));
  for (int k = 0; k < 3; ++k)
    all += fmt::format("LinearViscoelasticSpecies id {} density 1 stiffness 1 dissipation 1\n", k);
  all += fmt::format(
      "LinearViscoelasticMixedSpecies idA 1 idB 0 stiffness 1 dissipation 1\n"
      "Walls 1\nInfiniteWall id 0 indSpecies 0 position 0 0 0\n"
      "Boundaries {}\n",
      periods.size());
  for (const auto& [normal, left, right] : periods)
    all += fmt::format(
        "PeriodicBoundary id 0 normal {} distanceLeft {:.15g} distanceRight {:.15g} shift {}\n",
        text(normal, 15), left, right, text((right - left) * normal, 15));
  all += fmt::format("Particles {}\n", grains.size());
  for (std::size_t k = 0; k < grains.size(); ++k)
    all += fmt::format(
        "BaseParticle id {} indSpecies {} position 0 0 0 orientation 1 0 0 0 velocity 0 0 0 "
        "angularVelocity 0 0 0 force 0 0 0 torque 0 0 0 radius {:.15g} invMass {:.15g}\n",
        k, species_numbers(grains.species, 2)[k], grains.radius[k],
        grains.fixed[k] ? 0 : 1 / grains.mass[k]);
  return all + "Interactions 0\n";
}

inline std::string restart(const Grains& grains, const TrajectoryReader& run)
{
  return restart(grains, run.step(), in_space<2>(run.gravity<2>().start), 2,
                 {{{1, 0, 0}, 0, run.box().length_x}});
}

}  // namespace grseg::mercury_files
