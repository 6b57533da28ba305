// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/tool.hpp"
#include "formats/core/version.hpp"

#include <fmt/format.h>

namespace grseg {
namespace {

// CITATION.cff names the first two for GitHub and Zenodo.
constexpr const char* grseg_itself = R"(% the program
@software{{grseg,
  author  = {{{{The grseg developers}}}},
  title   = {{grseg: stress partition between small and large grains}},
  version = {{{}}},
  license = {{GPL-3.0-or-later}}
}}
)";

constexpr const char* sources = R"(
% the method; rule size
@article{StaronPhillips2015,
  author  = {Staron, L. and Phillips, J. C.},
  title   = {Stress partition and micro-structure in size-segregating granular flows},
  journal = {Physical Review E},
  year    = {2015}
}

% B
@article{GrayThornton2005,
  author  = {Gray, J. M. N. T. and Thornton, A. R.},
  title   = {A theory for particle size segregation in shallow granular free-surface flows},
  journal = {Proceedings of the Royal Society A},
  volume  = {461},
  pages   = {1447--1473},
  year    = {2005}
}

% rule contact-point, and stress of the base
@article{Weinhart2012,
  author  = {Weinhart, T. and Thornton, A. R. and Luding, S. and Bokhove, O.},
  title   = {From discrete particles to continuum fields near a boundary},
  journal = {Granular Matter},
  volume  = {14},
  pages   = {289--294},
  year    = {2012}
}

% rule contact-point, of species
@article{Tunuguntla2016,
  author  = {Tunuguntla, D. R. and Thornton, A. R. and Weinhart, T.},
  title   = {From discrete elements to continuum fields: Extension to bidisperse systems},
  journal = {Computational Particle Mechanics},
  volume  = {3},
  pages   = {349--365},
  year    = {2016},
  doi     = {10.1007/s40571-015-0087-y}
}

% rule half (LAMMPS and LIGGGHTS: compute stress/atom)
@article{Thompson2009,
  author  = {Thompson, A. P. and Plimpton, S. J. and Mattson, W.},
  title   = {General formulation of pressure and stress tensor for arbitrary many-body interaction
             potentials under periodic boundary conditions},
  journal = {The Journal of Chemical Physics},
  volume  = {131},
  pages   = {154107},
  year    = {2009}
}

% fields of a coarse-graining width (--assign gauss, lucy, heaviside; grseg-balance)
@article{Goldhirsch2010,
  author  = {Goldhirsch, I.},
  title   = {Stress, stress asymmetry and couple stress: from discrete particles to continuous fields},
  journal = {Granular Matter},
  volume  = {12},
  pages   = {239--252},
  year    = {2010}
}

% kinetic stress (grseg-kinetic, grseg-balance)
@article{HillTan2014,
  author  = {Hill, K. M. and Tan, D. S.},
  title   = {Segregation in dense sheared flows: gravity, temperature gradients, and stress
             partitioning},
  journal = {Journal of Fluid Mechanics},
  volume  = {756},
  pages   = {54--88},
  year    = {2014}
}
)";

}  // namespace

std::string citations()
{
  return fmt::format(grseg_itself, version()) + sources;
}

}  // namespace grseg
