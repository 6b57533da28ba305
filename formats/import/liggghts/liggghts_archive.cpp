// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/errors.hpp"
#include "formats/import/common/archive.hpp"
#include "formats/import/common/text_values.hpp"
#include "formats/import/dump/contact_columns.hpp"
#include "formats/import/dump/dump_archive.hpp"
#include "formats/import/liggghts/liggghts_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

namespace grseg {
namespace {

struct Block {
  const char* keyword;
  std::size_t columns;
};

/// Blocks of columns, in the order of LIGGGHTS' source. (The manual lists another order.)
constexpr Block blocks[] = {
    {"pos", 6},
    {"vel", 6},
    {"id", 3},  // two ids, and a flag: 1 if the contact crosses a periodic boundary
    {"force", 3},
    {"force_normal", 3},
    {"force_tangential", 3},
    {"torque", 3},
    {"torque_normal", 3},
    {"torque_tangential", 3},
    {"history", 3},
    {"contactArea", 1},
    {"delta", 1},
    {"contactPoint", 3},
    {"ms_id", 2},
};

constexpr std::pair<const char*, const char*> presets[] = {
    {"forcechain12", "pos,id,force"},
    {"liggghts-default", "pos,vel,id,force,torque,history,contactArea"},
    {"liggghts-full35",
     "pos,vel,id,force,force_normal,force_tangential,torque,history,contactArea,delta,"
     "contactPoint"},
};

/// Lists of keywords to try if no preset fits; versions before 2 wrote the first one.
constexpr const char* often[] = {"pos,id,force,torque,history,contactArea",
                                 "pos,id,force,delta",
                                 "id,force",
                                 "id,force,delta",
                                 "id,force,force_normal,force_tangential",
                                 "id,force_normal,force_tangential",
                                 "pos,id,force,force_normal,force_tangential",
                                 "pos,vel,id,force",
                                 "pos,id,force,contactPoint"};

std::string keywords_of(const std::string& columns)
{
  for (const auto& [name, keywords] : presets)
    if (columns == name) return keywords;
  return columns;
}

/// First column of each block, from 1; 0: the block is missing.
struct Layout {
  std::array<std::size_t, std::size(blocks)> first{};
  std::size_t columns = 0;

  std::size_t operator[](std::string_view keyword) const
  {
    for (std::size_t b = 0; b < std::size(blocks); ++b)
      if (keyword == blocks[b].keyword) return first[b];
    return 0;
  }
};

Layout layout_of(const std::string& columns)
{
  std::array<std::size_t, std::size(blocks)> width{};
  for (const auto& word : parts_of(keywords_of(columns), ',')) {
    const auto colon = word.find(':');
    const auto name = word.substr(0, colon);
    const auto* const block = std::find_if(std::begin(blocks), std::end(blocks),
                                           [&](const Block& b) { return name == b.keyword; });
    std::size_t count = block == std::end(blocks) ? 0 : block->columns;
    if (colon != std::string::npos)
      count = name == "history" ? number_of(word.substr(colon + 1)) : 0;
    if (block == std::end(blocks) || count < 1 || count > 100) {
      std::vector<std::string> known;
      for (const auto& b : blocks) known.emplace_back(b.keyword);
      for (const auto& preset : presets) known.emplace_back(preset.first);
      throw UsageError(
          fmt::format("--columns: '{}' is not a keyword of pair/gran/local; choose from {}", word,
                      fmt::join(known, ", ")));
    }
    width[static_cast<std::size_t>(block - std::begin(blocks))] = count;
  }
  Layout layout;
  for (std::size_t b = 0; b < width.size(); ++b) {
    if (width[b] > 0) layout.first[b] = layout.columns + 1;
    layout.columns += width[b];
  }
  return layout;
}

/// The number of a compute's column, 13 from "c_cp[13]"; 0 for other names.
std::size_t number_in(const std::string& name)
{
  const auto open = name.find('[');
  if (open == std::string::npos || !name.starts_with("c_") || !name.ends_with(']')) return 0;
  return number_of(name.substr(open + 1, name.size() - open - 2));
}

/// Map from columns of the compute to columns of the dump.
class Dumped {
 public:
  explicit Dumped(const DumpHeader& header) : count_(header.columns.size())
  {
    for (const auto& name : header.columns) numbers_.push_back(number_in(name));
    // The column `index` counts rows and does not belong to the compute.
    const bool has_index = count_ > 1 && header.find("index");
    const auto unknown = std::count(numbers_.begin(), numbers_.end(), 0U);
    numbered_ = count_ > 0 && unknown == (has_index ? 1 : 0);
    if (numbered_ && has_index) --count_;
  }
  /// Column of the dump, from 1, for a column of the compute; 0 if it was not dumped.
  std::size_t column(std::size_t of_compute) const
  {
    if (!numbered_) return of_compute <= count_ ? of_compute : 0;
    const auto at = std::find(numbers_.begin(), numbers_.end(), of_compute);
    return at == numbers_.end() ? 0 : static_cast<std::size_t>(at - numbers_.begin()) + 1;
  }
  /// Number of the dump's columns that belong to the compute.
  std::size_t count() const { return count_; }
  /// True if a compute with this number of columns may have written the dump, which has all of them
  /// or a selection that its column names show.
  bool fits(std::size_t columns) const
  {
    const auto last = numbered_ ? *std::max_element(numbers_.begin(), numbers_.end()) : count_;
    return last == columns || (last < columns && last != count_);
  }

 private:
  std::size_t count_;
  std::vector<std::size_t> numbers_;
  bool numbered_ = false;
};

/// True if both mappings have ids and force in the same columns.
bool are_at_the_same_places(const std::string& keywords, const std::string& named,
                            const DumpHeader& contacts)
{
  const auto places_of = [&](const std::string& mapping) {
    ContactColumns columns(mapping);
    columns.look_up(contacts.columns, contacts.place);
    const auto& places = columns.wanted();
    return std::vector(places.begin(),
                       places.begin() + std::min<std::ptrdiff_t>(std::ssize(places), 3));
  };
  return places_of(liggghts_mapping(keywords, contacts)) == places_of(named);
}

/// Facts of a run of LIGGGHTS, whose grains are always spheres, also in a plane.
ArchiveFacts facts_of_liggghts()
{
  auto facts = facts_of_late_forces("LIGGGHTS");
  facts.discs = false;
  return facts;
}

/// The mapping without --columns. If column names are meaningful, it is the list of keywords with
/// ids and force in these columns, because the list also knows the other columns; without such a
/// list it is the mapping by names. If names have no meaning, it is a preset.
std::string assumed_columns(const DumpHeader& contacts, const ArchiveGrains&)
{
  auto named = columns_by_name(contacts, PlainForce::whole);
  for (auto& columns : liggghts_columns_of(contacts)) {
    const bool is_preset = columns.find(',') == std::string::npos;
    if (named.empty() ? is_preset : are_at_the_same_places(columns, named, contacts))
      return columns;
  }
  return named;
}

bool is_of_liggghts(const FileStart& start)
{
  return role_of_dump(start) == FileRole::grains || are_of_liggghts(columns_of_dump(start));
}

/// Opens a `dump custom` of grains and a `dump local` of `compute pair/gran/local` of LIGGGHTS
/// (compute_pair_gran_local.cpp; liggghts_columns.hpp for the columns). Without --columns a dump of
/// 12, 25 or 35 columns is assumed to be the preset of that size; the grains' force balances verify
/// this. `force` is the total force on the first of the two ids. Text has 6 digits unless
/// dump_modify sets another format, so `delta`, if dumped, is used as the overlap. Contacts with
/// meshes are in a separate dump, of `compute wall/gran/local`; contacts with primitive walls are
/// in no dump.
std::unique_ptr<Archive> open_liggghts(const ArchiveFiles& files)
{
  static const DumpDialect dialect{assumed_columns,       liggghts_mapping,
                                   liggghts_columns_of,   "pos,id,force,delta",
                                   liggghts_wall_mapping, facts_of_liggghts()};
  return open_dumps(files, dialect);
}

}  // namespace

std::string liggghts_mapping(const std::string& columns, const DumpHeader& contacts)
{
  if (columns.find('=') != std::string::npos) return columns;
  const auto layout = layout_of(columns);
  const Dumped dumped(contacts);
  if (!dumped.fits(layout.columns))
    throw UsageError(fmt::format("--columns {}: these are {} columns, but {} has {}", columns,
                                 layout.columns, contacts.place, fmt::join(contacts.columns, " ")));
  std::string mapping;
  const auto add = [&](const char* meaning, std::size_t of_compute) {
    const auto column = of_compute > 0 ? dumped.column(of_compute) : 0;
    if (column > 0) mapping += fmt::format("{}{}={}", mapping.empty() ? "" : ",", meaning, column);
  };
  const auto add_vector = [&](const std::array<const char*, 3>& meanings, std::size_t first) {
    for (std::size_t k = 0; first > 0 && k < 3; ++k) add(meanings[k], first + k);
  };
  add("i", layout["id"]);
  add("j", layout["id"] > 0 ? layout["id"] + 1 : 0);
  if (layout["force"] > 0) {
    add_vector({"fx", "fy", "fz"}, layout["force"]);
  } else if (layout["force_normal"] > 0 && layout["force_tangential"] > 0) {
    add_vector({"fx", "fy", "fz"}, layout["force_normal"]);
    add_vector({"tx", "ty", "tz"}, layout["force_tangential"]);
  }
  add("overlap", layout["delta"]);
  if (mapping.find("j=") == std::string::npos || mapping.find("fx=") == std::string::npos)
    throw UsageError(fmt::format(
        "--columns {}: id, and force or its normal and tangential part, are required and must be "
        "in {}",
        columns, contacts.place));
  return mapping;
}

std::string liggghts_wall_mapping(const std::string& columns, const DumpHeader& walls)
{
  if (columns.find('=') != std::string::npos) return columns;
  const auto keywords = columns.empty() ? "pos,id,force" : columns;
  const auto layout = layout_of(keywords);
  const Dumped dumped(walls);
  if (!dumped.fits(layout.columns))
    throw UsageError(fmt::format(
        "--wall-columns {}: these are {} columns, but {} has {}; list the keywords of the "
        "compute wall/gran/local",
        keywords, layout.columns, walls.place, fmt::join(walls.columns, " ")));
  const std::pair<const char*, std::size_t> meanings[] = {
      {"px", layout["pos"]},    {"py", layout["pos"] + 1},      {"pz", layout["pos"] + 2},
      {"x", layout["pos"] + 3}, {"y", layout["pos"] + 4},       {"z", layout["pos"] + 5},
      {"mesh", layout["id"]},   {"triangle", layout["id"] + 1}, {"id", layout["id"] + 2},
      {"fx", layout["force"]},  {"fy", layout["force"] + 1},    {"fz", layout["force"] + 2}};
  std::string mapping;
  bool all_there = layout["pos"] > 0 && layout["id"] > 0 && layout["force"] > 0;
  for (const auto& [meaning, of_compute] : meanings) {
    const auto column = dumped.column(of_compute);
    all_there = all_there && column > 0;
    mapping += fmt::format("{}{}={}", mapping.empty() ? "" : ",", meaning, column);
  }
  if (!all_there)
    throw UsageError(
        fmt::format("--wall-columns {}: pos, id and force are required and must be in {}", keywords,
                    walls.place));
  return mapping;
}

bool are_of_liggghts(const std::vector<std::string>& columns)
{
  constexpr std::size_t more_than_of_lammps = 12;
  std::vector<std::string> names;
  std::size_t last = 0;
  bool has_index = false, of_one = true;
  std::string compute;
  for (const auto& column : columns) {
    names.push_back(compared_name(column));
    if (column == "index") {
      has_index = true;
      continue;
    }
    const auto name = column.substr(0, column.find('['));
    of_one = of_one && number_in(column) > 0 && (compute.empty() || compute == name);
    compute = name;
    last = std::max(last, number_in(column));
  }
  if (of_one && last > 0) return !has_index || last >= more_than_of_lammps;
  const auto has = [&](const char* name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  return has("periodic") || (has("x1") && has("x2"));
}

std::vector<std::string> liggghts_columns_of(const DumpHeader& contacts)
{
  std::vector<std::string> fitting;
  const Dumped dumped(contacts);
  const auto count = dumped.count();
  for (const auto& preset : presets)
    if (layout_of(preset.first).columns == count && dumped.fits(count))
      fitting.emplace_back(preset.first);
  for (const char* keywords : often)
    if (layout_of(keywords).columns == count && dumped.fits(count)) fitting.emplace_back(keywords);
  return fitting;
}

const ArchiveFormat liggghts_format{
    .name = "liggghts",
    .open = open_liggghts,
    .role = role_of_dump,
    .is_of_program = is_of_liggghts,
    .takes_map = true,
    .takes_wall_contacts = true,
    .takes_wall_columns = true,
    .examples =
        "  grseg-import --format liggghts --grains 'atoms_*' --contacts 'contacts_*' \\\n"
        "    --units si --columns pos,id,force,delta --step 5e-6 --gravity 9.81 --slope 23 \\\n"
        "    --axes xz --boundary 3 -o run.h5\n",
    .notes = "  liggghts: --columns may also list the keywords of the compute pair/gran/local\n"};

}  // namespace grseg
