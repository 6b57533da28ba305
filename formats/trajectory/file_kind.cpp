// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/trajectory/file_kind.hpp"

#include "formats/core/text.hpp"
#include "formats/trajectory/hdf5.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

namespace grseg {
namespace {

struct KnownStart {
  std::string_view bytes;
  const char *name, *use;
};

constexpr KnownStart known_starts[] = {
    {"ITEM: TIMESTEP", "a dump of LAMMPS or LIGGGHTS", "grseg-import makes a run of it"},
    {"{\n", "JSON, as --json prints it", "make the table without --json"},
    {"{\"", "JSON, as --json prints it", "make the table without --json"},
    {"<!DOCTYPE html", "a page of HTML", "a browser shows it"},
    {"<?xml", "XML, such as a picture (SVG) or a file for ParaView", "give the run that it shows"},
    {"\x89PNG", "a picture", "give the run that it shows"},
    {"%PDF-", "a picture or document (PDF)", "give the run that it shows"},
    {"\x1f\x8b", "packed by gzip", "unpack it first"},
    {"\x28\xb5\x2f\xfd", "packed by zstd", "unpack it first"},
    {"PK\x03\x04", "a zip archive", "unpack it first"},
};

/// Programs whose tables other programs read, and those programs.
constexpr KnownStart readers_of_tables[] = {
    {"grseg-stress", "", "grseg-fit, grseg-merge and grseg-closure read it"},
    {"grseg-merge", "", "grseg-fit reads it"},
    {"grseg-segregation", "", "grseg-closure reads it"},
    {"grseg-micro", "", "grseg-derive reads it"},
};

FileKind kind_of_table(std::string_view program)
{
  const auto name = fmt::format("a table of {}", excerpt(program));
  for (const auto& [made_by, unused, use] : readers_of_tables)
    if (program.substr(0, program.find(' ')) == made_by) return {name, use};
  return {name, "it is a result, which no program of grseg reads"};
}

/// True if the first line that is neither empty nor a comment is "key = value".
bool is_scene(std::string_view start)
{
  while (!start.empty()) {
    const auto line = start.substr(0, start.find('\n'));
    start.remove_prefix(std::min(line.size() + 1, start.size()));
    const auto first = line.find_first_not_of(" \t\r");
    if (first == line.npos || line[first] == '#') continue;
    const auto behind_key = line.find_first_not_of("abcdefghijklmnopqrstuvwxyz-", first);
    const auto next = line.find_first_not_of(" \t", behind_key);
    return behind_key > first && next != line.npos && line[next] == '=';
  }
  return false;
}

FileKind kind_of_hdf5(hid_t file)
{
  if (hdf5::exists(file, "/h5md/modules/grseg"))
    return {"a run", "grseg-stress makes a table of it"};
  if (hdf5::exists(file, "/version") && hdf5::exists(file, "/state"))
    return {"a checkpoint of grseg-sim", "grseg-sim --restart continues it"};
  if (hdf5::exists(file, "/Evolution") && hdf5::exists(file, "/Simulation"))
    return {"an archive of LMGC90", "grseg-import makes a run of it"};
  if (hdf5::exists(file, "/h5md"))
    return {"an H5MD file without contacts, as grseg-export writes it", "give the run itself"};
  return {};
}

}  // namespace

std::string FileKind::instead_of(std::string_view wanted, const std::string& otherwise) const
{
  const bool is_wrong = !name.empty() && !name.starts_with(wanted);
  return !is_wrong ? otherwise : fmt::format("is {}, not {}: {}", name, wanted, use);
}

FileKind kind_of_start(std::string_view start)
{
  constexpr std::string_view program = "# program: ", of_grseg = "# program: grseg-";
  if (start.starts_with(of_grseg))
    return kind_of_table(start.substr(program.size(), start.find('\n') - program.size()));
  for (const auto& [bytes, name, use] : known_starts)
    if (start.starts_with(bytes)) return {name, use};
  if (is_scene(start)) return {"a scene file", "grseg-sim simulates it"};
  return {};
}

FileKind kind_of_file(const std::string& path)
{
  constexpr std::size_t enough = 4096;
  std::string start(enough, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(start.data(), enough);
  start.resize(static_cast<std::size_t>(file.gcount()));
  if (!start.starts_with("\x89HDF")) return kind_of_start(start);
  // Not by open_for_reading(), which asks this function for the kind of a file that it cannot open.
  hdf5::silence();
  const hdf5::File opened(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
  return opened.valid() ? kind_of_hdf5(opened) : FileKind{};
}

}  // namespace grseg
