// SPDX-License-Identifier: GPL-3.0-or-later
// Mutator for targets that read HDF5: it changes numbers inside the library's own structures more often
// than elsewhere, and then repairs their checksums. It learns from the seeds where these structures are.
#include "tests/fuzz/fuzz.hpp"
#include "tests/fuzz/hdf5_checksums.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace {

using namespace grseg::fuzz;

/// Positions of the structures of one seed.
struct Layout {
  std::string file;
  std::vector<ChecksummedPart> parts;

  /// The parts whose signature is still at its position.
  std::vector<ChecksummedPart> in_place(const std::uint8_t* data, std::size_t size) const
  {
    std::vector<ChecksummedPart> found;
    for (const auto& part : parts)
      if (part.end + 4 <= size && std::memcmp(data + part.begin, file.data() + part.begin, 4) == 0)
        found.push_back(part);
    return found;
  }
};
std::vector<Layout> layouts;

std::vector<ChecksummedPart> parts_in(const std::uint8_t* data, std::size_t size)
{
  std::vector<ChecksummedPart> best;
  for (const auto& layout : layouts) {
    auto parts = layout.in_place(data, size);
    if (parts.size() > best.size()) best = std::move(parts);
  }
  return best;
}

/// Writes a number that is often wrong as a size or address.
void overwrite(std::uint8_t* data, std::size_t begin, std::size_t end, std::minstd_rand& chance)
{
  constexpr std::int64_t telling[] = {
      0, 1, -1, 2, 127, 255, 65535, 0x7fffffff, 1LL << 40, 1LL << 61, INT64_MAX, INT64_MIN};
  if (end <= begin) return;
  const auto at = begin + chance() % (end - begin);
  const auto width = std::min(end - at, std::size_t{1} << chance() % 4);
  std::int64_t value = 0;
  std::memcpy(&value, data + at, width);
  switch (chance() % 4) {
    case 0:
      value ^= 1LL << chance() % (8 * width);
      break;
    case 1:
      value += static_cast<std::int64_t>(chance() % 16) - 8;
      break;
    case 2:
      value = static_cast<std::int64_t>(chance());
      break;
    default:
      value = telling[chance() % std::size(telling)];
  }
  std::memcpy(data + at, &value, width);
}

/// Chooses one of the parts, rarely one of a heap or a tree, because the library itself soon
/// crashes with these.
const ChecksummedPart& choose(const std::vector<ChecksummedPart>& parts, const std::uint8_t* data,
                              std::minstd_rand& chance)
{
  for (;;) {
    const auto& part = parts[chance() % parts.size()];
    const std::string_view signature(reinterpret_cast<const char*>(data) + part.begin, 2);
    const bool fragile = signature == "FR" || signature == "FH" || signature == "BT";
    if (!fragile || chance() % 100 == 0) return part;
  }
}

}  // namespace

/// Reads the undamaged files from the folders on the command line whose name says that they are seeds.
extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv)
{
  namespace fs = std::filesystem;
  for (int k = 1; k < *argc; ++k) {
    const fs::path folder((*argv)[k]);
    if (!fs::is_directory(folder) || folder.string().find("seeds") == std::string::npos) continue;
    for (const auto& entry : fs::directory_iterator(folder)) {
      std::ifstream in(entry.path(), std::ios::binary);
      Layout layout{{std::istreambuf_iterator<char>(in), {}}, {}};
      layout.parts = checksummed_parts(layout.file);
      layouts.push_back(std::move(layout));
    }
  }
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max_size, unsigned seed)
{
  std::minstd_rand chance(seed);
  const auto parts = parts_in(data, size);
  if (chance() % 8 == 0) size = LLVMFuzzerMutate(data, size, max_size);
  for (auto count = 1 + chance() % 3; count > 0 && size > 0; --count) {
    if (parts.empty() || chance() % 4 == 0) {
      overwrite(data, 0, size, chance);
    } else {
      const auto& part = choose(parts, data, chance);
      overwrite(data, std::min(part.begin, size), std::min(part.end, size), chance);
    }
  }
  if (chance() % 8 != 0) repair_checksums(parts, data, size);
  return size;
}
