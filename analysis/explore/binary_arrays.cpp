// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/explore/binary_arrays.hpp"

#include "formats/core/errors.hpp"

#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <fmt/format.h>
#include <libdeflate.h>

#include <bit>
#include <memory>

namespace grseg {
namespace {

/// Strongest compression level of libdeflate: a page is written once and opened often.
constexpr int level = 12;

std::vector<std::uint8_t> deflated(const std::vector<std::uint8_t>& bytes)
{
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(level), libdeflate_free_compressor);
  if (!compressor) throw RunError("no memory to compress the page; show fewer --frames");
  std::vector<std::uint8_t> packed(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()));
  packed.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(),
                                         packed.data(), packed.size()));
  return packed;
}

}  // namespace

void BinaryArrays::add(const std::string& name, char kind, std::size_t size, const void* numbers,
                       std::size_t count)
{
  static_assert(std::endian::native == std::endian::little);
  const auto begin = bytes_.size();
  directory_[name] = {
      {"type", fmt::format("{}{}", kind, 8 * size)}, {"offset", begin}, {"length", count}};
  bytes_.resize(begin + count * size);
  const auto* from = static_cast<const std::uint8_t*>(numbers);
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t b = 0; b < size; ++b) bytes_[begin + b * count + k] = *from++;
}

std::string BinaryArrays::base64() const
{
  using namespace boost::archive::iterators;
  using Iterator =
      base64_from_binary<transform_width<std::vector<std::uint8_t>::const_iterator, 6, 8>>;
  auto bytes = deflated(bytes_);
  const auto missing = (3 - bytes.size() % 3) % 3;  // zeros that fill the last group of three bytes
  bytes.insert(bytes.end(), missing, 0);
  std::string text(Iterator(bytes.cbegin()), Iterator(bytes.cend()));
  text.replace(text.size() - missing, missing, missing, '=');
  return text;
}

}  // namespace grseg
