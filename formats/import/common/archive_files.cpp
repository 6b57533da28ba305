// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/common/archive_files.hpp"

#include "formats/core/errors.hpp"
#include "formats/core/files.hpp"
#include "formats/core/text.hpp"
#include "formats/import/common/guarded_reading.hpp"
#include "formats/import/common/text_source.hpp"
#include "formats/import/common/text_values.hpp"
#include "formats/trajectory/file_kind.hpp"
#include "formats/trajectory/hdf5.hpp"

#include <fmt/format.h>
#include <glob.h>

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <span>

namespace grseg {
namespace {

bool is_digit(char c)
{
  return c >= '0' && c <= '9';
}

/// The digits that begin at `at`, without leading zeros; moves `at` behind the last digit.
std::string number_at(const std::string& text, std::size_t& at)
{
  const auto begin = at;
  while (at < text.size() && is_digit(text[at])) ++at;
  const auto digits = text.substr(begin, at - begin);
  return digits.substr(std::min(digits.find_first_not_of('0'), digits.size()));
}

/// Names of files that match `pattern`. `%` is part of the name or, if no file has it, like `*`.
std::vector<std::string> matches_of(std::string pattern)
{
  glob_t found{};
  std::vector<std::string> names;
  if (glob(pattern.c_str(), 0, nullptr, &found) == 0)
    names.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  globfree(&found);
  if (!names.empty() || pattern.find('%') == std::string::npos) return names;
  std::replace(pattern.begin(), pattern.end(), '%', '*');
  return matches_of(std::move(pattern));
}

using namespace std::string_view_literals;

constexpr auto unpack_first = "unpack it, and name the files that were in it";
constexpr auto repack =
    "decompress it, or compress it by gzip, bzip2, xz or zstd, which are read as they are";
constexpr auto to_tables = "write its grains and contacts as tables (--format csv)";
constexpr auto to_dumps =
    "it has no contact forces, which an import needs; write `dump "
    "custom` for grains and `dump local` for contacts";
constexpr auto in_pandas = "write it as a table, in Python by pandas and to_csv (--format csv)";
constexpr auto from_restart =
    "read it in that program; then `run 0` with a `dump custom` "
    "of grains and a `dump local` of contacts";
constexpr auto from_paraview =
    "write dumps as text instead (LIGGGHTS), or tables by scripts/archives/yade_export.py (YADE), or "
    "save it as a table in ParaView (--format csv)";

struct Kind {
  const char* what;
  const char* way_out;
  std::initializer_list<std::string_view> bytes;  // alternatives: the file has one of these at `at`
  std::size_t at = 0;                             // offset in the file, bytes
};

/// Kinds that are not text. Their bytes alone, some of which are letters, do not tell them from text.
constexpr Kind binary_kinds[] = {
    {"a zip archive, as xlsx, ods and npz are",
     "unpack it and name the files that were in it, or save its "
     "sheets or arrays as tables (--format csv)",
     {"PK\x03\x04"sv}},
    {"an empty zip archive", unpack_first, {"PK\x05\x06"sv}},
    {"a tar archive", unpack_first, {"ustar"sv}, 257},
    {"a 7z archive", unpack_first, {"7z\xbc\xaf\x27\x1c"sv}},
    {"a rar archive", unpack_first, {"Rar!\x1a\x07"sv}},
    {"packed twice", "unpack it once", {"\x1f\x8b"sv, "\x28\xb5\x2f\xfd"sv, "\xfd\x37zXZ\0"sv}},
    {"packed twice", "unpack it once", {"\x31\x41\x59\x26\x53\x59"sv}, 4},  // bzip2
    {"packed by lz4", repack, {"\x04\x22\x4d\x18"sv}},
    {"packed by lzip", repack, {"LZIP"sv}},
    {"packed by compress", repack, {"\x1f\x9d"sv}},
    {"packed by lzma", repack, {"\x5d\0\0"sv}},
    {"a table of Parquet", in_pandas, {"PAR1"sv}},
    {"a table of Arrow", in_pandas, {"ARROW1"sv}},
    {"a table of Feather", in_pandas, {"FEA1"sv}},
    {"a pickle of Python", in_pandas, {"\x80\x03"sv, "\x80\x04"sv, "\x80\x05"sv}},
    {"an array of numpy", in_pandas, {"\x93NUMPY"sv}},
    {"a file of MATLAB", to_tables, {"MATLAB 5.0"sv}},
    {"a database of SQLite", to_tables, {"SQLite format 3"sv}},
    {"a spreadsheet of Excel", "save its sheets as tables (--format csv)", {"\xd0\xcf\x11\xe0"sv}},
    {"a netCDF file", to_dumps, {"CDF\x01"sv, "CDF\x02"sv, "CDF\x05"sv}},
    {"an HDF5 file",
     "--format siconos and --format lmgc90 read such files; write grains and contacts of another "
     "program as tables (--format csv)",
     {"\x89HDF\r\n\x1a\n"sv}},
    {"a restart file of LAMMPS", from_restart, {"LammpS RestartT"sv}},
    {"a restart file of LIGGGHTS", from_restart, {"Version LIGGGHTS"sv}, 8},
    {"a binary dump of LAMMPS",
     "turn it into text by binary2txt, which comes with LAMMPS",
     {"DUMPATOM"sv, "DUMPCUSTOM"sv},
     8},
    {"a saved simulation of YADE",
     "load it in YADE and write tables by scripts/archives/yade_export.py",
     {"serialization::archive"sv},
     8},
    {"a GSD file of HOOMD", to_tables, {"\xdf\x65\xdf\x65\xdf\x65\xdf\x65"sv}},
    {"a DCD file, which contains positions only", to_dumps, {"CORD"sv}, 4},
    {"a trajectory of GROMACS", to_dumps, {"\0\0\x07\xc9"sv, "\0\0\x07\xcb"sv}},
};

constexpr Kind text_kinds[] = {
    {"a VTK file", from_paraview, {"# vtk DataFile"sv, "<VTKFile"sv}},
    {"a YAML file", to_dumps, {"---\n"sv, "---\r\n"sv}},
    {"a file of AtomEye (cfg)", to_dumps, {"Number of particles ="sv}},
    {"a data file of LAMMPS", from_restart, {"LAMMPS data file"sv}},
    {"a log of LAMMPS", "name its dumps", {"LAMMPS ("sv}},
    {"a file of GiD, as Kratos writes it", to_tables, {"GiD Post Result"sv, "MESH \""sv}},
    {"a model of Kratos (mdpa)",
     to_tables,
     {"Begin ModelPartData"sv, "Begin Properties"sv, "Begin Nodes"sv, "Begin Table"sv}},
    {"a file of ESyS-Particle", to_tables, {"LSMGeometry"sv, "V 1\n"sv, "V 2\n"sv, "V 3\n"sv}},
    {"a pointer of Git LFS", "fetch the file itself (git lfs pull)", {"version https://git-lfs"sv}},
    {"a page of HTML", "download the file itself", {"<!DOCTYPE html"sv, "<html"sv}},
    {"a PDF", to_tables, {"%PDF-"sv}},
    {"text in UTF-16", "save it as UTF-8", {"\xff\xfe"sv, "\xfe\xff"sv}},
};

/// Kinds by the ends of names, for files whose content nothing tells.
constexpr Kind named_kinds[] = {
    {"a saved state of a program of Itasca",
     to_tables,
     {".sav"sv, ".p2sav"sv, ".p3sav"sv, ".f2sav"sv, ".f3sav"sv}},
    {"a file of MUSEN", to_tables, {".mdem"sv}},
    {"a file of GiD, as Kratos writes it",
     to_tables,
     {".post.bin"sv, ".post.res"sv, ".post.msh"sv}},
    {"a model of Kratos (mdpa)", to_tables, {".mdpa"sv}},
};

std::string is_of(const char* what, const char* way_out)
{
  return fmt::format("is {}: {}", what, way_out);
}

/// The words of the first lines.
std::vector<std::vector<std::string_view>> words_by_line(std::string_view start)
{
  constexpr std::size_t most = 20;
  std::vector<std::vector<std::string_view>> lines;
  while (!start.empty() && lines.size() < most) {
    const auto end = std::min(start.find('\n'), start.size());
    lines.push_back(
        words_of(start.substr(0, start.substr(0, end).ends_with('\r') ? end - 1 : end)));
    start.remove_prefix(std::min(end + 1, start.size()));
  }
  return lines;
}

bool are_numbers(const std::vector<std::string_view>& words, std::size_t first)
{
  double number = 0;
  return words.size() > first &&
         std::all_of(words.begin() + static_cast<std::ptrdiff_t>(first), words.end(),
                     [&](std::string_view word) { return read_number(word, number); });
}

/// True for an xyz file: number of rows, a comment, then rows of an element and >= 3 numbers.
bool is_xyz(const std::vector<std::vector<std::string_view>>& lines)
{
  return lines.size() > 2 && lines[0].size() == 1 && are_numbers(lines[0], 0) &&
         lines[2].size() > 3 && are_numbers(lines[2], 1);
}

/// True for a data file of LAMMPS, which contains lines such as "12 atoms" and "0 1 xlo xhi".
bool is_data_of_lammps(const std::vector<std::vector<std::string_view>>& lines)
{
  const auto has = [&](std::size_t words, std::string_view last) {
    return std::any_of(lines.begin(), lines.end(), [&](const auto& line) {
      return line.size() == words && line.back() == last && are_numbers({line[0]}, 0);
    });
  };
  return has(2, "atoms") && (has(4, "xhi") || has(3, "types"));
}

struct Hdf5Start {
  std::vector<std::string> groups;  // names in the root of the file
  bool of_grseg = false;
};

Hdf5Start start_of_hdf5(const std::string& path)
{
  return read_guarded(path, path, [&] {
    const auto file = hdf5::open_for_reading(path);
    return Hdf5Start{hdf5::names_in(file, "/"), hdf5::exists(file, "/h5md/modules/grseg")};
  });
}

/// Says which other program's file this is, like other_kind(), from the names in an HDF5 root.
std::string other_kind_of_hdf5(const std::vector<std::string>& groups)
{
  const auto has = [&](const char* name) {
    return std::find(groups.begin(), groups.end(), name) != groups.end();
  };
  if (has("CreatorData") || has("TimestepData")) return is_of("an HDF5 file of EDEM", to_tables);
  if (has("Step#0")) return is_of("an H5Part file", to_tables);
  if (has("h5md")) return is_of("an H5MD file of another program, without contacts", to_tables);
  if (has("state") && has("version"))
    return is_of("a checkpoint of grseg-sim", "give its run to grseg-stress and the other tools");
  if (has("VTKHDF")) return is_of("a VTK file", from_paraview);
  if (has("frame") || has("coordinates")) return is_of("a netCDF file", to_dumps);
  return "";
}

}  // namespace

bool natural_less(const std::string& a, const std::string& b)
{
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      const auto x = number_at(a, i), y = number_at(b, j);
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
    } else if (a[i] != b[j]) {
      return a[i] < b[j];
    } else {
      ++i;
      ++j;
    }
  }
  return a.size() - i < b.size() - j;
}

std::vector<std::string> files_meant(const std::vector<std::string>& names)
{
  auto files = names;
  for (const auto& name : names) {
    const auto found = matches_of(name);
    files.insert(files.end(), found.begin(), found.end());
  }
  return files;
}

std::vector<std::string> archive_files(const std::vector<std::string>& names,
                                       const std::string& option)
{
  if (names.empty()) throw UsageError(fmt::format("name files with {}", option));
  std::vector<std::string> files;
  for (const auto& name : names) {
    if (name.find_first_of("*%") == std::string::npos || std::filesystem::exists(name)) {
      require_seekable(name);
      files.push_back(name);
      continue;
    }
    const auto found = matches_of(name);
    if (found.empty()) throw UsageError(fmt::format("{} {}: no file matches", option, name));
    files.insert(files.end(), found.begin(), found.end());
  }
  std::stable_sort(files.begin(), files.end(), natural_less);
  return files;
}

std::string other_kind(std::string_view start)
{
  if (start.starts_with(byte_order_mark)) start.remove_prefix(byte_order_mark.size());
  const auto named = [start](std::span<const Kind> kinds) -> std::string {
    for (const auto& [what, way_out, all_bytes, at] : kinds)
      for (const auto bytes : all_bytes)
        if (start.size() >= at && start.substr(at).starts_with(bytes)) return is_of(what, way_out);
    return "";
  };
  const bool is_text = std::none_of(start.begin(), start.end(), [](unsigned char c) {
    return c < ' ' && c != '\t' && c != '\n' && c != '\r';
  });
  if (auto kind = named(text_kinds); !kind.empty()) return kind;
  if (auto kind = named(binary_kinds); !kind.empty() && !is_text) return kind;
  if (start.starts_with("<?xml"))
    return start.find("<VTKFile") != start.npos ? is_of("a VTK file", from_paraview)
                                                : is_of("an XML file", to_tables);
  for (const auto json : {"{\""sv, "{\n"sv, "[{"sv, "[["sv, "[\n"sv})
    if (start.starts_with(json)) return is_of("a JSON file", in_pandas);
  constexpr std::size_t early = 16;
  if (start.substr(0, early).find('\0') != start.npos)
    return is_of(
        "not text",
        "turn a binary dump into text by binary2txt, save a table in UTF-16 as UTF-8, write "
        "output of other programs as tables (--format csv)");
  const auto lines = words_by_line(start);
  if (is_xyz(lines)) return is_of("an xyz file", to_dumps);
  if (is_data_of_lammps(lines)) return is_of("a data file of LAMMPS", from_restart);
  return kind_of_start(start).instead_of("a dump", "");
}

std::string kind_by_name(const std::string& path)
{
  for (const auto& [what, way_out, ends, unused] : named_kinds)
    for (const auto end : ends)
      if (path.ends_with(end)) return is_of(what, way_out);
  return "";
}

void refuse_other_kind(const std::string& path)
{
  constexpr std::size_t enough = 4096;
  require_seekable(path);
  std::string kind;
  if (hdf5::is_hdf5(path)) {
    const auto start = start_of_hdf5(path);
    if (start.of_grseg)
      throw UsageError(fmt::format(
          "{} is a trajectory of grseg already; grseg-stress and the other tools read it as it is",
          path));
    kind = other_kind_of_hdf5(start.groups);
  } else {
    kind = other_kind(unpacked_start(path, enough));
    if (const auto by_name = kind_by_name(path);
        kind.starts_with("is not text") && !by_name.empty())
      kind = by_name;
  }
  if (!kind.empty()) throw FormatError(fmt::format("{} {}", path, kind));
}

FileStart read_start(const std::string& path)
{
  refuse_other_kind(path);
  FileStart start{std::filesystem::path(path).filename().string(), {}, {}};
  if (hdf5::is_hdf5(path)) {
    start.groups = start_of_hdf5(path).groups;
    return start;
  }
  constexpr std::size_t most = 20;
  TextSource text({path});
  while (start.lines.size() < most && text.next()) start.lines.emplace_back(text.line());
  return start;
}

}  // namespace grseg
