// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/tool.hpp"
#include "formats/cli/words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

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
  return name_of_value(option).starts_with("FILE");
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

/// The words that the value may be, "uniform:" for "uniform:P"; none where it is no word.
std::vector<std::string> words_for(const po::option_description& option)
{
  const auto* known = dynamic_cast<const OptionWords*>(option.semantic().get());
  auto words = known == nullptr ? std::vector<std::string>{} : known->words;
  for (auto& word : words) word.resize(std::min(word.find(':'), word.size() - 1) + 1);
  return words;
}

bool takes_list(const po::option_description& option)
{
  return name_of_value(option).ends_with(",...");
}

/// Where bash takes from what may follow the option.
std::string bash_source(const po::option_description& option)
{
  const auto words = words_for(option);
  if (words.empty()) return takes_file(option) ? "" : "return ";
  return fmt::format("from=(-W '{}') {}", fmt::join(words, " "),
                     takes_list(option) ? "before=${word%\"${word##*,}\"} " : "");
}

std::string bash_script(const std::string& tool, const po::options_description& options)
{
  std::vector<std::string> all;
  std::map<std::string, std::vector<std::string>> by_source;
  for (const auto& option : options.options())
    for (const auto& name : names_of(*option)) {
      all.push_back(name);
      if (takes_value(*option)) by_source[bash_source(*option)].push_back(name);
    }
  std::string cases;
  for (const auto& [source, names] : by_source)
    cases += fmt::format("    {}) {};;\n", fmt::join(names, "|"), source);
  return fmt::format(R"(# bash completion of {0}, printed by {0} --completion bash
{1}()
{{
  local word=${{COMP_WORDS[COMP_CWORD]}} from=(-f) before=
  COMPREPLY=()
  case ${{COMP_WORDS[COMP_CWORD - 1]}} in
{2}    *) [[ $word != -* ]] || from=(-W '{3}') ;;
  esac
  mapfile -t COMPREPLY < <(compgen -P "$before" "${{from[@]}}" -- "${{word#"$before"}}")
  case ${{from[0]}}${{COMPREPLY[*]}} in
    -f*) compopt -o filenames ;;
    *:) compopt -o nospace ;;
  esac
}}
complete -F {1} {0}
)",
                     tool, function_of(tool), cases, fmt::join(all, " "));
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

/// What zsh completes the value of an option with.
std::string zsh_action(const po::option_description& option)
{
  const auto words = words_for(option);
  if (words.empty()) return takes_file(option) ? "_files" : "";
  return without_meaning(fmt::format(
      fmt::runtime(takes_list(option) ? "_sequence compadd - {}" : "({})"), fmt::join(words, " ")));
}

/// One line of _arguments: '(--output -o)'{--output=,-o+}'[text]:FILE:_files'.
std::string zsh_line(const po::option_description& option)
{
  const auto names = names_of(option);
  const bool value = takes_value(option);
  const auto action =
      value ? fmt::format(":{}:{}", without_meaning(name_of_value(option)), zsh_action(option))
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

std::vector<std::string> shells()
{
  return {"bash", "zsh"};
}

std::string completion_script(const std::string& shell, const std::string& tool,
                              const po::options_description& options)
{
  if (shell == "bash") return bash_script(tool, options);
  if (shell == "zsh") return zsh_script(tool, options);
  throw UsageError(unknown_word("--completion", shell, shells()));
}

}  // namespace grseg
