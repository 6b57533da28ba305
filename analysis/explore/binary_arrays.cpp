// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/explore/binary_arrays.hpp"

#include "formats/core/errors.hpp"

#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <libdeflate.h>

#include <bit>
#include <cstring>
#include <memory>

namespace grseg {
namespace {

/// The strongest level of libdeflate: a page is written once and opened often.
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

std::string in_base64(std::vector<std::uint8_t> bytes)
{
  using namespace boost::archive::iterators;
  using Iterator =
      base64_from_binary<transform_width<std::vector<std::uint8_t>::const_iterator, 6, 8>>;
  const auto missing = (3 - bytes.size() % 3) % 3;  // up to whole groups of three bytes
  bytes.insert(bytes.end(), missing, 0);
  std::string text(Iterator(bytes.cbegin()), Iterator(bytes.cend()));
  text.replace(text.size() - missing, missing, missing, '=');
  return text;
}

}  // namespace

template <class Number>
void BinaryArrays::append(const std::string& name, const char* type,
                          const std::vector<Number>& values)
{
  static_assert(std::endian::native == std::endian::little);
  directory_[name] = {{"type", type}, {"offset", bytes_.size()}, {"length", values.size()}};
  const auto begin = bytes_.size(), count = values.size();
  bytes_.resize(begin + count * sizeof(Number));
  for (std::size_t k = 0; k < count; ++k) {
    std::uint8_t of_number[sizeof(Number)];
    std::memcpy(of_number, &values[k], sizeof(Number));
    for (std::size_t b = 0; b < sizeof(Number); ++b) bytes_[begin + b * count + k] = of_number[b];
  }
}

void BinaryArrays::add(const std::string& name, const std::vector<std::uint8_t>& values)
{
  append(name, "u8", values);
}
void BinaryArrays::add(const std::string& name, const std::vector<std::int8_t>& values)
{
  append(name, "i8", values);
}
void BinaryArrays::add(const std::string& name, const std::vector<std::uint16_t>& values)
{
  append(name, "u16", values);
}
void BinaryArrays::add(const std::string& name, const std::vector<std::uint32_t>& values)
{
  append(name, "u32", values);
}
void BinaryArrays::add(const std::string& name, const std::vector<float>& values)
{
  append(name, "f32", values);
}
void BinaryArrays::add(const std::string& name, const std::vector<double>& values)
{
  append(name, "f64", values);
}

std::string BinaryArrays::base64() const
{
  return in_base64(deflated(bytes_));
}

}  // namespace grseg
