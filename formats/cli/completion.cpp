// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/completion.hpp"

#include "formats/cli/shell_word.hpp"
#include "formats/cli/words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace grseg {
namespace {

namespace po = boost::program_options;

bool takes_value(const po::option_description& option)
{
  return option.semantic()->max_tokens() > 0;
}

/// The name of the value as --help shows it: "FILE", or "arg" where the option names none.
std::string name_of_value(const po::option_description& option)
{
  const auto words = option.format_parameter();
  return words.substr(0, words.find(' '));
}

bool takes_file(const po::option_description& option)
{
  return takes_value(option) && name_of_value(option) == "FILE";
}

/// "_grseg_stress", the name of the function.
std::string function_of(const std::string& tool)
{
  auto name = "_" + tool;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

/// "--output" and, where there is one, "-o".
std::vector<std::string> names_of(const po::option_description& option)
{
  std::vector<std::string> names{"--" + option.long_name()};
  const auto first = option.canonical_display_name(po::command_line_style::allow_dash_for_short);
  if (first.size() == 2) names.push_back(first);
  return names;
}

/// Words that end a case of bash: "    a|b) what ;;", nothing where there are none.
std::string bash_case(const std::vector<std::string>& words, const char* what)
{
  return words.empty() ? "" : fmt::format("    {}) {} return ;;\n", fmt::join(words, "|"), what);
}

std::string bash_script(const std::string& tool, const po::options_description& options)
{
  std::vector<std::string> all, before_file, before_other;
  for (const auto& option : options.options())
    for (const auto& name : names_of(*option)) {
      all.push_back(name);
      if (takes_value(*option)) (takes_file(*option) ? before_file : before_other).push_back(name);
    }
  return fmt::format(R"(# bash completion of {0}, printed by {0} --completion bash
{1}()
{{
  local word=${{COMP_WORDS[COMP_CWORD]}}
  COMPREPLY=()
  case ${{COMP_WORDS[COMP_CWORD - 1]}} in
{2}{3}  esac
  case $word in
    -*) mapfile -t COMPREPLY < <(compgen -W "{4}" -- "$word") ;;
    *) mapfile -t COMPREPLY < <(compgen -f -- "$word") ;;
  esac
}}
complete -o filenames -F {1} {0}
)",
                     tool, function_of(tool),
                     bash_case(before_file, "mapfile -t COMPREPLY < <(compgen -f -- \"$word\");"),
                     bash_case(before_other, ""), fmt::join(all, " "));
}

/// As it may stand between the colons and brackets of _arguments.
std::string without_meaning(const std::string& words)
{
  std::string text;
  for (const char c : words) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') text += '\\';
    text += c;
  }
  return text;
}

/// The first clause of a description.
std::string short_text(const std::string& description)
{
  auto end = std::min(description.find_first_of(";(\n"), description.find(": "));
  end = std::min(end, description.size());
  while (end > 0 && description[end - 1] == ' ') --end;
  return description.substr(0, end);
}

/// One line of _arguments: '(--output -o)'{--output=,-o+}'[text]:FILE:_files'.
std::string zsh_line(const po::option_description& option)
{
  const auto names = names_of(option);
  const bool value = takes_value(option);
  const auto action = value ? fmt::format(":{}:{}", without_meaning(name_of_value(option)),
                                          takes_file(option) ? "_files" : "")
                            : "";
  const auto text =
      fmt::format("[{}]{}", without_meaning(short_text(option.description())), action);
  const auto name = names[0] + (value ? "=" : "");
  if (names.size() == 1) return fmt::format("  {} \\\n", shell_word(name + text));
  return fmt::format("  {}{{{},{}{}}}{} \\\n",
                     shell_word(fmt::format("({})", fmt::join(names, " "))), name, names[1],
                     value ? "+" : "", shell_word(text));
}

std::string zsh_script(const std::string& tool, const po::options_description& options)
{
  std::string lines;
  for (const auto& option : options.options()) lines += zsh_line(*option);
  return fmt::format(
      "#compdef {0}\n# zsh completion of {0}, printed by {0} --completion zsh\n_arguments -S \\\n{1}  '*:input:_files'\n",
      tool, lines);
}

}  // namespace

std::string completion_script(const std::string& shell, const std::string& tool,
                              const po::options_description& options)
{
  if (shell == "bash") return bash_script(tool, options);
  if (shell == "zsh") return zsh_script(tool, options);
  throw UsageError(unknown_word("--completion", shell, {"bash", "zsh"}));
}

}  // namespace grseg
