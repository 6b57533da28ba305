// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/export/map_file.hpp"

#include "formats/core/errors.hpp"
#include "formats/core/files.hpp"
#include "formats/core/xml.hpp"
#include "formats/export/output_folder.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace grseg {
namespace {

const std::string first_image = "000000.vti";

std::string folder_of(const std::string& list)
{
  return list.substr(0, list.size() - std::string(".pvd").size());
}

void write_series(const MapTable& map, const OutputOptions& output,
                  const std::vector<std::string>& inputs)
{
  const auto path = folder_of(output.path);
  const auto name = xml_escaped(std::filesystem::path(path).filename().string());
  OutputFolder folder(path, first_image, output.overwrite, inputs);
  std::string list = R"(<?xml version="1.0"?>
<VTKFile type="Collection" version="1.0" byte_order="LittleEndian">
  <Collection>
)";
  for (std::size_t w = 0; w < map.windows.size(); ++w) {
    const auto file = fmt::format("{:06}.vti", w);
    folder.add_file(file, image_data(map, w));
    list += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}/{}\"/>\n",
                        map.windows[w].middle(), name, file);
  }
  folder.publish();
  write_whole(output, list + "  </Collection>\n</VTKFile>\n");
}

}  // namespace

bool is_map_file(const std::string& path)
{
  return path.ends_with(".h5") || path.ends_with(".vti") || path.ends_with(".pvd");
}

void check_map_file(const OutputOptions& output, const std::vector<std::string>& inputs)
{
  check_output(output.path, output.overwrite, inputs);
  if (!output.path.ends_with(".pvd")) return;
  const auto folder = folder_of(output.path);
  refuse_input_as_output(folder, inputs);
  if (is_taken(folder) && !output.overwrite) throw UsageError(already_exists(folder));
}

void write_map_file(const Table& table, const OutputOptions& output,
                    const std::vector<std::string>& inputs)
{
  const auto map = map_table(table);
  if (output.path.ends_with(".pvd")) return write_series(map, output, inputs);
  if (output.path.ends_with(".h5")) {
    Output file(output.path, output.overwrite, inputs);
    write_map_hdf5(map, file.temporary(), output.path);
    return file.publish();
  }
  if (map.windows.size() > 1)
    throw UsageError(fmt::format(
        "a .vti file holds one window, and there are {}: take -o {}.pvd, or a longer --window",
        map.windows.size(), output.path.substr(0, output.path.size() - 4)));
  write_whole(output, image_data(map, 0));
}

}  // namespace grseg
