// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/dump/dump_archive.hpp"

#include "formats/cli/interruption.hpp"
#include "formats/import/common/frame_tools.hpp"
#include "formats/import/common/unused_columns.hpp"
#include "formats/import/dump/contact_columns.hpp"
#include "formats/import/dump/dump_grains.hpp"
#include "formats/import/dump/dump_pair.hpp"
#include "formats/import/dump/wall_contacts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace grseg {
namespace {

// Number of grains that are unlikely to have the same acceleration by chance.
constexpr std::size_t enough_grains = 8;

/// Tests values of --columns on one frame, of which it stores all columns of the contacts.
class ColumnTrial {
 public:
  ColumnTrial(DumpPair& dumps, const DumpDialect& dialect, const std::optional<Vec3>& gravity)
      : dialect_(dialect), header_(dumps.contacts().header())
  {
    DumpGrains().read(dumps.grains(), grains_);
    if (!grains_.mass.empty()) gravity_ = gravity;
    row_of_ = rows_by_id(grains_);
    none_moves_ = std::all_of(grains_.velocity.begin(), grains_.velocity.end(),
                              [](const Vec3& velocity) { return velocity.isZero(0); });
    std::vector<std::size_t> all(header_.columns.size());
    std::iota(all.begin(), all.end(), 0);
    dumps.contacts().read_rows(all, rows_);
  }

  /// The residual of balance() with these columns; empty if a column cannot have its meaning.
  std::optional<double> residual(const std::string& columns)
  {
    return read(columns) ? balance() : std::nullopt;
  }
  /// True if with these columns each row names two grains of the frame that are near enough to touch.
  bool joins_neighbours(const std::string& columns, const ArchiveFrame& frame)
  {
    constexpr double near = 1.2;  // times the sum of the radii
    if (!read(columns) || grains_.radius.empty()) return false;
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      if (contacts_.at_wall(c)) continue;
      const auto i = row_of_.find(contacts_.i[c]), j = row_of_.find(contacts_.j[c]);
      if (i == row_of_.end() || j == row_of_.end()) return false;
      const Vec3 between = grains_.position[i->second] - grains_.position[j->second];
      if (frame.minimum_image(between).norm() >
          near * (grains_.radius[i->second] + grains_.radius[j->second]))
        return false;
    }
    return contacts_.size() > 0;
  }
  /// The columns with the smallest residual; empty if it exceeds the tolerance of the format.
  std::optional<ColumnFit> best()
  {
    constexpr double digits = 1e-6;  // smaller differences of residuals are round-off of the text
    std::optional<ColumnFit> fit;
    for (const auto& columns : dialect_.others(header_)) {
      const auto found = residual(columns);
      if (found && *found < (fit ? fit->residual - digits : dialect_.facts.tolerance))
        fit = ColumnFit{columns, *found};
    }
    return fit;
  }

 private:
  /// Reads the rows with these columns; false if a column cannot have its meaning.
  bool read(const std::string& columns)
  {
    try {
      ContactColumns map(dialect_.mapping(columns, header_));
      map.look_up(header_.columns, header_.place);
      std::vector<std::vector<double>> values;
      for (const auto column : map.wanted()) values.push_back(rows_[column]);
      map.fill(values, header_.place, contacts_);
    } catch (const Interruption&) {
      throw;
    } catch (const ToolError&) {
      return false;
    }
    return true;
  }

  /// Residual of Newton's law, | F - sum of contact forces - m g |, relative to the median of the
  /// grains' largest contact forces. It is the median over moving grains with contacts (over all
  /// grains if none moves), because some grains may touch walls. If g is itself a median, it makes
  /// the residual of half the grains vanish; then it is the third quartile. Empty without forces on
  /// grains or contact forces, if a row names an unknown grain, or with too few grains.
  std::optional<double> balance() const
  {
    if (grains_.force.empty()) return std::nullopt;
    auto left_over = grains_.force;
    std::vector<double> largest(grains_.size(), 0), scale, missing;
    const auto take_off = [&](std::int64_t id, const Vec3& force) {
      const auto row = row_of_.find(id);
      if (row == row_of_.end()) return false;
      left_over[row->second] -= force;
      largest[row->second] = std::max(largest[row->second], force.norm());
      return true;
    };
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      if (!take_off(contacts_.i[c], contacts_.force[c])) return std::nullopt;
      if (!contacts_.at_wall(c) && !take_off(contacts_.j[c], -contacts_.force[c]))
        return std::nullopt;
    }
    std::vector<std::size_t> touched;
    for (std::size_t g = 0; g < grains_.size(); ++g)
      if (largest[g] > 0 && moves(g)) touched.push_back(g), scale.push_back(largest[g]);
    if (touched.size() < (gravity_ ? 1 : enough_grains)) return std::nullopt;
    const Vec3 g = gravity_ ? *gravity_ : shared_acceleration(touched, left_over);
    for (const auto grain : touched)
      missing.push_back((left_over[grain] - weight(grain) * g).norm());
    const double ratio = quantile(missing, gravity_ ? 0.5 : 0.75) / median(scale);
    return std::isfinite(ratio) ? std::optional(ratio) : std::nullopt;
  }

  /// Median, by component, of the accelerations by forces that contacts do not explain.
  Vec3 shared_acceleration(const std::vector<std::size_t>& touched,
                           const std::vector<Vec3>& left_over) const
  {
    Vec3 shared;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      std::vector<double> accelerations;
      accelerations.reserve(touched.size());
      for (const auto grain : touched)
        accelerations.push_back(left_over[grain][axis] / weight(grain));
      shared[axis] = median(accelerations);
    }
    return shared;
  }

  /// True for grains whose forces should balance: not for the immobile grains of a base.
  bool moves(std::size_t grain) const { return none_moves_ || !grains_.velocity[grain].isZero(0); }

  /// The mass of a grain, or a quantity proportional to it (radius cubed).
  double weight(std::size_t grain) const
  {
    if (!grains_.mass.empty()) return grains_.mass[grain];
    return grains_.radius.empty() ? 1 : std::pow(grains_.radius[grain], 3);
  }

  const DumpDialect& dialect_;
  DumpHeader header_;
  ArchiveGrains grains_;
  std::optional<Vec3> gravity_;
  std::unordered_map<std::int64_t, std::size_t> row_of_;
  bool none_moves_ = false;
  std::vector<std::vector<double>> rows_;
  ArchiveContacts contacts_;
};

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
        left_out_(left_out(files.map)),
        facts_(dialect.facts)
  {
    facts_.step = dumps_.step();
  }

  const ArchiveFacts& facts() const override { return facts_; }
  std::string columns() const override { return columns_text_; }
  std::vector<std::string> remarks() const override { return dumps_.remarks(); }
  /// Opens the files again and uses the first frame that decides. If gravity or masses are unknown,
  /// gravity is the median acceleration after subtraction of the contact forces.
  std::optional<ColumnFit> fitting_columns(const std::optional<Vec3>& gravity) const override
  try {
    constexpr std::size_t rows_at_most = 100'000;  // a second or two
    if (!grains_have_forces_) return std::nullopt;
    DumpPair dumps(grain_files_, contact_files_);
    for (std::size_t rows = 0; rows < rows_at_most && dumps.next();) {
      rows += dumps.contacts().header().rows;
      if (dumps.contacts().header().rows == 0) continue;
      ColumnTrial trial(dumps, dialect_, gravity);
      const bool fits =
          !columns_text_.empty() &&
          trial.residual(columns_text_).value_or(INFINITY) <= dialect_.facts.tolerance;
      auto best = fits ? std::nullopt : trial.best();
      if (fits || best) return best;
    }
    return std::nullopt;
  } catch (const FormatError&) {  // a column contains words, or the file is damaged
    return std::nullopt;
  }

  bool next(ArchiveFrame& frame) override
  {
    if (!next_grains(frame)) return false;
    try {
      read_contacts(frame);
    } catch (const TruncatedArchive&) {
      dumps_.keep_grains();
      throw;
    }
    if (dumps_.walls() && frame.grains.size() > 0) {
      auto& walls = *dumps_.walls();
      if (!wall_rows_) wall_rows_.emplace(dialect_.wall_mapping(wall_text_, walls.header()));
      wall_rows_->read(walls, frame);
    }
    wall_columns_.add_to(frame, grains_);
    return true;
  }

  bool next_grains(ArchiveFrame& frame) override
  {
    if (!dumps_.next()) return false;
    facts_.units = dumps_.units();
    const auto& header = dumps_.grains().header();
    frame.step = header.step;
    frame.time = header.time;
    frame.low = header.low;
    frame.high = header.high;
    frame.periodic = header.periodic;
    for (std::size_t axis = 0; axis < 3; ++axis)
      frame.cell[axis] = header.shrinks[axis] ? CellSource::grains : CellSource::archive;
    frame.questions.clear();
    frame.place = fmt::format("step {} ({}; {})", header.step, header.place,
                              dumps_.contacts().header().place);
    if (std::exchange(columns_of_grains_, header.columns) != header.columns)
      ask_for_columns(header, frame);
    wall_columns_.look_up(header);
    facts_.walls = wall_columns_.walls();
    if (dumps_.walls()) facts_.walls = {"of the rows of --wall-contacts"};
    try {
      if (dumps_.grains_are_new())
        grains_.read(dumps_.grains(), frame.grains, wall_columns_.wanted());
    } catch (const TruncatedArchive&) {
      dumps_.keep_contacts();
      throw;
    }
    return true;
  }

 private:
  void ask_for_columns(const DumpHeader& header, ArchiveFrame& frame) const
  {
    auto unknown = unknown_columns(header);
    std::erase_if(unknown, [&](const std::string& name) {
      return std::ranges::find(left_out_, name) != left_out_.end();
    });
    if (auto question = question_of_columns(unknown, header.place))
      frame.questions.push_back(std::move(*question));
  }

  void read_contacts(ArchiveFrame& frame)
  {
    const auto header = dumps_.contacts().header();
    if (!columns_ && frame.grains.size() == 0) {
      frame.contacts = {};
      return;
    }
    if (header.label == "ATOMS" && header.find("id"))
      throw FormatError(fmt::format(
          "{}: these are grains (ITEM: ATOMS), not contacts; name this file with --grains, and the "
          "dump local with --contacts",
          header.place));
    if (!columns_ || header.columns != header_.columns) {
      grains_have_forces_ = !frame.grains.force.empty();
      if (columns_text_.empty()) find_columns(header, frame);
      if (columns_text_.empty()) {
        dumps_.contacts().read_rows({}, values_);  // reports a header that does not match its rows
        frame.contacts = {};
        return;
      }
      columns_.emplace(dialect_.mapping(columns_text_, header));
      columns_->look_up(header.columns, header.place);
      header_ = header;
    }
    dumps_.contacts().read_rows(columns_->wanted(), values_);
    columns_->fill(values_, header.place, frame.contacts);
  }

  /// Finds the columns from the balance of forces if names and number of columns leave them open,
  /// or are contradicted by the balance. The result becomes a question for the user.
  void find_columns(const DumpHeader& header, ArchiveFrame& frame)
  {
    columns_text_ = dialect_.assumed(header, frame.grains);
    const auto fit = fitting_columns(std::nullopt);
    if (!fit && !columns_text_.empty()) return;
    const auto others = fit ? std::vector<std::string>() : columns_of_neighbours(header, frame);
    if (fit)
      columns_text_ = fit->columns;
    else if (others.size() == 1 && others[0].find('=') == std::string::npos)
      columns_text_ = others[0];
    const auto why =
        fit ? fmt::format(
                  "with these the forces on grains balance to within {:.2g} of a contact force",
                  fit->residual)
        : columns_text_.empty()
            ? fmt::format("as in {}", dialect_.example)
            : "alone of all known lists these have this number of columns and join grains that touch";
    frame.questions.push_back(
        {fmt::format("the meaning of the {} columns of {}", header.columns.size(), header.place),
         "--columns " + (columns_text_.empty() ? "MAP" : columns_text_),
         fmt::format("they are {}; {}", fmt::join(header.columns, " "), why)});
  }

  /// The values of --columns that fit the header and join grains that touch in the first frame
  /// with contacts.
  std::vector<std::string> columns_of_neighbours(const DumpHeader& header,
                                                 const ArchiveFrame& frame) const
  try {
    auto all = dialect_.others(header);
    DumpPair dumps(grain_files_, contact_files_);
    do {
      if (!dumps.next()) return {};
    } while (dumps.contacts().header().rows == 0);
    ColumnTrial trial(dumps, dialect_, std::nullopt);
    std::erase_if(all,
                  [&](const auto& columns) { return !trial.joins_neighbours(columns, frame); });
    return all;
  } catch (const FormatError&) {  // a column contains words, or the file is damaged
    return {};
  }

  const DumpDialect& dialect_;
  DumpPair dumps_;
  std::vector<std::string> grain_files_, contact_files_;
  bool grains_have_forces_ = false;
  DumpGrains grains_;
  std::string columns_text_;  // value of --columns, given or found
  std::optional<ContactColumns> columns_;
  std::string wall_text_;  // value of --wall-columns
  WallColumns wall_columns_;
  std::vector<std::string> left_out_;           // names of columns that --map leaves out
  std::vector<std::string> columns_of_grains_;  // of the last frame
  std::optional<WallRows> wall_rows_;
  DumpHeader header_;  // header of the contacts for which columns_ is valid
  std::vector<std::vector<double>> values_;
  ArchiveFacts facts_;
};

/// Label ("ATOMS") and columns of the first block; no columns if the file is no dump.
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
                           " evaluates contact forces again for output, with the velocities at the "
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
