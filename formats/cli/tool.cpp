// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/tool.hpp"

#include "citation.hpp"
#include "formats/cli/columns.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/files.hpp"
#include "formats/core/text.hpp"
#include "formats/core/version.hpp"

#include <fmt/format.h>

#include <csignal>
#include <exception>
#include <filesystem>
#include <iostream>
#include <map>

namespace grseg {
namespace {

constexpr Choice<const char * PresetOption::*> preset_names[] = {
    {"paper", &PresetOption::paper}, {"rigorous", &PresetOption::rigorous}};

/// Adds the option values of the preset to `values`, as defaults, except for options that were
/// given explicitly.
void apply_preset(const ToolInfo& info, const po::options_description& options,
                  po::variables_map& values)
{
  std::vector<std::string> set, words;
  if (const auto name = preset_of(values); name != "none") {
    const auto value_of = choose(name, "preset", preset_names);
    for (const auto& row : info.presets) {
      const std::string value = row.*value_of;
      if (value.empty() || (values.contains(row.option) && !values[row.option].defaulted()))
        continue;
      set.emplace_back(row.option);
      words.push_back(fmt::format("--{}={}", row.option, value));
    }
  }
  po::store(po::command_line_parser(words).options(options).run(), values);
  po::notify(values);
  std::map<std::string, po::variable_value>& all = values;
  for (const auto& option : set) all[option] = po::variable_value(all[option].value(), true);
}

std::string help_of(const std::span<const PresetOption> presets)
{
  std::string text;
  for (const auto& [name, value, meaning] : preset_names) {
    text += fmt::format("{}:", name);
    for (const auto& row : presets)
      if (*(row.*value) != '\0') text += fmt::format(" --{} {}", row.option, row.*value);
    text += "; ";
  }
  return text + "options given explicitly take precedence";
}

po::variables_map parse(int argc, char** argv, const ToolInfo& info,
                        const po::options_description& options)
{
  namespace style = po::command_line_style;
  po::options_description all;
  all.add(options);
  all.add_options()("input", po::value<std::vector<std::string>>());
  po::positional_options_description positional;
  positional.add("input", -1);

  for (int k = 1; k < argc; ++k)
    if (const auto word = placeholder_in(argv[k]); !word.empty())
      throw UsageError(fmt::format("no argument may contain {}; --help lists all options", word));
  po::variables_map values;
  try {
    po::store(po::command_line_parser(argc, argv)
                  .options(all)
                  .positional(positional)
                  .style(style::unix_style & ~style::allow_guessing)
                  .run(),
              values);
    apply_preset(info, all, values);
  } catch (const po::unknown_option& unknown) {
    const auto& option = unknown.get_option_name();
    std::vector<std::string> names;
    for (const auto& known : options.options()) names.push_back("--" + known->long_name());
    const auto absent = info.absent != nullptr ? info.absent(option) : "";
    if (!absent.empty()) throw UsageError(fmt::format("unknown option {}: {}", option, absent));
    const auto suggestion = nearest(option, names);
    throw UsageError(
        fmt::format("unknown option {}{}; --help lists all", option,
                    suggestion.empty() ? "" : fmt::format(", did you mean {}?", suggestion)));
  } catch (const po::error& wrong) {
    throw UsageError(fmt::format("{}; --help lists all options", wrong.what()));
  }
  return values;
}

void print_help(const ToolInfo& info, const po::options_description& options)
{
  std::cout
      << fmt::format("{}: {}\n\nUsage: {}\n\nExamples:\n{}\n", info.name, info.summary, info.usage,
                     info.examples)
      << options
      << "\nExit codes: 0 done; 1 error while running; 2 wrong command line or missing input;\n"
         "3 wrong content of a file; 4 a check failed or a tolerance was missed;\n"
         "128 + N ended by signal N (130 Ctrl-C, 143 SIGTERM).\n";
}

/// Prints the message of an error. The message may quote a file or its name and is therefore made
/// printable, so that no file can send control characters to the terminal.
void print_error(const ToolInfo& info, const std::exception& error)
{
  std::cerr << info.name << ": " << printable_lines(error.what()) << '\n';
}

}  // namespace

int run_tool(int argc, char** argv, const ToolInfo& info, const po::options_description& options,
             const std::function<void(const po::variables_map&)>& body)
{
  // A write beyond a limit on file sizes then fails with a message instead of killing the program.
  std::signal(SIGXFSZ, SIG_IGN);
  po::options_description all = options;
  const auto presets = help_of(info.presets);
  if (!info.presets.empty())
    all.add_options()("preset", word_option(nullptr, words_of(preset_names)), presets.c_str());
  const auto columns = columns_text(info.name);
  if (!columns.empty())
    all.add_options()("columns",
                      "print the meaning of all columns of the tool's tables, or of those whose "
                      "names follow, and exit");
  all.add_options()("version", "print the version, and where to report faults, and exit");
  all.add_options()("cite", "print what to cite, as BibTeX, and exit");
  all.add_options()("completion", word_option(nullptr, shells()),
                    "print a script that lets bash or zsh complete this command, and exit");
  all.add_options()("help,h", "print this text and exit");
  try {
    const auto values = parse(argc, argv, info, all);
    if (values.count("help") > 0) {
      print_help(info, all);
    } else if (!columns.empty() && values.count("columns") > 0) {
      const auto named = values.contains("input") ? values["input"].as<std::vector<std::string>>()
                                                  : std::vector<std::string>{};
      std::cout << columns_text(info.name, named);
    } else if (values.count("cite") > 0) {
      std::cout << bibtex;
    } else if (values.count("completion") > 0) {
      std::cout << completion_script(values["completion"].as<std::string>(), info.name, all);
    } else if (values.count("version") > 0) {
      std::cout << info.name << ' ' << version_with_hash() << "\n\n" << how_to_report << '\n';
    } else {
      body(values);
    }
    std::cout.flush();
    if (!std::cout)
      throw RunError(fmt::format("cannot write to standard output: {}", reason(errno)));
    return exit_done;
  } catch (const ToolError& error) {
    print_error(info, error);
    return error.code();
  } catch (const std::bad_alloc&) {
    std::cerr << info.name << ": out of memory; use fewer frames or a smaller scene\n";
  } catch (const std::exception& error) {
    print_error(info, error);
  }
  return exit_trouble;
}

std::string preset_of(const po::variables_map& values)
{
  return values.contains("preset") ? values["preset"].as<std::string>() : "none";
}

std::string command_line(int argc, char** argv)
{
  std::string line = argc > 0 ? std::filesystem::path(argv[0]).filename().string() : "";
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    const auto name = word.substr(0, word.find('='));
    if (name == "--threads") {
      if (name == word) ++k;
      continue;
    }
    line += ' ' + shell_word(word);
  }
  return line;
}

std::string single_input(const po::variables_map& values, const char* remedy)
{
  if (values.count("input") == 0)
    throw UsageError("no run given; name a trajectory file, e.g. run.h5");
  const auto& inputs = values["input"].as<std::vector<std::string>>();
  if (inputs.size() != 1) throw UsageError(fmt::format("{} runs given; {}", inputs.size(), remedy));
  return inputs[0];
}

po::typed_value<double>* time_option(std::optional<double>& place)
{
  return po::value<double>()->value_name("s")->notifier([&place](double time) { place = time; });
}

}  // namespace grseg
