// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a checkpoint and continues the simulation from it.
#include "sim/run/restart.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  using namespace grseg;
  static fuzz::ScratchFile file("run.chk");
  file.write(fuzz::text_of(data, size));
  fuzz::try_to([&] {
    std::visit(
        [](const auto& checkpoint) {
          const auto scene = scene_of(checkpoint.scene, file.path());
          auto simulation = restored_simulation(checkpoint, scene, scene, {});
          simulation.advance();
        },
        read_checkpoint(file.path()));
  });
  return 0;
}
