// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/common/archive.hpp"
#include "formats/import/common/text_values.hpp"
#include "formats/import/common/unused_columns.hpp"
#include "formats/import/csv/csv_map.hpp"
#include "formats/import/csv/csv_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <memory>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace grseg {
namespace {

/// Facts of the run, from the comments above a table of grains, in the table's units, a line each:
///   # periodic: x 0 0.35          a line for each periodic axis
///   # gravity: 3.83 -9.02 0
///   # step: 1e-5
///   # units: si                   or cgs, lj
///   # grains: spheres             or discs
/// Other comments are ignored.
struct CsvComments {
  ArchiveFacts facts;
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  // bounds of the cell along periodic axes
  std::array<bool, 3> periodic{};
};

/// Reads the next word as a number; NaN if it is not one.
double next_number(std::istream& text)
{
  std::string word;
  double number = NAN;
  return text >> word && read_number(word, number) ? number : NAN;
}

std::string next_word(std::istream& text)
{
  std::string word;
  text >> word;
  return word;
}

bool read_period(std::istream& text, CsvComments& found)
{
  const auto axis = next_word(text);
  const double low = next_number(text), high = next_number(text);
  const auto k = std::string_view("xyz").find(axis);
  if (axis.size() != 1 || k == std::string_view::npos || !(low < high)) return false;
  found.periodic[k] = true;
  found.low[static_cast<Eigen::Index>(k)] = low;
  found.high[static_cast<Eigen::Index>(k)] = high;
  return true;
}

struct Line {
  std::string_view word;
  bool (*read)(std::istream&, CsvComments&);
  const char* form;
};

constexpr Line lines[] = {{"# periodic:", read_period, "# periodic: x 0 0.35"},
                          {"# gravity:",
                           [](std::istream& text, CsvComments& found) {
                             auto& gravity = found.facts.gravity.emplace();
                             for (double& component : gravity) component = next_number(text);
                             return gravity.allFinite();
                           },
                           "# gravity: 3.83 -9.02 0"},
                          {"# step:",
                           [](std::istream& text, CsvComments& found) {
                             return found.facts.step.emplace(next_number(text)) > 0;
                           },
                           "# step: 1e-5"},
                          {"# units:",
                           [](std::istream& text, CsvComments& found) {
                             const auto& units = found.facts.units.emplace(next_word(text));
                             return units == "si" || units == "cgs" || units == "lj";
                           },
                           "# units: si"},
                          {"# grains:",
                           [](std::istream& text, CsvComments& found) {
                             const auto grains = next_word(text);
                             found.facts.discs = grains == "discs";
                             return grains == "discs" || grains == "spheres";
                           },
                           "# grains: spheres"}};

/// Reads the facts. Throws FormatError if one of these lines does not have its form.
CsvComments read_csv_comments(const std::vector<std::string>& comments)
{
  CsvComments found;
  for (const auto& comment : comments)
    for (const auto& [word, read, form] : lines) {
      if (!comment.starts_with(word)) continue;
      std::istringstream text(comment.substr(word.size()));
      std::string more;
      if (!read(text, found) || text >> more)
        throw FormatError(fmt::format("{} is not of the form '{}'", in_quotes(comment), form));
    }
  return found;
}

using Column = CsvTable::Column;

namespace of_grain {
enum : std::size_t { id = 2, x, radius = 6, diameter, vx, wx = 11, mass = 14, type, fixed, fx };
constexpr Column columns[] = {{"time|t"},
                              {"step|timestep|iteration|cycle"},
                              {"id", true, Column::ids},
                              {"x", true},
                              {"y"},
                              {"z"},
                              {"radius|r"},
                              {"diameter|d"},
                              {"vx", true},
                              {"vy"},
                              {"vz"},
                              {"wx|omegax"},
                              {"wy|omegay"},
                              {"omega|wz|omegaz"},
                              {"mass|m"},
                              {"type|species", false, Column::words},
                              {"fixed", false, Column::truth},
                              {"fx"},
                              {"fy"},
                              {"fz"}};
}  // namespace of_grain

namespace of_contact {
enum : std::size_t { i = 2, j, fx, overlap = 7, bx };
constexpr Column columns[] = {{"time|t"},      {"step|timestep|iteration|cycle"},
                              {"i|id1", true}, {"j|id2", true},
                              {"fx", true},    {"fy"},
                              {"fz"},          {"overlap|delta|penetration"},
                              {"bx"},          {"by"},
                              {"bz"}};
}  // namespace of_contact

Vec3 vector_at(const CsvTable& table, std::size_t row, std::size_t x)
{
  return {table.value(row, x), table.value(row, x + 1), table.value(row, x + 2)};
}

/// True if the table has a column for at least one of the three components.
bool has_any(const CsvTable& table, std::size_t x)
{
  return table.has(x) || table.has(x + 1) || table.has(x + 2);
}

/// Appends the names of missing components to `missing`; a name is `letters` and x, y or z.
void add_missing(const CsvTable& table, std::size_t x, const std::string& letters,
                 std::vector<std::string>& missing)
{
  for (std::size_t k = 0; has_any(table, x) && k < 3; ++k)
    if (!table.has(x + k)) missing.push_back(letters + "xyz"[k]);
}

[[noreturn]] void fail_at(const CsvTable& table, std::size_t row, const std::string& why)
{
  throw FormatError(fmt::format("{}, row {} of this frame: {}", table.begin(), row + 1, why));
}

std::int64_t whole_number_at(const CsvTable& table, std::size_t row, std::size_t column,
                             const char* what)
{
  const double value = table.value(row, column);
  if (!is_whole(value)) fail_at(table, row, fmt::format("{:g} is not {}", value, what));
  return static_cast<std::int64_t>(value);
}

std::int32_t wall_at(const CsvTable& table, std::size_t row, std::int64_t j)
{
  if (j < std::numeric_limits<std::int32_t>::min())
    fail_at(table, row, fmt::format("{} is not a wall", j));
  return j < 0 ? static_cast<std::int32_t>(-j - 1) : -1;
}

std::vector<std::string> all_names(std::span<const CsvTable::Column> columns)
{
  std::vector<std::string> names;
  for (const auto& column : columns) {
    for (const auto& word : parts_of(column.names, '|')) names.push_back(word);
  }
  return names;
}

/// A sentence about columns that the table lacks; each vector that begins at one of `vectors` needs
/// y or z.
std::string complaint_of(const CsvTable& table,
                         std::initializer_list<std::pair<std::size_t, const char*>> vectors)
{
  auto missing = table.missing();
  for (const auto& [x, y] : vectors)
    if (!table.has(x + 1) && !table.has(x + 2)) missing.emplace_back(y);
  return table.complaint(missing);
}

/// Names in headers that viewers add, without a meaning for the grains.
bool is_of_a_viewer(const std::string& name)
{
  const auto plain = plain_name(name);
  return plain.starts_with("vtkoriginal") || plain.ends_with("magnitude") || plain == "colour" ||
         plain == "color" || plain == "temperature" || plain == "density" || plain == "element" ||
         plain == "name";
}

class CsvArchive : public Archive {
 public:
  explicit CsvArchive(const ArchiveFiles& files)
      : grains_map_(files.map, all_names(of_grain::columns), all_names(of_contact::columns)),
        contacts_map_(files.map, all_names(of_contact::columns), all_names(of_grain::columns)),
        grains_(csv_files(files.grains, "--grains"), of_grain::columns, grains_map_),
        contacts_(csv_files(files.contacts, "--contacts"), of_contact::columns, contacts_map_),
        comments_(read_csv_comments(grains_.comments())),
        facts_(comments_.facts)
  {
    grains_map_.require_all_used(contacts_map_);
    const auto grains = complaint_of(grains_, {{of_grain::x, "y"}, {of_grain::vx, "vy"}});
    const auto contacts = complaint_of(contacts_, {{of_contact::fx, "fy"}});
    if (!grains.empty() || !contacts.empty())
      throw FormatError(grains + (grains.empty() || contacts.empty() ? "" : "; ") + contacts);
    facts_.tolerance = 1e-4;
    facts_.lists_all = false;  // the table may come from contact dynamics
    facts_.tolerance_reason = "the digits of the tables";
  }

  const ArchiveFacts& facts() const override { return facts_; }

  bool next(ArchiveFrame& frame) override
  {
    if (!next_of_both()) return false;
    frame = ArchiveFrame{};
    const auto [value, is_step] = grains_.time();
    if (!is_step)
      frame.time = value;
    else if (is_whole(value))
      frame.step = static_cast<std::int64_t>(value);
    else
      grains_.fail(fmt::format("{:g} is not a step", value));
    frame.place = fmt::format("{} = {:g} ({}; {})", is_step ? "step" : "t", value, grains_.begin(),
                              contacts_.begin());
    frame.periodic = comments_.periodic;
    frame.low = comments_.low;
    frame.high = comments_.high;
    fill(frame.grains);
    enclose_grains(frame);
    fill(frame.contacts);
    ask_for_columns(frame);
    judge_digits(frame.contacts.force);
    return true;
  }

  std::vector<std::string> remarks() const override
  {
    return matching_.remarks(grains_.time().is_step ? "step" : "t =");
  }

 private:
  /// Asks once for columns of grains without known names. Columns of contacts cannot mislead: forces
  /// must balance, and pairs must touch.
  void ask_for_columns(ArchiveFrame& frame)
  {
    if (std::exchange(has_asked_, true)) return;
    auto unused = grains_.unused();
    std::erase_if(unused, is_of_a_viewer);
    if (auto question = question_of_columns(unused, grains_.begin()))
      frame.questions.push_back(std::move(*question));
  }

  /// Ten rounded forces, half a unit of the last digit each, may be missing in a grain's balance.
  void judge_digits(const std::vector<Vec3>& forces)
  {
    constexpr std::size_t enough = 10;  // a table by hand may have few digits that are exact
    const int written = forces.size() < enough ? 0 : digits_of(forces);
    if (written < 3 || 5 * std::pow(10, 1 - written) <= facts_.tolerance) return;
    facts_.tolerance = 5 * std::pow(10, 1 - written);
    facts_.tolerance_reason = fmt::format("forces in the tables have {} digits", written);
  }

  /// Advances to the next frame that both tables have.
  bool next_of_both()
  {
    const auto table = [](CsvTable& of) {
      return Matching::Table{[&of] { return of.next(); },
                             [&of] {
                               const auto [value, is_step] = of.time();
                               return fmt::format("{:.{}g}", value, is_step ? 17 : 10);
                             }};
    };
    const auto order = [this] {
      const auto grains = grains_.time(), contacts = contacts_.time();
      if (grains.is_step != contacts.is_step)
        contacts_.fail(fmt::format(
            "the table of contacts has {}, but the table of grains has {}: write the same in both, "
            "as a column or in the names of files",
            contacts.is_step ? "steps" : "times", grains.is_step ? "steps" : "times"));
      const double a = grains.value, b = contacts.value;
      const double scale =
          std::max({std::abs(a), std::abs(b), grains_.interval(), contacts_.interval()});
      if (std::abs(a - b) <= 1e-9 * scale) return 0;
      return a < b ? -1 : 1;
    };
    return matching_.next(table(grains_), table(contacts_), order);
  }

  void fill(ArchiveGrains& grains)
  {
    using namespace of_grain;
    auto& table = grains_;
    std::vector<double> types;
    for (std::size_t k = 0; k < table.rows(); ++k) {
      grains.id.push_back(whole_number_at(table, k, id, "an id"));
      grains.position.push_back(vector_at(table, k, x));
      grains.velocity.push_back(vector_at(table, k, vx));
      if (table.has(radius) || table.has(diameter))
        grains.radius.push_back(table.has(radius) ? table.value(k, radius)
                                                  : table.value(k, diameter) / 2);
      if (has_any(table, wx)) grains.angular_velocity.push_back(vector_at(table, k, wx));
      if (table.has(mass)) grains.mass.push_back(table.value(k, mass));
      if (table.has(type)) types.push_back(table.value(k, type));
      if (table.has(fixed)) grains.fixed.push_back(table.value(k, fixed) != 0);
      if (has_any(table, fx)) grains.force.push_back(vector_at(table, k, fx));
    }
    table.words().fill(types, table.begin(), grains);
    add_missing(table, x, "", grains.missing);
    add_missing(table, vx, "v", grains.missing);
    add_missing(table, wx, "w", grains.missing);
    add_missing(table, fx, "f", grains.missing);
  }

  void fill(ArchiveContacts& contacts) const
  {
    using namespace of_contact;
    const auto& table = contacts_;
    for (std::size_t k = 0; k < table.rows(); ++k) {
      const auto second = whole_number_at(table, k, j, "an id");
      if (second < 0 && !has_any(table, bx))
        fail_at(table, k, "a contact with a wall needs its branch, columns bx and by (and bz)");
      contacts.i.push_back(whole_number_at(table, k, i, "an id"));
      contacts.j.push_back(second);
      contacts.wall.push_back(wall_at(table, k, second));
      contacts.force.push_back(vector_at(table, k, fx));
      if (table.has(overlap)) contacts.overlap.push_back(table.value(k, overlap));
      if (has_any(table, bx)) contacts.branch.push_back(vector_at(table, k, bx));
    }
    add_missing(table, fx, "f", contacts.missing);
    add_missing(table, bx, "b", contacts.missing);
  }

  CsvMap grains_map_, contacts_map_;
  CsvTable grains_, contacts_;
  CsvComments comments_;
  ArchiveFacts facts_;
  Matching matching_;
  bool has_asked_ = false;  // true: the columns of the first frame were asked for
};

/// Role of a file by its line of column names: a table of contacts has a column j or id2.
FileRole role_of(const FileStart& start)
{
  for (const auto& line : start.lines) {
    if (line.empty() || line.starts_with('#')) continue;
    std::vector<std::string_view> names;
    split_csv(line, csv_separator(line), names);
    const auto has = [&](const char* name) {
      return std::any_of(names.begin(), names.end(),
                         [&](std::string_view known) { return plain_name(known) == name; });
    };
    if (has("j") || has("id2")) return FileRole::contacts;
    return has("x") && (has("y") || has("z")) ? FileRole::grains : FileRole::none;
  }
  return FileRole::none;
}

/// Opens two plain tables (csv_table.hpp), which a script can write for any program. Names of
/// columns and their synonyms follow; `files.map` adds the user's names (csv_map.hpp). Missing
/// components are 0.
///   grains    time|t id x y z; radius|r or diameter|d; vx vy vz, omega|wz|omegaz (also wx|omegax,
///             wy|omegay), mass|m, type|species, fixed, fx fy fz: the total force, with gravity
///   contacts  time|t i|id1 j|id2 fx fy fz: force ON i FROM j; overlap|delta|penetration; bx by bz:
///             branch x_i - x_j
/// The time can be replaced by step|timestep|iteration|cycle, or by one file per frame
/// (csv_table.hpp). j < 0 means straight wall -j-1, which needs a branch (x_i - contact point).
/// Frames of the two tables are matched by time or step. Comments above the grains' column names
/// may state facts of the run (CsvComments).
std::unique_ptr<Archive> open_csv(const ArchiveFiles& files)
{
  return std::make_unique<CsvArchive>(files);
}

}  // namespace

const ArchiveFormat csv_format{
    .name = "csv",
    .open = open_csv,
    .role = role_of,
    .takes_columns = false,
    .takes_map = true,
    .examples =
        "  grseg-import --format csv --grains grains.csv --contacts contacts.csv \\\n"
        "    --units si --step 1e-5 --gravity 9.81 --slope 23 -o run.h5\n"
        "  grseg-import --format csv --grains 'grains_*.csv' --contacts 'contacts_*.csv' \\\n"
        "    --map particle1=i,particle2=j,Fx=fx,Fy=fy --units si --step 1e-5 --gravity 9.81 \\\n"
        "    --slope 23 -o run.h5\n",
    .notes =
        "  csv: tables whose first line names the columns. Grains: time id x y vx vy and radius\n"
        "  or diameter; optional z vz wx wy omega mass type fixed fx fy fz. Contacts: time i j\n"
        "  fx fy; optional fz overlap bx by bz. Vectors in 3D need x, y and z. Instead of time:\n"
        "  a column step, or one file per step with the step in its name\n"};

}  // namespace grseg
