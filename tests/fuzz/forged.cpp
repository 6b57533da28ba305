// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a checkpoint with changed numbers and a matching digest, and continues the simulation from it.
// Eleven bytes of an input are one change: which number, its position (2 bytes), the value (8 bytes).
#include "sim/run/restart.hpp"
#include "tests/fuzz/fuzz.hpp"

#include <bit>
#include <cstring>
#include <filesystem>

namespace {

using namespace grseg;

constexpr std::size_t change_size = 11;

/// An undamaged checkpoint, which scripts/fuzz writes beside the programs.
const Checkpoint<2>& sound_checkpoint()
{
  static const Checkpoint<2> sound = std::get<Checkpoint<2>>(
      read_checkpoint(std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path() /
                      "seeds/checkpoint/run.chk"));
  return sound;
}

template <class T>
T& at(std::vector<T>& values, std::size_t where)
{
  return values[where % values.size()];
}

void change(Checkpoint<2>& forged, std::uint8_t what, std::size_t where, std::int64_t value)
{
  const auto number = std::bit_cast<double>(value);
  const auto small = static_cast<std::int32_t>(value);
  auto& state = forged.state;
  switch (what % 16) {
    case 0:
      at(state.row, where) = small;
      break;
    case 1:
      state.steps_done = value;
      break;
    case 2:
      at(forged.grains.species, where) = static_cast<Species>(small);
      break;
    case 3:
      at(forged.grains.radius, where) = number;
      break;
    case 4:
      at(forged.grains.mass, where) = number;
      break;
    case 5:
      at(forged.grains.fixed, where) = static_cast<std::uint8_t>(value);
      break;
    case 6:
      at(state.position, where).x() = number;
      break;
    case 7:
      at(state.velocity, where).y() = number;
      break;
    case 8:
      at(state.image, where)[0] = small;
      break;
    case 9:
      forged.box.length_x = number;
      break;
    case 10:
      forged.trajectory.frames = static_cast<std::uint64_t>(value);
      break;
    case 11:
      forged.trajectory.begin = number;
      break;
    case 12:
      forged.deposited_height = number;
      break;
    case 13:
      forged.scene[where % forged.scene.size()] = static_cast<char>(value);
      break;
    case 14:
      state.position.resize(where % 64);
      break;
    default:
      forged.grains.id.resize(where % 64);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const std::string path = fuzz::ScratchFile("forged").path();
  auto forged = sound_checkpoint();
  for (; size >= change_size; data += change_size, size -= change_size) {
    std::uint16_t where = 0;
    std::int64_t value = 0;
    std::memcpy(&where, data + 1, sizeof where);
    std::memcpy(&value, data + 3, sizeof value);
    change(forged, data[0], where, value);
  }
  fuzz::try_to([&] {
    write_checkpoint(path, forged);
    std::visit(
        [](const auto& checkpoint) {
          const auto scene = scene_of(checkpoint.scene, path);
          restored_simulation(checkpoint, scene, scene, {}).advance();
        },
        read_checkpoint(path));
  });
  std::filesystem::remove(path);
  return 0;
}
