// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

namespace grseg {

/// How the chunks of a dataset are stored, each of which holds rows of `row_values` numbers: HDF5's
/// filters shuffle (0 or 1 times) and deflate, in this order.
struct ChunkLayout {
  enum class Number { float64, float32, int32 };

  std::string dataset;  // its file and path
  std::size_t chunk_rows = 1, row_values = 1;
  Number number = Number::float64;
  bool shuffled = false;

  std::size_t number_bytes() const { return number == Number::float64 ? 8 : 4; }
  std::size_t chunk_values() const { return chunk_rows * row_values; }
  std::size_t chunk_bytes() const { return chunk_values() * number_bytes(); }
};

/// The bytes of a chunk as the file holds them, and which of its filters were left out (a bit for
/// each, HDF5's filter mask). It is decompressed once, by the thread that needs it first.
class Chunk {
 public:
  using Bytes = std::unique_ptr<std::uint8_t[]>;

  Chunk(std::shared_ptr<const ChunkLayout> layout, std::size_t number, Bytes stored,
        std::size_t size, std::uint32_t filters_left_out);

  std::size_t number() const { return number_; }
  /// Copies rows [first, first + count) of the chunk, as double or std::int32_t. FormatError naming
  /// the dataset and the chunk where it does not decompress to its size.
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

/// Rows on their way to memory: their chunk has been read. Several threads can unpack at once, also
/// rows of the same chunk.
struct PackedRows {
  std::shared_ptr<const Chunk> chunk;
  std::size_t first = 0, count = 0;  // in the chunk
  void* out = nullptr;

  void unpack() const { chunk->copy(first, count, out); }
};

}  // namespace grseg
