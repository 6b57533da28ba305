// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/run/checkpoint.hpp"

#include "formats/core/errors.hpp"
#include "formats/core/files.hpp"
#include "formats/trajectory/digest.hpp"
#include "formats/trajectory/file_kind.hpp"
#include "formats/trajectory/hdf5.hpp"
#include "sim/run/checkpoint_entries.hpp"
#include "sim/run/run_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <filesystem>
#include <type_traits>

namespace grseg {
namespace {

using namespace hdf5;

constexpr std::int32_t format_version = 2;

static_assert(std::endian::native == std::endian::little, "files and memory are little-endian");

/// Numbers that make up a T: a vector or a Wall is a row of a dataset.
template <class T>
struct Row {
  using Number = T;
  static constexpr hsize_t columns = 1;
};
template <int n>
struct Row<Eigen::Matrix<double, n, 1>> {
  using Number = double;
  static constexpr hsize_t columns = n;
};
template <>
struct Row<SpherePosition> : Row<Eigen::Vector4d> {
};
template <class T, std::size_t n>
struct Row<std::array<T, n>> {
  using Number = T;
  static constexpr hsize_t columns = n;
};
template <int D>
struct Row<Wall<D>> {
  using Number = double;
  static constexpr hsize_t columns = 2 * hsize_t{D};
};
template <class T>
constexpr int rank_of = Row<T>::columns > 1 ? 2 : 1;
template <class T>
constexpr bool is_real = std::is_same_v<typename Row<T>::Number, double>;
template <class T>
constexpr H5T_class_t kind_of = is_real<T> ? H5T_FLOAT : H5T_INTEGER;

/// HDF5 type of the numbers of T, in file and memory.
template <class T>
hid_t type_of()
{
  using Number = typename Row<T>::Number;
  if constexpr (is_real<T>)
    return H5T_IEEE_F64LE;
  else if constexpr (sizeof(Number) == 1)
    return H5T_STD_U8LE;
  else if constexpr (sizeof(Number) == 4)
    return std::is_unsigned_v<Number> ? H5T_STD_U32LE : H5T_STD_I32LE;
  else
    return std::is_unsigned_v<Number> ? H5T_STD_U64LE : H5T_STD_I64LE;
}

struct Writer {
  hid_t file;

  void operator()(const char* path, const std::string& text) const
  {
    const auto type = string_type(text.size());
    write_fixed(file, path, type, type, {}, text.c_str());
  }
  template <class T>
  void operator()(const char* path, const std::vector<T>& values) const
  {
    std::vector<hsize_t> shape{values.size()};
    if (rank_of<T> == 2) shape.push_back(Row<T>::columns);
    write_fixed(file, path, type_of<T>(), type_of<T>(), shape, values.data());
  }
  template <class T>
  void operator()(const char* path, const T& value) const
  {
    write_fixed(file, path, type_of<T>(), type_of<T>(), {}, &value);
  }
};

struct Reader {
  hid_t file;
  const std::string& name;  // name of the file

  void operator()(const char* path, std::string& text) const
  {
    const CheckedDataset dataset(file, path, H5T_STRING, 0, name);
    const Type type(H5Dget_type(dataset.id()));
    text.resize(H5Tget_size(type));
    dataset.read_all(type, text.data());
    text.erase(std::min(text.find('\0'), text.size()));  // removes the padding
  }
  template <class T>
  void operator()(const char* path, std::vector<T>& values) const
  {
    const CheckedDataset dataset(file, path, kind_of<T>, rank_of<T>, name);
    if (rank_of<T> == 2) dataset.require(1, Row<T>::columns);
    dataset.require_possible(dataset.dims()[0]);
    values.resize(dataset.dims()[0]);
    dataset.read_all(type_of<T>(), values.data());
  }
  template <class T>
  void operator()(const char* path, T& value) const
  {
    CheckedDataset(file, path, kind_of<T>, 0, name).read_all(type_of<T>(), &value);
  }
  void operator()(const char* path, bool& value) const
  {
    std::uint8_t number = 0;
    (*this)(path, number);
    value = number != 0;
  }
};

template <int D>
std::uint64_t digest_of(const Checkpoint<D>& checkpoint)
{
  Digester digester;
  const auto add = [&](const char*, const auto& value) { digester.add(value); };
  visit_all(add, checkpoint);
  return digester.digest();
}

template <int D>
void write_parts(const std::string& path, const Checkpoint<D>& checkpoint)
{
  File file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, without_time(), newest_format()));
  if (!file.valid()) throw RunError(fmt::format("cannot create {}: {}", path, reason_of_failure()));
  try {
    const Writer writer{file};
    writer("/version", format_version);
    visit_all(writer, checkpoint);
    writer("/digest", digest_of(checkpoint));
  } catch (const RunError& failed) {
    throw RunError(fmt::format("{}: {}", path, failed.what()));
  }
  if (close_file(file.release()) < 0)
    throw RunError(fmt::format("cannot write {}: {}", path, reason_of_failure()));
}

File open_checkpoint(const std::string& path)
{
  try {
    return open_for_reading(path);
  } catch (const FormatError&) {
    throw FormatError(
        fmt::format("{}: {}", path,
                    kind_of_file(path).instead_of(
                        "a checkpoint", "is not a checkpoint, or is truncated or damaged")));
  }
}

AnyCheckpoint read_parts(const std::string& path)
{
  const auto fail = [&](const std::string& why) {
    throw FormatError(fmt::format("{}: {}", path, why));
  };
  const auto file = open_checkpoint(path);
  if (!exists(file, "/version") || !exists(file, "/state"))
    fail(kind_of_file(path).instead_of(
        "a checkpoint", "is not a checkpoint of grseg-sim; name the file that --checkpoint wrote"));
  const Reader read{file, path};
  std::int32_t version = 0;
  read("/version", version);
  if (version != format_version)
    fail(
        fmt::format("is a checkpoint of version {}, and this grseg-sim reads version {}; continue "
                    "with the program that wrote it",
                    version, format_version));
  int dimension = 0;
  read("/box/dimension", dimension);
  if (dimension != 2 && dimension != 3)
    fail(
        fmt::format("/box/dimension is {}, and must be 2 or 3: the file is damaged; use an older "
                    "checkpoint",
                    dimension));
  return with_dimension(dimension, [&](auto d) -> AnyCheckpoint {
    Checkpoint<d> checkpoint;
    visit_all(read, checkpoint);
    std::uint64_t digest = 0;
    read("/digest", digest);
    if (digest != digest_of(checkpoint))
      fail("its content disagrees with its digest: it is damaged; use an older checkpoint");
    check_checkpoint(checkpoint, path);
    return checkpoint;
  });
}

bool is_whole(const std::string& path)
{
  try {
    read_checkpoint(path);
    return true;
  } catch (const ToolError&) {
    return false;
  }
}

}  // namespace

template <int D>
void write_checkpoint(const std::string& path, const Checkpoint<D>& checkpoint)
{
  silence();
  const auto part = part_of(path);
  const RemoveAtEnd clean_up(part);
  write_parts(part, checkpoint);
  flush_to_disk(part);
  if (is_whole(path)) keep_as(path, previous_of(path));
  rename_path(part, path);
}

template void write_checkpoint(const std::string&, const Checkpoint<2>&);
template void write_checkpoint(const std::string&, const Checkpoint<3>&);

AnyCheckpoint read_checkpoint(const std::string& path)
{
  silence();
  const auto previous = previous_of(path);
  const auto hint = [&](const ToolError& wrong) {
    return std::filesystem::exists(previous)
               ? fmt::format("{}; {} is the previous checkpoint", wrong.what(), previous)
               : wrong.what();
  };
  try {
    return read_parts(path);
  } catch (const UsageError& missing) {
    throw UsageError(hint(missing));
  } catch (const FormatError& damaged) {
    throw FormatError(hint(damaged));
  }
}

}  // namespace grseg
