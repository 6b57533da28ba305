// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/interruption.hpp"
#include "formats/cli/progress.hpp"
#include "formats/cli/tool.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/errors.hpp"
#include "formats/import/common/guarded_reading.hpp"
#include "formats/import/convert/importer.hpp"
#include "formats/import/convert/scan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

using namespace grseg;

namespace {

/// Examples of all formats, followed by the notes of some formats.
std::string examples()
{
  std::string commands, notes;
  for (const auto* format : archive_formats()) {
    commands += format->examples;
    notes += format->notes;
  }
  return fmt::format("{}\n{}  All formats and their columns: docs/studies/archives.md\n", commands,
                     notes);
}

/// The command line as typed, but without files that were named without an option, followed by the
/// options that answer the open questions (they name these files again).
std::string proposed_command(int argc, char** argv, const ImportSettings& settings,
                             const OpenQuestions& open)
{
  std::vector<char*> kept;
  const auto& unnamed = settings.files.unnamed;
  for (int k = 0; k < argc; ++k)
    if (k == 0 || std::find(unnamed.begin(), unnamed.end(), argv[k]) == unnamed.end())
      kept.push_back(argv[k]);
  return command_line(static_cast<int>(kept.size()), kept.data()) + " " + open.options();
}

void check(const ImportSettings& settings)
{
  if (settings.storage.compression < 0 || settings.storage.compression > 9)
    throw UsageError("--compression is a deflate level from 0 (none) to 9");
  const Waivers waivers(settings.accept_residual);  // its constructor checks the option
}

}  // namespace

int main(int argc, char** argv)
{
  const auto all_examples = examples();
  const ToolInfo info{
      "grseg-import", "turns archived runs of other programs into trajectories and verifies them.",
      "grseg-import --format NAME --grains FILES --contacts FILES [options] -o run.h5",
      all_examples.c_str()};
  ImportSettings settings;
  const auto options = import_options(settings);
  return run_tool(argc, argv, info, options, [&](const po::variables_map& values) {
    if (values.count("input") > 0)
      settings.files.unnamed = values["input"].as<std::vector<std::string>>();
    check(settings);
    continue_in_child(info.name, settings.output);
    listen_to_signals();
    try {
      settings = with_known_files(settings);
      const auto report = import_archive(settings, command_line(argc, argv));
      if (!settings.quiet) fmt::print(stderr, "{}", to_text(report));
      say_next(fmt::format("grseg-stress {} -o stress.tsv", shell_word(settings.output)),
               settings.quiet);
    } catch (const OpenQuestions& open) {
      throw UsageError(
          fmt::format("{}\nCheck the proposed answers, and fill in the words in capitals:\n  {}",
                      open.what(), proposed_command(argc, argv, settings, open)));
    }
  });
}
