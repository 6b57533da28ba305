// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/trajectory/chunk.hpp"

#include "formats/core/errors.hpp"

#include <fmt/format.h>
#include <libdeflate.h>

#include <cstring>
#include <new>
#include <utility>

namespace grseg {
namespace {

struct FreeDecompressor {
  void operator()(libdeflate_decompressor* one) const { libdeflate_free_decompressor(one); }
};

libdeflate_decompressor* decompressor_of_thread()
{
  thread_local const std::unique_ptr<libdeflate_decompressor, FreeDecompressor> one(
      libdeflate_alloc_decompressor());
  if (!one) throw std::bad_alloc();
  return one.get();
}

/// Copies numbers first .. first + count - 1 of the `all` numbers in `bytes`. In shuffled data the
/// first bytes of all numbers come first, then all second bytes, and so on.
template <class Stored, class Bits, class Out>
void copy_numbers(const std::uint8_t* bytes, std::size_t all, bool shuffled, std::size_t first,
                  std::size_t count, Out* out)
{
  const auto number = [&](Bits bits) {
    Stored value;
    std::memcpy(&value, &bits, sizeof value);
    return static_cast<Out>(value);
  };
  if (!shuffled) {
    for (std::size_t k = 0; k < count; ++k) {
      Bits bits;
      std::memcpy(&bits, bytes + (first + k) * sizeof bits, sizeof bits);
      out[k] = number(bits);
    }
    return;
  }
  const std::uint8_t* const begin = bytes + first;
  for (std::size_t k = 0; k < count; ++k) {
    Bits bits = 0;
    for (std::size_t b = 0; b < sizeof bits; ++b)
      bits |= static_cast<Bits>(begin[b * all + k]) << (8 * b);
    out[k] = number(bits);
  }
}

}  // namespace

Chunk::Chunk(std::shared_ptr<const ChunkLayout> layout, std::size_t number, Bytes stored,
             std::size_t size, std::uint32_t filters_left_out)
    : layout_(std::move(layout)),
      number_(number),
      size_(size),
      filters_left_out_(filters_left_out),
      bytes_(std::move(stored))
{
}

void Chunk::inflate() const
{
  const std::size_t bytes = layout_->chunk_bytes();
  bool whole = size_ == bytes;
  if (is_deflated()) {
    auto inflated = std::make_unique_for_overwrite<std::uint8_t[]>(bytes);
    whole = libdeflate_zlib_decompress(decompressor_of_thread(), bytes_.get(), size_,
                                       inflated.get(), bytes, nullptr) == LIBDEFLATE_SUCCESS;
    if (whole) bytes_ = std::move(inflated);
  }
  if (!whole)
    throw FormatError(fmt::format(
        "{}: chunk {}, from row {}, does not decompress to its {} bytes; the file is damaged; use "
        "an intact copy",
        layout_->dataset, number_, number_ * layout_->chunk_rows, bytes));
}

void Chunk::copy(std::size_t first, std::size_t count, void* out) const
{
  std::call_once(inflated_, [&] { inflate(); });
  const auto& layout = *layout_;
  const auto copy_as = [&]<class Stored, class Bits, class Out>(Stored, Bits, Out) {
    copy_numbers<Stored, Bits>(bytes_.get(), layout.chunk_values(), is_shuffled(),
                               first * layout.row_values, count * layout.row_values,
                               static_cast<Out*>(out));
  };
  switch (layout.number) {
    case ChunkLayout::Number::float64:
      return copy_as(0.0, std::uint64_t{}, 0.0);
    case ChunkLayout::Number::float32:
      return copy_as(0.0F, std::uint32_t{}, 0.0);
    case ChunkLayout::Number::int32:
      return copy_as(std::int32_t{}, std::uint32_t{}, std::int32_t{});
  }
}

}  // namespace grseg
