// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/formats/import/mercury_files.hpp"

/// A frame of grseg as a .restart file of MercuryDPM, written by the rules of its source.
namespace grseg::mercury_files {

struct RestartStyle {
  std::string first_line = "MercuryDPM 1.0 name chute revision 7622ee90 repository none";
  bool contact_points = true;  // true for files since 2015
  std::string boundary = "";   // a line that replaces the period along x
  std::string of_system = "";  // text after the gravity
  int id_factor = 1;           // ids are rows times this
};

inline std::string header(const TrajectoryReader& run, double time, const RestartStyle& style)
{
  const Vec3 gravity = in_space<2>(run.gravity<2>().start);
  const std::string period = fmt::format(
      "PeriodicBoundary id 0 normal 1 0 0 scaleFactor 1 distanceLeft 0 distanceRight "
      "{0:.15g} shift {0:.15g} 0 0",
      run.box().length_x);
  return fmt::format(
      "{}\n"
      "dataFile    fileType ONE_FILE saveCount 10 counter 202 lastSavedTimeStep 2001\n"
      "interactionFile fileType NO_FILE saveCount 0 counter 0\n"
      "xMin 0 xMax {:.15g} yMin 0 yMax 1 zMin 0 zMax 0\n"
      "timeStep {:.15g} time {:.15g} ntimeSteps 2001 timeMax 2\n"
      "systemDimensions 2 particleDimensions 2 gravity {} backgroundDrag 0 writeVTK 0 0{}\n"
      "Species 3\n"
      "LinearViscoelasticSpecies id 0 density 1 stiffness 1 dissipation 1\n"
      "LinearViscoelasticSpecies id 1 density 1 stiffness 1 dissipation 1\n"
      "LinearViscoelasticMixedSpecies idA 1 idB 0 stiffness 1 dissipation 1\n"
      "LinearViscoelasticSpecies id 2 density 1 stiffness 1 dissipation 1\n"
      "LinearViscoelasticMixedSpecies idA 2 idB 0 stiffness 1 dissipation 1\n"
      "LinearViscoelasticMixedSpecies idA 2 idB 1 stiffness 1 dissipation 1\n"
      "Walls 2\n"
      "Coil id 1 indSpecies 0 position 0 0 0 length 3\n"
      "InfiniteWall id 2 indSpecies 0 position 0.3 {{floor}} 0 orientation 0 0 0 0 velocity 0 0 0 "
      "force 0 0 0 torque 0 0 0 normal 0 -1 0 factor 1\n"
      "Boundaries 2\nCubeInsertionBoundary id 0 maxFailed 10 posMin 0 0 0\n{}\n",
      style.first_line, run.box().length_x, run.step(), time, text(gravity, 15), style.of_system,
      style.boundary.empty() ? period : style.boundary);
}

inline std::string particles(const Grains& grains, const Frame<2>& frame, int id_factor)
{
  auto all = fmt::format("Particles {}\n", grains.size());
  for (std::size_t k = 0; k < grains.size(); ++k)
    all += fmt::format(
        "SphericalParticle id {} indSpecies {} position {} orientation 1 0 0 0 velocity {} "
        "angularVelocity 0 0 {:.15g} force {} torque 0 0 0 radius {:.15g} invMass {:.15g} "
        "timeStamp 0\n",
        static_cast<int>(k) * id_factor, species_numbers(grains.species, 2)[k],
        text(in_space<2>(frame.position[k]), 15), text(in_space<2>(frame.velocity[k]), 15),
        frame.angular_velocity[k], text(in_space<2>(frame.force[k]), 15), grains.radius[k],
        grains.fixed[k] ? 0 : 1 / grains.mass[k]);
  return all;
}

inline std::string interactions(const Grains& grains, const Frame<2>& frame,
                                const RestartStyle& style)
{
  const auto& contacts = frame.contacts;
  auto all = fmt::format("Interactions {}\n", contacts.size());
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const bool wall = contacts.j[c] < 0;
    const auto i = static_cast<std::size_t>(contacts.i[c]);
    const Vec3 branch = in_space<2>(contacts.branch[c]), n = branch.normalized();
    const Vec3 point =
        in_space<2>(frame.position[i]) - (grains.radius[i] + contacts.gap[c] / 2) * n;
    all += fmt::format(
        "LinearViscoelasticInteraction {} {} {} timeStamp 2001{} force {} torque 0 0 0\n",
        wall ? "particleWallIds" : "particleIds", contacts.i[c] * style.id_factor,
        wall ? -contacts.j[c] - 1 : contacts.j[c] * style.id_factor,
        style.contact_points ? " contactPoint " + text(point, 15) : "",
        text(in_space<2>(contacts.force[c]), 15));
  }
  return all + "hGrid method TOPDOWN\n";
}

/// Text of a whole .restart file; `floor` is the height of InfiniteWall 2.
inline std::string whole_restart(const TrajectoryReader& run, const Frame<2>& frame, double floor,
                                 const RestartStyle& style)
{
  auto all = header(run, frame.time, style);
  all.replace(all.find("{floor}"), 7, fmt::format("{:.15g}", floor));
  return all + particles(run.grains(), frame, style.id_factor) +
         interactions(run.grains(), frame, style);
}

/// A file of version 2 or 3: rows of numbers. The number of springs of each grain is its row modulo three.
inline std::string old_restart(const TrajectoryReader& run, const Frame<2>& frame, int version)
{
  const auto& grains = run.grains();
  auto all = fmt::format(
      "restart_version {0}\nname gravity\nxmin 0 xmax {1:.15g} ymin 0 ymax 1 zmin 0 zmax 0\n"
      "dt {2:.15g} t {3:.15g} tmax 2 save_count 10\ndim 2 gravity {4}\noptions_fstat 1\n"
      "Species 1\nk 20 disp 2 kt 5 dispt 2 mu 0.5 rho 1 dim_particle 2\n"
      "Walls 1\nInfiniteWall normal 0 0 -1 position -0\n",
      version, run.box().length_x, run.step(), frame.time,
      text(in_space<2>(run.gravity<2>().start), 15));
  all += fmt::format(
      fmt::runtime(version == 2 ? "WallsPeriodic 1\nnormal 1 0 0 pos_left 0 pos_right {:.15g}\n"
                                : "Boundaries 1\nPeriodicBoundary normal 1 0 0 position_left 0 "
                                  "position_right {:.15g}\n"),
      run.box().length_x);
  all += fmt::format("Particles {}\n", grains.size());
  for (std::size_t k = 0; k < grains.size(); ++k) {
    all += fmt::format("{}{} {} {:.15g} 0 0 0 0 0 {:.15g} {:.15g} 5", version == 3 ? "TSP BP " : "",
                       text(in_space<2>(frame.position[k]), 15),
                       text(in_space<2>(frame.velocity[k]), 15), grains.radius[k],
                       frame.angular_velocity[k], grains.fixed[k] ? 0 : 1 / grains.mass[k]);
    const std::size_t springs = k % 3;
    all += version == 3 ? fmt::format(" 0 {}", springs) : fmt::format(" {}", springs);
    for (std::size_t s = 0; s < springs * (version == 3 ? 12 : 6); ++s) all += " 7.5";
    all += "\n";
  }
  return all + "FixedParticleRadius 0.5\n";
}

}  // namespace grseg::mercury_files
