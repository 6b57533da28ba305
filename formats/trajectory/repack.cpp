// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/trajectory/repack.hpp"

#include "formats/core/frame.hpp"

namespace grseg {

TrajectoryWriter copy_frames(const TrajectoryReader& run, std::size_t frames, const std::string& to,
                             const Parameters& parameters,
                             const std::vector<Observable>& observables,
                             const StorageSettings& storage)
{
  std::vector<std::vector<double>> series;
  series.reserve(observables.size());
  for (const auto& observable : observables) series.push_back(run.observable(observable.name));

  TrajectoryWriter writer(to,
                          {run.grains(), run.box(), parameters, observables, run.has_force(),
                           run.species(), run.grains_come_and_go()},
                          storage);
  std::vector<double> values(observables.size());
  with_dimension(run.dimension(), [&](auto d) {
    Frame<d> frame;
    for (std::size_t k = 0; k < frames; ++k) {
      run.read(k, frame, {.velocity = true, .contacts = true, .force = true});
      for (std::size_t q = 0; q < values.size(); ++q) values[q] = series[q][k];
      writer.append(frame, values);
    }
  });
  return writer;
}

void repack(const std::string& from, const std::string& to, const StorageSettings& storage)
{
  const TrajectoryReader run(from);
  copy_frames(run, run.size(), to, run.parameters(), run.observables(), storage).close();
}

}  // namespace grseg
