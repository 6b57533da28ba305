// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/hdf5_checksums.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>
#include <string>

namespace grseg::fuzz {
namespace {

constexpr std::size_t longest = 16384;
constexpr std::size_t signature_size = 4, checksum_size = 4;
constexpr std::array signatures = {"\x89HDF", "OHDR", "OCHK", "EAHD", "EAIB", "EASB",
                                   "EADB",    "FAHD", "FADB", "FRHP", "FHIB", "BTHD",
                                   "BTLF",    "BTIN", "SMTB", "SMLI"};

std::uint32_t word(const char* bytes, std::size_t count)
{
  std::uint32_t value = 0;
  std::memcpy(&value, bytes, count);
  return value;
}

struct Lookup3 {
  std::uint32_t a, b, c;

  void mix()
  {
    const auto turn = [](std::uint32_t& x, std::uint32_t& z, std::uint32_t y, int by) {
      x = (x - z) ^ std::rotl(z, by);
      z += y;
    };
    turn(a, c, b, 4), turn(b, a, c, 6), turn(c, b, a, 8);
    turn(a, c, b, 16), turn(b, a, c, 19), turn(c, b, a, 4);
  }
  void finish()
  {
    const auto turn = [](std::uint32_t& x, std::uint32_t y, int by) {
      x = (x ^ y) - std::rotl(y, by);
    };
    turn(c, b, 14), turn(a, c, 11), turn(b, a, 25), turn(c, b, 16);
    turn(a, c, 4), turn(b, a, 14), turn(c, b, 24);
  }
};

/// H5_checksum_lookup3 of HDF5, on a little-endian machine.
std::uint32_t checksum_of(std::string_view bytes)
{
  const auto start = 0xdeadbeefU + static_cast<std::uint32_t>(bytes.size());
  Lookup3 state{start, start, start};
  const char* at = bytes.data();
  auto left = bytes.size();
  for (; left > 12; left -= 12, at += 12) {
    state.a += word(at, 4);
    state.b += word(at + 4, 4);
    state.c += word(at + 8, 4);
    state.mix();
  }
  if (left == 0) return state.c;
  state.a += word(at, std::min<std::size_t>(left, 4));
  if (left > 4) state.b += word(at + 4, std::min<std::size_t>(left - 4, 4));
  if (left > 8) state.c += word(at + 8, left - 8);
  state.finish();
  return state.c;
}

/// A structure whose checksum follows it.
std::optional<ChecksummedPart> part_at(std::string_view file, std::size_t begin)
{
  const auto last = std::min(file.size() - checksum_size, begin + longest);
  for (auto end = begin + signature_size; end <= last; ++end)
    if (checksum_of(file.substr(begin, end - begin)) == word(file.data() + end, checksum_size))
      return ChecksummedPart{begin, end, end};
  return {};
}

/// A block of a heap, whose checksum is inside it.
std::optional<ChecksummedPart> heap_block_at(std::string_view file, std::size_t begin)
{
  for (std::size_t size = 512; size <= longest && begin + size <= file.size(); size *= 2)
    for (std::size_t offset_size = 1; offset_size <= 8; ++offset_size) {
      const auto at = signature_size + 1 + 8 + offset_size;
      std::string block(file.substr(begin, size));
      const auto stored = word(block.data() + at, checksum_size);
      block.replace(at, checksum_size, checksum_size, '\0');
      if (checksum_of(block) == stored) return ChecksummedPart{begin, begin + size, begin + at};
    }
  return {};
}

}  // namespace

std::vector<ChecksummedPart> checksummed_parts(std::string_view file)
{
  std::vector<ChecksummedPart> parts;
  for (std::size_t at = 0; at + 2 * signature_size < file.size(); ++at) {
    const auto signature = file.substr(at, signature_size);
    const bool known =
        std::find(signatures.begin(), signatures.end(), signature) != signatures.end();
    const auto part = known                 ? part_at(file, at)
                      : signature == "FHDB" ? heap_block_at(file, at)
                                            : std::nullopt;
    if (part) parts.push_back(*part);
  }
  return parts;
}

void repair_checksums(const std::vector<ChecksummedPart>& parts, std::uint8_t* file,
                      std::size_t size)
{
  for (const auto& [begin, end, checksum] : parts) {
    if (std::max(end, checksum + checksum_size) > size) continue;
    if (checksum < end) std::memset(file + checksum, 0, checksum_size);
    const auto sum = checksum_of({reinterpret_cast<const char*>(file) + begin, end - begin});
    std::memcpy(file + checksum, &sum, checksum_size);
  }
}

}  // namespace grseg::fuzz
