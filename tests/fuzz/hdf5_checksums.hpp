// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

/// Checksums that HDF5 stores for its metadata since its file format of 1.8 (Bob Jenkins' lookup3),
/// and their repair after bytes were changed. Without repair, a mutated file would be refused before
/// the rest of it is read.
namespace grseg::fuzz {

/// A structure of HDF5: its bytes from `begin` to `end`, and the position of their checksum, which
/// is computed as zero if it lies inside.
struct ChecksummedPart {
  std::size_t begin, end, checksum;
};

/// The structures of an undamaged file, found by their signatures and by the lengths for which the
/// checksum is correct.
std::vector<ChecksummedPart> checksummed_parts(std::string_view file);

/// Updates the checksums of all `parts` whose signature is unchanged.
void repair_checksums(const std::vector<ChecksummedPart>& parts, std::uint8_t* file,
                      std::size_t size);

}  // namespace grseg::fuzz
