// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/trajectory/chunk.hpp"
#include "formats/trajectory/hdf5.hpp"

#include <deque>
#include <memory>
#include <vector>

namespace grseg {

/// Reader of rows of a dataset as double (H5T_FLOAT) or std::int32_t (H5T_INTEGER). HDF5 would
/// decompress within its calls, one thread at a time. So if a dataset is compressed as grseg does
/// it, `load` reads its chunks without decompression, and the threads of the caller unpack them.
/// HDF5 itself reads all other datasets.
class RowReader {
 public:
  RowReader() = default;
  explicit RowReader(hdf5::CheckedDataset dataset);

  const std::string& path() const { return dataset_.path(); }
  bool stores_float32() const { return dataset_.stores_float32(); }

  /// Reads rows [first, first + count) to `data`. Compressed rows are appended to `packed` instead;
  /// unpacking them fills `data`. Throws FormatError, which names the dataset, if that fails.
  void load(hsize_t first, hsize_t count, void* data, std::vector<PackedRows>& packed) const;

 private:
  std::shared_ptr<const Chunk> chunk(std::size_t number) const;

  hdf5::CheckedDataset dataset_;
  hid_t memory_type_ = H5I_INVALID_HID;
  std::shared_ptr<const ChunkLayout> layout_;              // null: HDF5 reads the dataset
  hsize_t most_bytes_ = 0;                                 // upper limit of a stored chunk, bytes
  mutable std::deque<std::shared_ptr<const Chunk>> kept_;  // latest chunks, reused by next frames
};

}  // namespace grseg
