// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/trajectory/hdf5_attributes.hpp"

#include "formats/core/errors.hpp"
#include "formats/trajectory/hdf5.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace grseg::hdf5 {
namespace {

void write_attribute(hid_t object, const std::string& name, hid_t type,
                     const std::vector<hsize_t>& shape, const void* data)
{
  const auto space = space_of(shape);
  const Attribute attribute(
      H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT));
  if (!attribute.valid() || H5Awrite(attribute, type, data) < 0)
    throw RunError(fmt::format("cannot write attribute {}: {}", name, reason_of_failure()));
}

constexpr hssize_t most_in_attribute = 4096;  // numbers, or bytes of a text of fixed length

Attribute attribute_of(hid_t parent, const std::string& path, const std::string& name)
{
  if (!exists(parent, path)) return {};
  return Attribute(H5Aopen_by_name(parent, path.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT));
}

}  // namespace

void write_attribute(hid_t object, const std::string& name, const std::string& text)
{
  write_attribute(object, name, string_type(text.size()), {}, text.c_str());
}

void write_attribute(hid_t object, const std::string& name, const std::vector<std::string>& texts)
{
  std::size_t longest = 1;
  for (const auto& text : texts) longest = std::max(longest, text.size());
  std::string packed;
  for (auto text : texts) {
    text.resize(longest, '\0');
    packed += text;
  }
  write_attribute(object, name, string_type(longest), {texts.size()}, packed.data());
}

void write_attribute(hid_t object, const std::string& name, const std::vector<int>& values)
{
  std::vector<hsize_t> shape;
  if (values.size() != 1) shape = {values.size()};
  write_attribute(object, name, H5T_NATIVE_INT, shape, values.data());
}

std::vector<std::string> read_texts(hid_t object, const std::string& name)
{
  const Attribute attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT));
  if (!attribute.valid()) return {};
  const Type type(H5Aget_type(attribute));
  const Space space(H5Aget_space(attribute));
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0) return {};
  const auto count = static_cast<std::size_t>(H5Sget_simple_extent_npoints(space));
  const auto length = H5Tget_size(type);
  if (count > 3 || length > 64) return {};
  std::string packed(count * length, '\0');
  if (H5Aread(attribute, type, packed.data()) < 0) return {};
  std::vector<std::string> texts;
  for (std::size_t k = 0; k < count; ++k)
    texts.emplace_back(packed.substr(k * length, length).c_str());
  return texts;
}

std::vector<double> numbers_in_attribute(hid_t parent, const std::string& path,
                                         const std::string& name, const std::string& file)
{
  const auto attribute = attribute_of(parent, path, name);
  if (!attribute.valid()) return {};
  const Type type(H5Aget_type(attribute));
  const auto count = H5Sget_simple_extent_npoints(Space(H5Aget_space(attribute)));
  if (!is_usual_number(type) || count < 0 || count > most_in_attribute)
    throw FormatError(
        fmt::format("{}: '{}' of {} should be numbers of a usual type; is the file damaged?", file,
                    name, path));
  std::vector<double> numbers(static_cast<std::size_t>(count));
  if (count > 0 && H5Aread(attribute, H5T_NATIVE_DOUBLE, numbers.data()) < 0)
    throw FormatError(
        fmt::format("{}: '{}' of {} cannot be read: the file is damaged", file, name, path));
  return numbers;
}

std::string text_in_attribute(hid_t parent, const std::string& path, const std::string& name,
                              const std::string& file)
{
  const auto attribute = attribute_of(parent, path, name);
  if (!attribute.valid()) return {};
  const Type type(H5Aget_type(attribute));
  const bool one = H5Sget_simple_extent_npoints(Space(H5Aget_space(attribute))) == 1;
  if (!one || H5Tget_class(type) != H5T_STRING || H5Tget_size(type) > most_in_attribute)
    throw FormatError(
        fmt::format("{}: '{}' of {} should be a text; is the file damaged?", file, name, path));
  std::string text(H5Tget_size(type), '\0');
  char* grown = nullptr;
  const bool variable = H5Tis_variable_str(type) > 0;
  if (H5Aread(attribute, type, variable ? static_cast<void*>(&grown) : text.data()) < 0 ||
      (variable && grown == nullptr))
    throw FormatError(
        fmt::format("{}: '{}' of {} cannot be read: the file is damaged", file, name, path));
  if (variable) {
    text = grown;
    H5free_memory(grown);
  }
  return text.substr(0, text.find('\0'));  // removes the padding
}

}  // namespace grseg::hdf5
