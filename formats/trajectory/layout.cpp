// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/trajectory/layout.hpp"

#include <algorithm>
#include <bit>

namespace grseg {

static_assert(std::endian::native == std::endian::little, "memory and file hold the same bytes");

hid_t type_of(Number number, bool float32)
{
  const hid_t types[] = {H5T_STD_I32LE, H5T_STD_I64LE,  H5T_STD_U8LE,
                         H5T_STD_U64LE, H5T_IEEE_F64LE, float32 ? H5T_IEEE_F32LE : H5T_IEEE_F64LE};
  return types[static_cast<std::size_t>(number)];
}

std::vector<hsize_t> shape_of(std::string_view letters, const LayoutSizes& sizes)
{
  const auto dimension = static_cast<hsize_t>(sizes.dimension);
  std::vector<hsize_t> shape;
  for (const char letter : letters) {
    if (letter == 'F') shape.push_back(sizes.frames);
    if (letter == 'O') shape.push_back(sizes.frames + 1);
    if (letter == 'N') shape.push_back(sizes.grains);
    if (letter == 'C') shape.push_back(sizes.contacts);
    if (letter == 'K') shape.push_back(sizes.species + 1);
    if (letter == 'D') shape.push_back(number_of_fields);
    if (letter == 'd' || (letter == 'w' && dimension == 3)) shape.push_back(dimension);
    if (letter == '4') shape.push_back(4);
  }
  return shape;
}

const LayoutRow& row_at(std::string_view path)
{
  return *std::find_if(layout.begin(), layout.end(),
                       [path](const LayoutRow& row) { return row.path == path; });
}

const LayoutRow& row_of(Field field)
{
  static constexpr std::string_view paths[number_of_fields] = {
      "",
      "/particles/grains/position/value",
      "/particles/grains/image/value",
      "/particles/grains/velocity/value",
      "/particles/grains/angular_velocity/value",
      "/particles/grains/force/value",
      "/grseg/contacts/i",
      "/grseg/contacts/j",
      "/grseg/contacts/force",
      "/grseg/contacts/branch",
      "/grseg/contacts/gap"};
  return row_at(paths[static_cast<std::size_t>(field)]);
}

}  // namespace grseg
