// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/facts/import_settings.hpp"

#include "formats/cli/output.hpp"
#include "formats/import/facts/units.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace grseg {
namespace {

namespace po = boost::program_options;

/// An option without default: `place` stays empty unless the option is given.
template <class Value>
auto optional(std::optional<Value>& place, const char* name)
{
  return po::value<Value>()->value_name(name)->notifier([&place](const Value& v) { place = v; });
}

/// An option without default whose value is one of `words`.
auto word(std::optional<std::string>& place, const std::vector<std::string>& words)
{
  return word_option(nullptr, words)->notifier([&place](const std::string& text) { place = text; });
}

auto files(std::vector<std::string>& place)
{
  return po::value(&place)->multitoken()->value_name("FILES");
}

po::options_description archive_options(ImportSettings& s)
{
  const auto all_formats = names_of_formats();
  std::vector<std::string> with_restart;
  for (const auto* format : archive_formats())
    if (format->takes_restart) with_restart.emplace_back(format->name);
  const auto formats = fmt::format("program: {}", fmt::join(all_formats, ", "));
  const auto restart =
      fmt::format("{} only: its restart file, with the facts that the other files lack",
                  fmt::join(with_restart, ", "));
  po::options_description archive("The archive");
  archive.add_options()("format", word_option(&s.format, all_formats), formats.c_str())(
      "grains", files(s.files.grains),
      "files with the grains, plain, .gz, .bz2, .xz or .zst; in their "
      "names '*' matches the step, '%' the processor")(
      "contacts", files(s.files.contacts), "files with the contacts, named as for --grains")(
      "restart", po::value(&s.files.restart)->value_name("FILE"), restart.c_str())(
      "columns", po::value(&s.files.columns)->value_name("MAP"),
      "meaning of the columns of the contacts, e.g. i=2,j=3,dist=4,force=5,tangential=8")(
      "begin", optional(s.begin, "T"),
      "leave out frames before this time, in the archive's units, or before step:N")(
      "end", optional(s.end, "T"), "leave out frames at and after this time, or step:N")(
      "repeated", word(s.repeated, words_of(repeated_words)),
      "job to import, first or last, if a later job began from an earlier checkpoint and repeats "
      "frames with other values")(
      "wall-contacts", files(s.files.wall_contacts),
      "liggghts only: files with the contacts with meshes (compute wall/gran/local)")(
      "wall-columns", po::value(&s.files.wall_columns)->value_name("MAP"),
      "meaning of the columns of --wall-contacts; lammps: columns of "
      "fix wall/gran in the grains, floor=f_floor[1]")(
      "map", po::value(&s.files.map)->composing()->value_name("NAME=COLUMN"),
      "NAME= leaves a column of grains out; csv: meaning of columns with other names, e.g. "
      "particle1=i,Fx=fx, or by their numbers, 1=id,2=x; row=id: the id is the number of the row")(
      "drop-incomplete", po::bool_switch(&s.drop_incomplete),
      "leave out incomplete frames, at the end of a text archive or of a job that was cut off");
  return archive;
}

po::options_description fact_options(ImportSettings& s)
{
  po::options_description facts("Facts that the archive does not state (in its own units)");
  facts.add_options()("units", word(s.units, words_of(unit_words)),
                      "si, cgs, or the archive's units as LENGTH:TIME:MASS in m, s, kg")(
      "step", optional(s.step, "DT"), "length of a time step")(
      "frame-interval", optional(s.interval, "T"),
      "time between two frames, if the archive numbers its frames and states no steps")(
      "gravity", optional(s.gravity, "G"),
      "vector GX,GY,GZ, or its magnitude together with --slope")(
      "slope", optional(s.slope, "DEGREES"),
      "inclination of the base; if --gravity is a vector, the axes are rotated to this slope")(
      "grains-are", word(s.grains, words_of(grain_words)), "shape of the grains: discs or spheres")(
      "density", optional(s.density, "RHO"),
      "density of the grains: mass per area of discs, per volume of spheres")(
      "axes", optional(s.axes, "XY"),
      "axes of the flow: along the base, away from it (default: xy)")(
      "dimension", optional(s.dimension, "D"),
      "dimension of the flow, 2 or 3 (default: 3 for spheres that do not lie in one plane)")(
      "origin", word_option(&s.origin, words_of(origin_words)),
      "height of y = 0: top or centre of the base grains, or a height in the archive")(
      "cell", po::value(&s.cells)->composing()->value_name("AXIS:LOW:HIGH"),
      "bounds of the cell along an axis, once for each axis: x:0:0.4, or x:0:0.4:periodic")(
      "wall", po::value(&s.walls)->composing()->value_name("NAME=AXIS:POSITION"),
      "a plane wall whose contacts the archive lacks, once for each wall: floor=z:0");
  return facts;
}

po::options_description species_options(SpeciesSettings& species)
{
  po::options_description sizes("Species");
  sizes.add_options()("species", po::value(&species.named)->composing()->value_name("NAME=TYPES"),
                      "a species, once for each species: mobile grains of these types, "
                      "or all; NAME=TYPES:D sets its nominal diameter")(
      "small", optional(species.small, "TYPES"), "types of small grains: 1 or 1,4-6")(
      "large", optional(species.large, "TYPES"), "types of large grains")(
      "split-diameter", optional(species.split_diameter, "D"),
      "smallest diameter of large grains (default: half-way between two sizes far apart)")(
      "boundary", optional(species.boundary, "TYPES"),
      "types of base grains, or none if there is no base")(
      "boundary-ids", optional(species.boundary_ids, "IDS"), "base grains by id: 1-35,70")(
      "small-diameter", optional(species.small_diameter, "D"),
      "nominal diameter of small grains, the unit of length in analyses (default: mid-range)")(
      "large-diameter", optional(species.large_diameter, "D"),
      "nominal diameter of large grains (default: mid-range)");
  return sizes;
}

po::options_description output_options(ImportSettings& s)
{
  po::options_description output("The trajectory");
  output.add_options()("output,o", po::value(&s.output)->value_name("FILE"),
                       "trajectory file to write")(
      "accept-residual", po::value(&s.accept_residual)->composing()->value_name("NAME=R"),
      "accept the result of a failed check up to R, as in balance=0.1 (of the largest force) or "
      "overlap=0.6 (of a radius); messages name the check")(
      "strict", po::bool_switch(&s.strict),
      "also refuse an archive if a check is undecided (exit code 4)")(
      "compression", po::value(&s.storage.compression)->default_value(0)->value_name("LEVEL"),
      "deflate level, 0 to 9")("float32", po::bool_switch(&s.storage.float32),
                               "write single precision: half the size")(
      "quiet", po::bool_switch(&s.quiet), "print no summary on standard error");

  add_overwrite_to(output, s.overwrite);
  return output;
}

}  // namespace

po::options_description import_options(ImportSettings& s)
{
  po::options_description all;
  all.add(archive_options(s)).add(fact_options(s)).add(species_options(s.species));
  all.add(output_options(s));
  return all;
}

}  // namespace grseg
