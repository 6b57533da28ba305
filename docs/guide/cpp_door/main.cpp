// SPDX-License-Identifier: GPL-3.0-or-later
// Mean contact force of each pair of species, N. Usage: mean_force RUN.h5
#include <formats/core/errors.hpp>
#include <formats/core/frame.hpp>
#include <formats/core/species.hpp>
#include <formats/trajectory/reader.hpp>

#include <algorithm>
#include <iostream>

int main(int, char** arguments)
try {
  const grseg::TrajectoryReader run(arguments[1]);
  const auto& grains = run.grains();
  const auto name = [&](std::size_t g) {
    return run.species()[std::size_t(grains.species[g])].name;
  };
  std::map<std::pair<std::string, std::string>, std::pair<double, double>> forces;  // sum, number
  grseg::with_dimension(run.dimension(), [&](auto d) {
    grseg::Frame<d> frame;
    for (std::size_t k = 0; k < run.size(); ++k) {
      run.read(k, frame);  // compares it with its digests
      for (std::size_t c = 0; c < frame.contacts.size(); ++c) {
        const auto [i, j] = grseg::partners(grains, frame, c);
        auto& [sum, number] = forces[std::minmax({name(i), j ? name(*j) : "base"})];
        sum += frame.contacts.force[c].norm();
        ++number;
      }
    }
  });
  for (const auto& [pair, force] : forces)
    std::cout << pair.first << '-' << pair.second << '\t' << force.first / force.second << '\n';
} catch (const grseg::ToolError& error) {  // one sentence: file, place, remedy
  std::cerr << error.what() << '\n';
  return error.code();
}
