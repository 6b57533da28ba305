// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

namespace grseg {

/// Storage of the chunks of a compressed dataset. A chunk is `chunk_rows` rows of `row_values`
/// numbers each, passed through HDF5's filters shuffle (if `shuffled`) and then deflate.
struct ChunkLayout {
  enum class Number { float64, float32, int32 };

  std::string dataset;  // file and path of the dataset, for messages
  std::size_t chunk_rows = 1, row_values = 1;
  Number number = Number::float64;
  bool shuffled = false;

  std::size_t number_bytes() const { return number == Number::float64 ? 8 : 4; }
  std::size_t chunk_values() const { return chunk_rows * row_values; }
  std::size_t chunk_bytes() const { return chunk_values() * number_bytes(); }
};

/// A chunk: its bytes as stored in the file, and HDF5's filter mask, in which a set bit marks a
/// filter that was not applied. The first thread that needs the chunk decompresses it, once.
class Chunk {
 public:
  using Bytes = std::unique_ptr<std::uint8_t[]>;

  Chunk(std::shared_ptr<const ChunkLayout> layout, std::size_t number, Bytes stored,
        std::size_t size, std::uint32_t filters_left_out);

  std::size_t number() const { return number_; }
  /// Copies rows [first, first + count) of the chunk, as double or std::int32_t. Throws
  /// FormatError, which names dataset and chunk, if its decompressed size is wrong.
  void copy(std::size_t first, std::size_t count, void* out) const;

 private:
  bool is_deflated() const { return (filters_left_out_ & (layout_->shuffled ? 2U : 1U)) == 0; }
  bool is_shuffled() const { return layout_->shuffled && (filters_left_out_ & 1U) == 0; }
  void inflate() const;

  std::shared_ptr<const ChunkLayout> layout_;
  std::size_t number_, size_;
  std::uint32_t filters_left_out_;
  mutable Bytes bytes_;
  mutable std::once_flag inflated_;
};

/// Rows whose chunk has been read but not yet decompressed. Several threads can unpack rows at
/// once, also rows of the same chunk.
struct PackedRows {
  std::shared_ptr<const Chunk> chunk;
  std::size_t first = 0, count = 0;  // first row in the chunk, and number of rows
  void* out = nullptr;               // destination of the numbers

  void unpack() const { chunk->copy(first, count, out); }
};

}  // namespace grseg
