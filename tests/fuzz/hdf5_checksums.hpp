// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

/// The checksums that HDF5 keeps of its metadata since its format of 1.8 (Bob Jenkins' lookup3), and
/// how to make them right again where bytes were changed: a mutated file would otherwise be refused
/// before the rest of it is looked at.
namespace grseg::fuzz {

/// A structure of the library's: its bytes from `begin` to `end`, and where the checksum of them
/// stands, which counts as zero if it lies inside.
struct ChecksummedPart {
  std::size_t begin, end, checksum;
};

/// The structures of a sound file, found by their signatures and by the lengths at which the
/// checksum agrees.
std::vector<ChecksummedPart> checksummed_parts(std::string_view file);

/// Sets the checksums of those `parts` whose signature is still in its place.
void repair_checksums(const std::vector<ChecksummedPart>& parts, std::uint8_t* file,
                      std::size_t size);

}  // namespace grseg::fuzz
