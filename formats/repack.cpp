// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/repack.hpp"

#include "formats/trajectory_reader.hpp"

namespace grseg {

void repack(const std::string& from, const std::string& to, const StorageSettings& storage)
{
  const TrajectoryReader run(from);
  const auto observables = run.observables();
  std::vector<std::vector<double>> series;
  series.reserve(observables.size());
  for (const auto& observable : observables) series.push_back(run.observable(observable.name));

  TrajectoryWriter writer(to, {run.grains(), run.box(), run.parameters(), observables}, storage);
  Frame frame;
  std::vector<double> values(observables.size());
  for (std::size_t k = 0; k < run.size(); ++k) {
    run.read(k, frame, {.velocity = true, .contacts = true, .force = true});
    for (std::size_t q = 0; q < values.size(); ++q) values[q] = series[q][k];
    writer.append(frame, values);
  }
  writer.close();
}

}  // namespace grseg
