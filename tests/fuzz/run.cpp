// SPDX-License-Identifier: GPL-3.0-or-later
// Opens a trajectory file and reads it completely, as grseg-check --deep does. Half of the inputs
// are read without checking digests, since no mutation passes this check.
#include "formats/core/frame.hpp"
#include "formats/trajectory/layout_check.hpp"
#include "formats/trajectory/reader.hpp"
#include "tests/fuzz/fuzz.hpp"

#include <functional>

namespace {

using namespace grseg;

template <int D>
void read(const TrajectoryReader& run)
{
  const auto grains = run.grains().size();
  fuzz::require(run.steps().size() == run.size() && run.times().size() == run.size(),
                "every frame has its step and its time");
  Frame<D> frame;
  for (std::size_t n = 0; n < run.size(); ++n)
    fuzz::try_to([&] {
      run.read(n, frame, {true, true, true});
      fuzz::require(frame.position.size() == grains && frame.velocity.size() == grains,
                    "a row for each grain");
      for (std::size_t c = 0; c < frame.contacts.size(); ++c)
        fuzz::require(frame.contacts.i[c] >= 0 &&
                          frame.contacts.i[c] < static_cast<std::int32_t>(grains) &&
                          frame.contacts.j[c] < static_cast<std::int32_t>(grains),
                      "i and j are rows of grains");
    });
  fuzz::try_to([&] { run.gravity<D>(); });
  for (const auto& observable : run.observables())
    fuzz::try_to([&] { run.observable(observable.name); });
  fuzz::try_to([&] { check_layout(run); });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static fuzz::ScratchFile file("run.h5");
  const auto bytes = fuzz::text_of(data, size);
  file.write(bytes);
  const auto verify = std::hash<std::string_view>()(bytes) % 2 == 0 ? Verify::yes : Verify::no;
  fuzz::try_to([&] {
    const TrajectoryReader run(file.path(), verify);
    with_dimension(run.dimension(), [&](auto d) { read<d>(run); });
  });
  return 0;
}
