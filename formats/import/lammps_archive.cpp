// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/lammps_archive.hpp"

#include "formats/import/contact_columns.hpp"
#include "formats/import/dump_grains.hpp"
#include "formats/import/dump_pair.hpp"
#include "formats/import/file_list.hpp"

#include <fmt/format.h>

namespace grseg {
namespace {

constexpr const char* recipe = "i=2,j=3,dist=4,force=5,tangential=8";
constexpr std::size_t recipe_columns = 10;

/// What the header itself says, where its columns have been named by the words of --columns.
std::string columns_by_name(const DumpHeader& header)
{
  std::string text;
  for (const char* word :
       {"i", "j", "fx", "fy", "fz", "tx", "ty", "tz", "bx", "by", "bz", "dist", "overlap"})
    if (header.find(word)) text += fmt::format("{}{}={}", text.empty() ? "" : ",", word, word);
  return header.find("i") && header.find("j") && header.find("fx") ? text : "";
}

class LammpsArchive : public Archive {
 public:
  LammpsArchive(const std::vector<std::string>& grains, const std::vector<std::string>& contacts,
                const std::string& columns)
      : dumps_(grains, contacts)
  {
    if (!columns.empty()) columns_.emplace(columns);
    facts_.step = dumps_.step();
    facts_.forces_are_late = true;
    facts_.tolerance = 5e-2;
    facts_.tolerance_reason =
        "LAMMPS evaluates contact forces anew at output, with the velocities of the end of the "
        "step";
  }

  const ArchiveFacts& facts() const override { return facts_; }
  std::string columns() const override { return columns_ ? columns_->text() : ""; }
  std::vector<std::string> remarks() const override { return dumps_.remarks(); }

  bool next(ArchiveMoment& moment) override
  {
    if (!dumps_.next()) return false;
    facts_.units = dumps_.units();
    const auto& header = dumps_.grains().header();
    moment.step = header.step;
    moment.time = header.time;
    moment.low = header.low;
    moment.high = header.high;
    moment.periodic = header.periodic;
    moment.place = fmt::format("step {} ({}; {})", header.step, header.place,
                               dumps_.contacts().header().place);
    grains_.read(dumps_.grains(), moment.grains);
    read_contacts(moment);
    return true;
  }

  std::vector<std::string> other_columns() const override
  {
    std::vector<std::string> others;
    const auto last = names_.size();
    for (const std::size_t i : {2, 1})
      for (auto f = i + 2; f + 2 <= last; ++f) {
        const auto force = fmt::format("i={},j={},force={}", i, i + 1, f);
        others.push_back(force);
        for (auto t = i + 2; t + 2 <= last; ++t)
          if (t >= f + 3 || f >= t + 3) others.push_back(fmt::format("{},tangential={}", force, t));
      }
    return others;
  }

 private:
  void read_contacts(ArchiveMoment& moment)
  {
    const auto header = dumps_.contacts().header();
    if (header.columns != names_) {
      if (!columns_) columns_.emplace(assumed_columns(header, moment));
      columns_->look_up(header.columns, header.place);
      names_ = header.columns;
    }
    dumps_.contacts().read_rows(columns_->wanted(), values_);
    columns_->fill(values_, header.place, moment.contacts);
  }

  static std::string assumed_columns(const DumpHeader& header, const ArchiveMoment& moment)
  {
    if (auto named = columns_by_name(header); !named.empty()) return named;
    if (header.columns.size() >= recipe_columns && !moment.grains.force.empty()) return recipe;
    throw UsageError(
        fmt::format("{}: the names of the {} columns do not tell what they mean; say it with "
                    "--columns, as in {}",
                    header.place, header.columns.size(), recipe));
  }

  DumpPair dumps_;
  DumpGrains grains_;
  std::optional<ContactColumns> columns_;
  std::vector<std::string> names_;  // of the contacts' columns
  std::vector<std::vector<double>> values_;
  ArchiveFacts facts_;
};

}  // namespace

std::unique_ptr<Archive> open_lammps(const ArchiveFiles& files)
{
  const auto grains = archive_files(files.grains, "--grains");
  return std::make_unique<LammpsArchive>(grains, archive_files(files.contacts, "--contacts"),
                                         files.columns);
}

}  // namespace grseg
