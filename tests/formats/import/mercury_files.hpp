// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/species.hpp"
#include "formats/trajectory/reader.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <string>

/// A frame of grseg in the files of MercuryDPM, by the rules of its own source.
namespace grseg::mercury_files {

struct Style {
  int format = 8;      // 7, 8, 14, 15
  bool flags = false;  // of parallel builds, behind each row of .data
  int point = 1;       // 1: cx cy cz are the contact point, 0: the middle of the centres
  double info = -1;    // instead of the species
};

inline std::string data(const Grains& grains, const Box& box, const Frame<2>& frame,
                        const Style& style)
{
  const bool plane = style.format == 8;
  const double lx = box.length_x, ly = box.length_y;
  auto text =
      plane
          ? fmt::format("{} {:.10g} 0 0 {:.15g} {:.15g}\n", grains.size(), frame.time, lx, ly)
          : fmt::format("{} {:.10g} 0 0 0 {:.15g} {:.15g} 0\n", grains.size(), frame.time, lx, ly);
  for (std::size_t g = 0; g < grains.size(); ++g) {
    const Vec2 x = frame.position[g], v = frame.velocity[g];
    const double w = frame.angular_velocity[g], r = grains.radius[g];
    const double info = style.info >= 0 ? style.info : static_cast<double>(species_numbers(grains.species, 2)[g]);
    switch (style.format) {
      case 8:
        text += fmt::format("{:.15g} {:.15g} {:.10g} {:.10g} {:.10g} 0 {:.10g} {}", x.x(), x.y(),
                            v.x(), v.y(), r, -w, info);
        break;
      case 7:
        text += fmt::format("{:.15g} 0 {:.15g} {:.10g} 0 {:.10g} {:.10g} {}", x.x(), x.y(), v.x(),
                            v.y(), r, info);
        break;
      default:
        text += fmt::format("{:.15g} {:.15g} 0 {:.10g} {:.10g} 0 {:.10g} 0 0 0 0 0 {:.10g}{} {}",
                            x.x(), x.y(), v.x(), v.y(), r, w, style.format == 15 ? " 3" : "", info);
    }
    text += style.flags ? " 0 1\n" : "\n";
  }
  return text;
}

inline std::string row(double time, std::int64_t i, std::int64_t j, const Vec2& c, double overlap,
                       const Vec2& force, const Vec2& n)
{
  const double fn = force.dot(n);
  const Vec2 slip = force - fn * n;
  const double ft = slip.norm();
  const Vec2 t = ft > 0 ? Vec2(slip / ft) : Vec2(0, 0);
  return fmt::format(
      "{:.10g} {} {} {:.10g} {:.10g} 0 {:.10g} 0 {:.10g} {:.10g} {:.10g} {:.10g} 0 {:.10g} {:.10g} "
      "0\n",
      time, i, j, c.x(), c.y(), overlap, fn, ft, n.x(), n.y(), t.x(), t.y());
}

/// Pairs twice, unless one is fixed or they touch across the period; walls the other way round.
inline std::string fstat(const Grains& grains, const Frame<2>& frame, const Style& style)
{
  auto text = fmt::format("# {:.10g} {}\n# 0 0 0 1 1 0\n# 0 0 0 0 0 0\n", frame.time, style.point);
  const auto& contacts = frame.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto i = static_cast<std::size_t>(contacts.i[c]);
    const Vec2 branch = contacts.branch[c], n = branch.normalized(), force = contacts.force[c];
    const double overlap = -contacts.gap[c];
    if (contacts.j[c] < 0) {
      const Vec2 point = frame.position[i] - (grains.radius[i] - overlap / 2) * n;
      // n and t are turned round, fn and ft are not: the force is -(fn n + ft t).
      text += row(frame.time, contacts.i[c], contacts.j[c], point, overlap, -force, -n);
      continue;
    }
    const auto j = static_cast<std::size_t>(contacts.j[c]);
    const double arm = style.point == 1 ? grains.radius[i] - overlap / 2 : branch.norm() / 2;
    const Vec2 point = frame.position[i] - arm * n;
    text += row(frame.time, contacts.i[c], contacts.j[c], point, overlap, force, n);
    const bool direct = (frame.position[i] - frame.position[j] - branch).norm() < 1e-6;
    if (direct && !grains.fixed[j])
      text += row(frame.time, contacts.j[c], contacts.i[c], point, overlap, -force, -n);
  }
  return text;
}

inline std::string restart(const Grains& grains, const TrajectoryReader& run)
{
  const Vec2 g = run.gravity<2>().start;
  const double length = run.box().length_x;
  auto text = fmt::format(
      "MercuryDPM 0.14 name chute revision 5000\n"
      "dataFile    fileType ONE_FILE saveCount 10 counter 202 lastSavedTimeStep 2001\n"
      "xMin 0 xMax {} yMin 0 yMax 1 zMin 0 zMax 0\n"
      "timeStep {:.15g} time 1 ntimeSteps 2001 timeMax 2\n"
      "systemDimensions 2 particleDimensions 2 gravity {:.15g} {:.15g} 0 writeVTK 0 NO_FILE\n"
      "Species 3\n",
      length, run.step(), g.x(), g.y());
  for (int k = 0; k < 3; ++k)
    text += fmt::format("LinearViscoelasticSpecies id {} density 1 stiffness 1 dissipation 1\n", k);
  text += fmt::format(
      "LinearViscoelasticMixedSpecies idA 1 idB 0 stiffness 1 dissipation 1\n"
      "Walls 1\nInfiniteWall id 0 indSpecies 0 position 0 0 0\n"
      "Boundaries 1\nPeriodicBoundary id 0 normal 1 0 0 distanceLeft 0 distanceRight {:.15g} "
      "shift {:.15g} 0 0\nParticles {}\n",
      length, length, grains.size());
  for (std::size_t k = 0; k < grains.size(); ++k)
    text += fmt::format(
        "BaseParticle id {} indSpecies {} position 0 0 0 orientation 1 0 0 0 velocity 0 0 0 "
        "angularVelocity 0 0 0 force 0 0 0 torque 0 0 0 radius {:.15g} invMass {:.15g}\n",
        k, species_numbers(grains.species, 2)[k], grains.radius[k],
        grains.fixed[k] ? 0 : 1 / grains.mass[k]);
  return text + "Interactions 0\n";
}

}  // namespace grseg::mercury_files
