// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/trajectory/chunk.hpp"
#include "formats/trajectory/hdf5.hpp"

#include <deque>
#include <memory>
#include <vector>

namespace grseg {

/// Reads rows of a dataset as double (H5T_FLOAT) or std::int32_t (H5T_INTEGER). HDF5 knows no
/// threads and would decompress within its calls. So where a dataset is compressed as grseg does
/// it, its chunks are read as they are, and unpacking is left to the caller's threads. HDF5 itself
/// reads all other datasets.
class RowReader {
 public:
  RowReader() = default;
  explicit RowReader(hdf5::CheckedDataset dataset);

  const std::string& path() const { return dataset_.path(); }
  bool stores_float32() const { return dataset_.stores_float32(); }

  /// Reads rows [first, first + count) to `data`; rows still to be unpacked to there are appended
  /// to `packed`. FormatError naming the dataset where they cannot be read.
  void load(hsize_t first, hsize_t count, void* data, std::vector<PackedRows>& packed) const;

 private:
  std::shared_ptr<const Chunk> chunk(std::size_t number) const;

  hdf5::CheckedDataset dataset_;
  hid_t memory_type_ = H5I_INVALID_HID;
  std::shared_ptr<const ChunkLayout> layout_;              // none: HDF5 reads the dataset
  hsize_t most_bytes_ = 0;                                 // of a chunk as stored
  mutable std::deque<std::shared_ptr<const Chunk>> kept_;  // the latest, which hold several frames
};

}  // namespace grseg
