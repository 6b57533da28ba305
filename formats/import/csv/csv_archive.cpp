// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/csv/csv_archive.hpp"

#include "formats/import/common/enclosing_cell.hpp"
#include "formats/import/common/file_list.hpp"
#include "formats/import/csv/csv_table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <sstream>

namespace grseg {
namespace {

namespace of_grain {
enum Column : std::size_t {
  time,
  id,
  x,
  y,
  z,
  radius,
  diameter,
  vx,
  vy,
  vz,
  wx,
  wy,
  wz,
  mass,
  type,
  fixed,
  fx,
  fy,
  fz
};
constexpr CsvTable::Column columns[] = {{"time|t", true},
                                        {"id", true},
                                        {"x", true},
                                        {"y", true},
                                        {"z", false},
                                        {"radius|r", false},
                                        {"diameter|d", false},
                                        {"vx", true},
                                        {"vy", true},
                                        {"vz", false},
                                        {"wx|omegax", false},
                                        {"wy|omegay", false},
                                        {"omega|wz|omegaz", false},
                                        {"mass|m", false},
                                        {"type|species", false},
                                        {"fixed", false},
                                        {"fx", false},
                                        {"fy", false},
                                        {"fz", false}};
}  // namespace of_grain

namespace of_contact {
enum Column : std::size_t { time, i, j, fx, fy, fz, overlap, bx, by, bz };
constexpr CsvTable::Column columns[] = {{"time|t", true},
                                        {"i|id1", true},
                                        {"j|id2", true},
                                        {"fx", true},
                                        {"fy", true},
                                        {"fz", false},
                                        {"overlap|delta|penetration", false},
                                        {"bx", false},
                                        {"by", false},
                                        {"bz", false}};
}  // namespace of_contact

Vec3 vector_at(const CsvTable& table, std::size_t row, std::size_t x)
{
  return {table.value(row, x), table.value(row, x + 1), table.value(row, x + 2)};
}

/// Whether there is a column of one of the three components.
bool has_any(const CsvTable& table, std::size_t x)
{
  return table.has(x) || table.has(x + 1) || table.has(x + 2);
}

void add_missing(const CsvTable& table, std::size_t x, const std::array<const char*, 3>& names,
                 std::vector<std::string>& missing)
{
  grseg::add_missing({table.has(x), table.has(x + 1), table.has(x + 2)}, names, missing);
}

[[noreturn]] void fail_at(const CsvTable& table, std::size_t row, const std::string& why)
{
  throw FormatError(fmt::format("{}, row {} of that time: {}", table.begin(), row + 1, why));
}

std::int64_t whole_number_at(const CsvTable& table, std::size_t row, std::size_t column,
                             const char* what)
{
  const double value = table.value(row, column);
  if (!(std::abs(value) < 2147483648.0) || std::trunc(value) != value)
    fail_at(table, row, fmt::format("{:g} is not {}", value, what));
  return static_cast<std::int64_t>(value);
}

class CsvArchive : public Archive {
 public:
  explicit CsvArchive(const ArchiveFiles& files)
      : grains_(archive_files(files.grains, "--grains"), of_grain::columns),
        contacts_(archive_files(files.contacts, "--contacts"), of_contact::columns)
  {
    facts_.tolerance = 1e-4;
    facts_.tolerance_reason = "the digits of the tables";
    for (const auto& comment : grains_.comments()) read_comment(comment);
  }
  const ArchiveFacts& facts() const override { return facts_; }
  bool next(ArchiveMoment& moment) override;
  std::vector<std::string> remarks() const override;

 private:
  void read_comment(const std::string& comment);
  bool next_of_both();
  void fill(ArchiveGrains& grains) const;
  void fill(ArchiveContacts& contacts) const;

  CsvTable grains_, contacts_;
  ArchiveFacts facts_;
  Vec3 low_ = Vec3::Zero(), high_ = Vec3::Zero();
  std::array<bool, 3> periodic_{};
  std::size_t grains_alone_ = 0, contacts_alone_ = 0;
};

void CsvArchive::read_comment(const std::string& comment)
{
  constexpr std::string_view word = "# periodic:";
  if (!comment.starts_with(word)) return;
  std::istringstream text(comment.substr(word.size()));
  std::string axis, more;
  double low = NAN, high = NAN;
  text >> axis >> low >> high;
  const auto k = std::string_view("xyz").find(axis);
  if (axis.size() != 1 || k == std::string_view::npos || !(low < high) || text >> more)
    throw FormatError(
        fmt::format("{} is not of the form '# periodic: x 0 0.35'", in_quotes(comment)));
  periodic_[k] = true;
  low_[static_cast<Eigen::Index>(k)] = low;
  high_[static_cast<Eigen::Index>(k)] = high;
}

/// Goes to the next time that both tables have.
bool CsvArchive::next_of_both()
{
  bool more_grains = grains_.next(), more_contacts = contacts_.next();
  while (more_grains && more_contacts) {
    const double a = grains_.time(), b = contacts_.time();
    if (std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b))) return true;
    if (a < b) {
      ++grains_alone_;
      more_grains = grains_.next();
    } else {
      ++contacts_alone_;
      more_contacts = contacts_.next();
    }
  }
  return false;
}

bool CsvArchive::next(ArchiveMoment& moment)
{
  if (!next_of_both()) return false;
  moment = ArchiveMoment{};
  moment.time = grains_.time();
  moment.place =
      fmt::format("t = {:g} ({}; {})", grains_.time(), grains_.begin(), contacts_.begin());
  moment.periodic = periodic_;
  moment.low = low_;
  moment.high = high_;
  fill(moment.grains);
  enclose_grains(moment);
  fill(moment.contacts);
  return true;
}

void CsvArchive::fill(ArchiveGrains& grains) const
{
  using namespace of_grain;
  const auto& table = grains_;
  for (std::size_t k = 0; k < table.rows(); ++k) {
    grains.id.push_back(whole_number_at(table, k, id, "an id"));
    grains.position.push_back(vector_at(table, k, x));
    grains.velocity.push_back(vector_at(table, k, vx));
    if (table.has(radius) || table.has(diameter))
      grains.radius.push_back(table.has(radius) ? table.value(k, radius)
                                                : table.value(k, diameter) / 2);
    if (has_any(table, wx)) grains.angular_velocity.push_back(vector_at(table, k, wx));
    if (table.has(mass)) grains.mass.push_back(table.value(k, mass));
    if (table.has(type))
      grains.type.push_back(static_cast<std::int32_t>(whole_number_at(table, k, type, "a type")));
    if (table.has(fixed)) grains.fixed.push_back(table.value(k, fixed) != 0);
    if (has_any(table, fx)) grains.force.push_back(vector_at(table, k, fx));
  }
  add_missing(table, x, {"x", "y", "z"}, grains.missing);
  add_missing(table, vx, {"vx", "vy", "vz"}, grains.missing);
  add_missing(table, wx, {"wx", "wy", "wz"}, grains.missing);
  add_missing(table, fx, {"fx", "fy", "fz"}, grains.missing);
}

void CsvArchive::fill(ArchiveContacts& contacts) const
{
  using namespace of_contact;
  const auto& table = contacts_;
  for (std::size_t k = 0; k < table.rows(); ++k) {
    const auto second = whole_number_at(table, k, j, "an id");
    if (second < 0 && !has_any(table, bx))
      fail_at(table, k, "a contact with a wall needs its branch, columns bx and by (and bz)");
    contacts.i.push_back(whole_number_at(table, k, i, "an id"));
    contacts.j.push_back(second);
    contacts.wall.push_back(second < 0 ? static_cast<std::int32_t>(-second - 1) : -1);
    contacts.force.push_back(vector_at(table, k, fx));
    if (table.has(overlap)) contacts.overlap.push_back(table.value(k, overlap));
    if (has_any(table, bx)) contacts.branch.push_back(vector_at(table, k, bx));
  }
  add_missing(table, fx, {"fx", "fy", "fz"}, contacts.missing);
  add_missing(table, bx, {"bx", "by", "bz"}, contacts.missing);
}

std::vector<std::string> CsvArchive::remarks() const
{
  std::vector<std::string> remarks;
  if (grains_alone_ > 0)
    remarks.push_back(
        fmt::format("{} moments have grains but no contacts and are left out", grains_alone_));
  if (contacts_alone_ > 0)
    remarks.push_back(
        fmt::format("{} moments have contacts but no grains and are left out", contacts_alone_));
  return remarks;
}

/// Contacts name two grains in the line of names.
FileRole role_of(const FileStart& start)
{
  for (const auto& line : start.lines) {
    if (line.empty() || line.starts_with('#')) continue;
    const auto names = names_in_header(line);
    const auto has = [&](const char* name) {
      return std::find(names.begin(), names.end(), name) != names.end();
    };
    if (has("j") || has("id2")) return FileRole::contacts;
    return has("x") && has("y") ? FileRole::grains : FileRole::none;
  }
  return FileRole::none;
}

}  // namespace

std::unique_ptr<Archive> open_csv(const ArchiveFiles& files)
{
  return std::make_unique<CsvArchive>(files);
}

const ArchiveFormat csv_format{
    .name = "csv",
    .open = open_csv,
    .role = role_of,
    .takes_columns = false,
    .examples =
        "  grseg-import --format csv --grains grains.csv --contacts contacts.csv \\\n"
        "    --units si --step 1e-5 --gravity 9.81 --slope 23 -o run.h5\n",
    .notes =
        "  csv: tables whose first line names the columns (grains: time id x y vx vy and\n"
        "  radius|diameter; optional z vz wx wy omega mass type fixed fx fy fz; contacts:\n"
        "  time i j fx fy; optional fz overlap bx by bz; in three dimensions all of x y z)\n"};

}  // namespace grseg
