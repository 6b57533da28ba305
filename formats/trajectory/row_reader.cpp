// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/trajectory/row_reader.hpp"

#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace grseg {
namespace {

using namespace hdf5;

// Largest uncompressed size of the chunks in kept_, bytes: enough for the threads that work on a
// block of frames, and small compared with a frame.
constexpr std::size_t most_kept = 2 << 20;

// Largest accepted compression ratio; deflate reaches at most 1032 : 1.
constexpr hsize_t most_deflated = 1040;

/// True if the filters are deflate, or shuffle (of numbers of `number_bytes`) and then deflate.
bool has_known_filters(hid_t create, std::size_t number_bytes)
{
  const int filters = H5Pget_nfilters(create);
  if (filters < 1 || filters > 2) return false;
  const auto filter = [&](int k, unsigned& value) {
    unsigned flags = 0, config = 0;
    std::size_t values = 1;
    return H5Pget_filter2(create, static_cast<unsigned>(k), &flags, &values, &value, 0, nullptr,
                          &config);
  };
  unsigned value = 0;
  if (filter(filters - 1, value) != H5Z_FILTER_DEFLATE) return false;
  return filters == 1 || (filter(0, value) == H5Z_FILTER_SHUFFLE && value == number_bytes);
}

/// Layout of the dataset's chunks; null if HDF5 should read the dataset.
std::shared_ptr<const ChunkLayout> layout_of(const CheckedDataset& dataset)
{
  const Properties create(H5Dget_create_plist(dataset.id()));
  const Type type(H5Dget_type(dataset.id()));
  const auto is = [&](hid_t native) { return H5Tequal(type, native) > 0; };
  ChunkLayout layout;
  if (is(H5T_NATIVE_FLOAT))
    layout.number = ChunkLayout::Number::float32;
  else if (is(H5T_NATIVE_INT32))
    layout.number = ChunkLayout::Number::int32;
  else if (!is(H5T_NATIVE_DOUBLE))
    return nullptr;
  if (H5Pget_layout(create) != H5D_CHUNKED || !has_known_filters(create, layout.number_bytes()))
    return nullptr;
  const auto& dims = dataset.dims();
  std::vector<hsize_t> chunk(dims.size());
  H5Pget_chunk(create, static_cast<int>(chunk.size()), chunk.data());
  if (!std::equal(chunk.begin() + 1, chunk.end(), dims.begin() + 1)) return nullptr;
  layout.dataset = dataset.full_path();
  layout.shuffled = H5Pget_nfilters(create) == 2;
  layout.chunk_rows = chunk[0];
  for (std::size_t k = 1; k < dims.size(); ++k) layout.row_values *= dims[k];
  return std::make_shared<const ChunkLayout>(std::move(layout));
}

}  // namespace

RowReader::RowReader(CheckedDataset dataset)
    : dataset_(std::move(dataset)),
      memory_type_(H5Tget_class(Type(H5Dget_type(dataset_.id()))) == H5T_INTEGER
                       ? H5T_NATIVE_INT32
                       : H5T_NATIVE_DOUBLE),
      layout_(layout_of(dataset_)),
      most_bytes_(size_of_file(dataset_.id()))
{
}

void RowReader::load(hsize_t first, hsize_t count, void* data,
                     std::vector<PackedRows>& packed) const
{
  if (!layout_) return dataset_.read_rows(memory_type_, first, count, data);
  const std::size_t row_bytes = layout_->row_values * H5Tget_size(memory_type_);
  auto* out = static_cast<std::byte*>(data);
  while (count > 0) {
    const auto number = first / layout_->chunk_rows, begin = first % layout_->chunk_rows;
    const auto rows = std::min<hsize_t>(count, layout_->chunk_rows - begin);
    if (auto found = chunk(number))
      packed.push_back({std::move(found), begin, rows, out});
    else
      dataset_.read_rows(memory_type_, first, rows, out);
    first += rows;
    count -= rows;
    out += rows * row_bytes;
  }
}

/// The chunk of this number; null if it was never written (HDF5 then supplies fill values).
std::shared_ptr<const Chunk> RowReader::chunk(std::size_t number) const
{
  const auto found = std::find_if(kept_.begin(), kept_.end(),
                                  [&](const auto& one) { return one->number() == number; });
  if (found != kept_.end()) return *found;

  std::vector<hsize_t> start(dataset_.dims().size(), 0);
  start[0] = number * layout_->chunk_rows;
  hsize_t size = 0;
  if (H5Dget_chunk_storage_size(dataset_.id(), start.data(), &size) < 0 || size == 0)
    return nullptr;
  const auto damaged = [&](const char* how) {
    return FormatError(fmt::format("{}: chunk {}, from row {}, {}; the file is damaged",
                                   layout_->dataset, number, start[0], how));
  };
  if (size > most_bytes_) throw damaged("claims to be larger than the file");
  if (layout_->chunk_bytes() / most_deflated > size) throw damaged("is too small for its content");
  auto bytes = std::make_unique_for_overwrite<std::uint8_t[]>(size);
  std::uint32_t left_out = 0;
  if (H5Dread_chunk(dataset_.id(), H5P_DEFAULT, start.data(), &left_out, bytes.get()) < 0) {
    hdf5::require_system(layout_->dataset);
    throw damaged("cannot be read");
  }
  auto one = std::make_shared<const Chunk>(layout_, number, std::move(bytes), size, left_out);
  if (layout_->chunk_rows > 1) {
    kept_.push_back(one);
    if (kept_.size() > 1 && kept_.size() * layout_->chunk_bytes() > most_kept) kept_.pop_front();
  }
  return one;
}

}  // namespace grseg
