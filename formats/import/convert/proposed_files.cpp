// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/words.hpp"
#include "formats/import/common/archive_files.hpp"
#include "formats/import/common/text_source.hpp"
#include "formats/import/convert/scan.hpp"
#include "formats/trajectory/hdf5.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace grseg {
namespace {

/// Files that were named without an option, sorted by their content as one format reads it.
struct Roles {
  std::vector<std::string> grains, contacts, restart;
  bool any_grains = false;  // true: a file contains grains, also one that was named with an option
};

/// Sorts the files for one format; empty if the format does not recognise one of them.
std::optional<Roles> roles_for(const ArchiveFormat& format, const std::vector<std::string>& unnamed,
                               const std::vector<FileStart>& starts)
{
  Roles roles;
  for (std::size_t k = 0; k < starts.size(); ++k) {
    const auto role = format.role(starts[k]);
    if (role == FileRole::none) return std::nullopt;
    roles.any_grains = roles.any_grains || role == FileRole::grains;
    if (k >= unnamed.size()) continue;
    (role == FileRole::grains     ? roles.grains
     : role == FileRole::contacts ? roles.contacts
                                  : roles.restart)
        .push_back(unnamed[k]);
  }
  return roles;
}

/// A pattern that matches all names: atoms.*.dump for atoms.100.dump and atoms.200.dump.
std::string pattern_of(const std::vector<std::string>& names)
{
  const auto& first = names.front();
  std::size_t head = first.size(), tail = first.size();
  for (const auto& name : names) {
    const auto same = std::mismatch(first.begin(), first.end(), name.begin(), name.end()).first;
    head = std::min(head, static_cast<std::size_t>(same - first.begin()));
    const auto from_end =
        std::mismatch(first.rbegin(), first.rend(), name.rbegin(), name.rend()).first;
    tail = std::min(tail, static_cast<std::size_t>(from_end - first.rbegin()));
  }
  const auto is_digit = [&](std::size_t k) {
    return std::isdigit(static_cast<unsigned char>(first[k])) != 0;
  };
  while (head > 0 && is_digit(head - 1)) --head;
  while (tail > 0 && is_digit(first.size() - tail)) --tail;
  return first.substr(0, head) + "*" + first.substr(first.size() - tail);
}

/// Text for a command line: the names, or a pattern if there are four or more.
std::string listed(const std::vector<std::string>& names)
{
  constexpr std::size_t many = 4;
  if (names.size() >= many) return shell_word(pattern_of(names));
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : " ") + shell_word(name);
  return text;
}

/// Files that show the format: all files named without an option, then one file of each option.
std::vector<std::string> samples_of(const ArchiveFiles& files)
{
  std::vector<std::string> names = files.unnamed;
  for (const auto* list : {&files.grains, &files.contacts})
    if (!list->empty()) names.push_back(archive_files(*list, "--grains").front());
  if (!files.restart.empty()) names.push_back(archive_files({files.restart}, "--restart").front());
  return names;
}

/// Throws UsageError naming a file without an option that no format recognises.
[[noreturn]] void refuse_unknown(const std::string& named, const std::vector<std::string>& unnamed,
                                 const std::vector<FileStart>& starts)
{
  const auto formats = archive_formats();
  for (std::size_t k = 0; k < unnamed.size(); ++k) {
    const bool is_known = std::any_of(formats.begin(), formats.end(), [&](const auto* format) {
      return (named.empty() || named == format->name) && format->role(starts[k]) != FileRole::none;
    });
    if (is_known) continue;
    const auto& [name, lines, groups] = starts[k];
    const auto kind = kind_by_name(unnamed[k]);
    if (!kind.empty()) throw UsageError(fmt::format("{} {}", unnamed[k], kind));
    if (hdf5::is_hdf5(unnamed[k]))
      throw UsageError(fmt::format(
          "{} is an HDF5 file of unknown layout, with {} in its root: write its grains and "
          "contacts as tables (--format csv)",
          unnamed[k],
          groups.empty() ? "nothing" : in_quotes(fmt::format("{}", fmt::join(groups, ", ")))));
    const auto first = std::find_if(lines.begin(), lines.end(), [](const std::string& line) {
      return !words_of(line).empty();
    });
    throw UsageError(fmt::format(
        "{}: its content is not recognised{}{}; name it with --grains or --contacts{}; files of "
        "other programs must become tables first (--format csv)",
        unnamed[k], named.empty() ? "" : " as that of --format " + named,
        first == lines.end() ? "" : " by its first line, " + in_quotes(*first),
        named.empty() ? fmt::format(", and its --format ({})", fmt::join(names_of_formats(), ", "))
                      : ""));
  }
  throw UsageError(
      "the files are not of one program; name the program with "
      "--format, and the files with --grains and --contacts");
}

/// The first format that recognises all files, or null if none does. Only the format `named` is
/// tried unless it is "". Throws UsageError instead of null if files were named without an option.
const ArchiveFormat* recognize(const std::string& named, const ArchiveFiles& files, Roles& roles)
{
  std::vector<FileStart> starts;
  for (const auto& path : samples_of(files)) starts.push_back(read_start(path));
  if (starts.empty()) return nullptr;
  for (const auto* format : archive_formats()) {
    if (!named.empty() && named != format->name) continue;
    const bool may_be = !named.empty() || format->is_of_program == nullptr ||
                        std::all_of(starts.begin(), starts.end(), format->is_of_program);
    const auto found = may_be ? roles_for(*format, files.unnamed, starts) : std::nullopt;
    if (!found) continue;
    roles = *found;
    return format;
  }
  if (!files.unnamed.empty()) refuse_unknown(named, files.unnamed, starts);
  return nullptr;
}

bool needs_contacts(const ImportSettings& settings)
{
  return settings.format.empty() ||
         (format_of(settings.format).takes_contacts && settings.files.restart.empty());
}

bool names_all_files(const ImportSettings& settings)
{
  const auto& files = settings.files;
  return !settings.format.empty() && files.unnamed.empty() &&
         (!files.grains.empty() || !files.restart.empty()) &&
         (!files.contacts.empty() || !needs_contacts(settings));
}

/// Sets `place` to the files that were found, and adds a question for the user, unless `questions`
/// is null. Throws UsageError if files were already named with the option.
void take(std::vector<std::string>& place, const std::vector<std::string>& found,
          const Question& question, Questions* questions)
{
  if (found.empty()) return;
  if (!place.empty())
    throw UsageError(fmt::format("{} also belongs to {}: name it behind {}", found.front(),
                                 question.what, question.option));
  if (questions != nullptr)
    questions->ask({question.what, question.option + " " + listed(found), question.reason});
  place = found;
}

void take_all(const Roles& roles, const ArchiveFormat& format, ArchiveFiles& files,
              Questions* questions)
{
  take(files.grains, roles.grains, {"the files with the grains", "--grains", ""}, questions);
  if (format.takes_contacts && (roles.any_grains || roles.restart.empty()))
    take(files.contacts, roles.contacts, {"the files with the contacts", "--contacts", ""},
         questions);  // restart files without grain files contain the contacts
  std::vector<std::string> restart;
  if (files.restart.empty())
    take(restart, roles.restart, {"the restart file", "--restart", ""}, questions);
  if (!restart.empty()) files.restart = restart.size() == 1 ? restart.front() : pattern_of(restart);
  files.unnamed.clear();
}

/// Asks for the files that cannot be proposed. Throws the questions if a file is missing, because
/// nothing can be read without it.
void ask_for_the_rest(const ImportSettings& settings, Questions& questions)
{
  const auto& files = settings.files;
  if (files.grains.empty() && files.restart.empty())
    questions.ask({"the files with the grains", "--grains FILES", ""});
  if (files.contacts.empty() && needs_contacts(settings))
    questions.ask({"the files with the contacts", "--contacts FILES", ""});
  if (!names_all_files(settings)) questions.report();
}

}  // namespace

ImportSettings with_known_files(const ImportSettings& settings)
{
  if (settings.format.empty() || settings.files.unnamed.empty()) return settings;
  format_of(settings.format);
  auto known = settings;
  Roles roles;
  const auto* format = recognize(settings.format, settings.files, roles);
  take_all(roles, *format, known.files, nullptr);
  return known;
}

ImportSettings with_proposed_files(const ImportSettings& settings, Questions& questions)
{
  if (settings.output.empty()) questions.ask({"the trajectory to write", "-o run.h5", ""});
  if (!settings.format.empty()) format_of(settings.format);
  auto proposed = with_known_files(settings);
  if (names_all_files(proposed)) return proposed;

  Roles roles;
  const auto* format = recognize(proposed.format, proposed.files, roles);
  if (settings.format.empty())
    questions.ask({"the program that wrote it",
                   fmt::format("--format {}", format == nullptr ? "NAME" : format->name),
                   format == nullptr ? fmt::format("{}", fmt::join(names_of_formats(), ", "))
                                     : "by the content of its files"});
  if (format != nullptr) {
    proposed.format = format->name;
    take_all(roles, *format, proposed.files, &questions);
  }
  ask_for_the_rest(proposed, questions);
  return proposed;
}

}  // namespace grseg
