// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/dump/dump_archive.hpp"

#include "formats/import/common/archive_files.hpp"
#include "formats/import/dump/contact_columns.hpp"
#include "formats/import/dump/dump_grains.hpp"
#include "formats/import/dump/dump_pair.hpp"
#include "formats/import/dump/fitting_columns.hpp"
#include "formats/import/dump/wall_contacts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace grseg {
namespace {

class DumpArchive : public Archive {
 public:
  DumpArchive(const std::vector<std::string>& grains, const std::vector<std::string>& contacts,
              const std::vector<std::string>& walls, const ArchiveFiles& files,
              const DumpDialect& dialect)
      : dialect_(dialect),
        dumps_(grains, contacts, walls),
        grain_files_(grains),
        contact_files_(contacts),
        columns_text_(files.columns),
        wall_text_(files.wall_columns),
        wall_columns_(walls.empty() ? files.wall_columns : "none"),
        facts_(dialect.facts)
  {
    facts_.step = dumps_.step();
  }

  const ArchiveFacts& facts() const override { return facts_; }
  std::string columns() const override { return columns_text_; }
  std::vector<std::string> remarks() const override { return dumps_.remarks(); }
  std::optional<ColumnFit> fitting_columns(const Vec3& gravity) const override
  {
    return fit_of_columns(columns_text_, gravity);
  }

  bool next(ArchiveMoment& moment) override
  {
    if (!next_grains(moment)) return false;
    try {
      read_contacts(moment);
    } catch (const TruncatedArchive&) {
      dumps_.keep_grains();
      throw;
    }
    if (dumps_.walls()) read_walls(*dumps_.walls(), moment);
    wall_columns_.add_to(
        moment, [&](std::size_t k) -> const auto& { return grains_.more(k); });
    return true;
  }

  bool next_grains(ArchiveMoment& moment) override
  {
    if (!dumps_.next()) return false;
    facts_.units = dumps_.units();
    const auto& header = dumps_.grains().header();
    moment.step = header.step;
    moment.time = header.time;
    moment.low = header.low;
    moment.high = header.high;
    moment.periodic = header.periodic;
    for (std::size_t axis = 0; axis < 3; ++axis)
      moment.cell[axis] = header.shrinks[axis] ? CellSource::grains : CellSource::archive;
    moment.questions.clear();
    moment.place = fmt::format("step {} ({}; {})", header.step, header.place,
                               dumps_.contacts().header().place);
    wall_columns_.look_up(header);
    facts_.walls = wall_columns_.walls();
    if (dumps_.walls()) facts_.walls = {"of the rows of --wall-contacts"};
    try {
      if (dumps_.grains_are_new())
        grains_.read(dumps_.grains(), moment.grains, wall_columns_.wanted());
    } catch (const TruncatedArchive&) {
      dumps_.keep_contacts();
      throw;
    }
    return true;
  }

 private:
  void read_walls(JoinedDumps& dump, ArchiveMoment& moment)
  {
    if (moment.grains.size() == 0) return;
    const auto& header = dump.header();
    if (!wall_rows_) wall_rows_.emplace(dialect_.wall_mapping(wall_text_, header));
    wall_rows_->read(dump, moment);
  }

  void read_contacts(ArchiveMoment& moment)
  {
    const auto header = dumps_.contacts().header();
    if (!columns_ && moment.grains.size() == 0) {
      moment.contacts = {};
      return;
    }
    if (header.label == "ATOMS" && header.find("id"))
      throw FormatError(fmt::format(
          "{}: these are grains (ITEM: ATOMS), and not contacts; name them with --grains, and the dump "
          "local with --contacts",
          header.place));
    if (!columns_ || header.columns != header_.columns) {
      grains_have_forces_ = !moment.grains.force.empty();
      if (columns_text_.empty()) find_columns(header, moment);
      if (columns_text_.empty()) {
        dumps_.contacts().read_rows({}, values_);  // a header that does not fit its rows is damaged
        moment.contacts = {};
        return;
      }
      columns_.emplace(dialect_.mapping(columns_text_, header));
      columns_->look_up(header.columns, header.place);
      header_ = header;
    }
    dumps_.contacts().read_rows(columns_->wanted(), values_);
    columns_->fill(values_, header.place, moment.contacts);
  }

  /// Those that forces show where names and their number do not, or where these are wrong. What is not
  /// sure becomes a question.
  void find_columns(const DumpHeader& header, ArchiveMoment& moment)
  {
    columns_text_ = dialect_.assumed(header, moment.grains);
    const auto fit = fit_of_columns(columns_text_, std::nullopt);
    if (!fit && !columns_text_.empty()) return;
    columns_text_ = fit ? fit->columns : proposed_columns(header);
    const auto why =
        fit ? fmt::format(
                  "with these the forces on grains add up but for {:.2g} of a contact force",
                  fit->residual)
            : fmt::format("as in {}", dialect_.example);
    moment.questions.push_back(
        {fmt::format("what the {} columns of {} mean", header.columns.size(), header.place),
         "--columns " + (columns_text_.empty() ? "MAP" : columns_text_),
         fmt::format("they are {}; {}", fmt::join(header.columns, " "), why)});
  }

  std::optional<ColumnFit> fit_of_columns(const std::string& in_use,
                                          const std::optional<Vec3>& gravity) const
  {
    if (!grains_have_forces_) return std::nullopt;
    try {
      return grseg::fitting_columns(grain_files_, contact_files_, dialect_, in_use, gravity);
    } catch (const FormatError&) {  // a column of words, or damage
      return std::nullopt;
    }
  }

  /// The only list of keywords that has as many columns; "" where there is none.
  std::string proposed_columns(const DumpHeader& header) const
  {
    const auto others = dialect_.others(header);
    const bool lists = others.size() == 1 && others.front().find('=') == std::string::npos;
    return lists ? others.front() : "";
  }

  const DumpDialect& dialect_;
  DumpPair dumps_;
  std::vector<std::string> grain_files_, contact_files_;
  bool grains_have_forces_ = false;
  DumpGrains grains_;
  std::string columns_text_;  // as --columns gives it
  std::optional<ContactColumns> columns_;
  std::string wall_text_;  // as --wall-columns gives it
  WallColumns wall_columns_;
  std::optional<WallRows> wall_rows_;
  DumpHeader header_;  // of the contacts, whose columns were looked up
  std::vector<std::vector<double>> values_;
  ArchiveFacts facts_;
};

/// Of the first block: "ATOMS" and its columns; none where the file is no dump.
std::pair<std::string, std::vector<std::string>> label_and_columns(const FileStart& start)
{
  std::pair<std::string, std::vector<std::string>> found{"ENTRIES", {}};
  if (start.lines.empty() || !start.lines.front().starts_with("ITEM:")) return found;
  for (const auto& line : start.lines) {
    const auto words = words_of(line);
    if (words.size() == 4 && line.starts_with("ITEM: NUMBER OF ")) found.first = words[3];
    if (words.size() < 3 || words[0] != "ITEM:" || words[1] != found.first) continue;
    found.second.assign(words.begin() + 2, words.end());
    break;
  }
  return found;
}

}  // namespace

ArchiveFacts facts_of_late_forces(const std::string& program)
{
  ArchiveFacts facts;
  facts.forces_are_late = true;
  facts.tolerance = 5e-2;
  facts.tolerance_reason = program +
                           " evaluates contact forces anew at output, with the velocities of the "
                           "end of the step";
  return facts;
}

FileRole role_of_dump(const FileStart& start)
{
  const auto [label, columns] = label_and_columns(start);
  if (columns.empty()) return FileRole::none;
  return label == "ATOMS" ? FileRole::grains : FileRole::contacts;
}

std::vector<std::string> columns_of_dump(const FileStart& start)
{
  return label_and_columns(start).second;
}

std::unique_ptr<Archive> open_dumps(const ArchiveFiles& files, const DumpDialect& dialect)
{
  const auto grains = archive_files(files.grains, "--grains");
  const auto contacts = archive_files(files.contacts, "--contacts");
  std::vector<std::string> walls;
  if (!files.wall_contacts.empty()) walls = archive_files(files.wall_contacts, "--wall-contacts");
  return std::make_unique<DumpArchive>(grains, contacts, walls, files, dialect);
}

}  // namespace grseg
