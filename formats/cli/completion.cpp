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

/// Name of the option's value as --help shows it, such as "FILE"; "arg" if the option names none.
std::string name_of_value(const po::option_description& option)
{
  const auto words = option.format_parameter();
  return words.substr(0, words.find(' '));
}

bool takes_file(const po::option_description& option)
{
  return name_of_value(option).starts_with("FILE");
}

/// Name of the shell function that completes `tool`: "_grseg_stress".
std::string function_of(const std::string& tool)
{
  auto name = "_" + tool;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

/// Long name of the option and its short name if there is one: "--output", "-o".
std::vector<std::string> names_of(const po::option_description& option)
{
  std::vector<std::string> names{"--" + option.long_name()};
  const auto first = option.canonical_display_name(po::command_line_style::allow_dash_for_short);
  if (first.size() == 2) names.push_back(first);
  return names;
}

/// Words that the option accepts, with "uniform:" for "uniform:P"; none if its value is not a word.
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

/// The first clause of an option's description.
std::string short_text(const std::string& description)
{
  const auto end = std::min(description.find_first_of(";(\n"), description.find(": "));
  const auto text = description.substr(0, end);
  return text.substr(0, text.find_last_not_of(' ') + 1);
}

/// Shell statement that sets `from` to the words that the option accepts; empty for an option whose
/// value is a file.
std::string source_of(const po::option_description& option)
{
  const auto words = words_for(option);
  if (words.empty()) return takes_file(option) ? "" : "return ";
  return fmt::format("from=({}) {}", fmt::join(words, " "),
                     takes_list(option) ? "before=${word%\"${word##*,}\"} " : "");
}

// The script uses only what bash and zsh have in common: arrays, [[ ]] and ${x%%y}. zsh can also
// load the script from its fpath (#compdef), lists descriptions, and inserts words itself.
constexpr const char* script = R"(#compdef {0}
# completion of {0} in bash and zsh, printed by {0} --completion {2}
{1}()
{{
  local word last before= from=() all=(
{3}  )
  if [[ -n $ZSH_VERSION ]]; then
    word=${{words[CURRENT]}} last=${{words[CURRENT-1]}}
  else
    word=${{COMP_WORDS[COMP_CWORD]}} last=${{COMP_WORDS[COMP_CWORD-1]}}
  fi
  case $last in
{4}    *) [[ $word != -* ]] || from=("${{all[@]}}") ;;
  esac
  if [[ -n $ZSH_VERSION ]]; then
    case ${{from[1]}} in
      '') _files ;;
      -*) _describe -o option all ;;
      *) compset -P '*,'; compadd -S '' -- ${{(M)from:#*:}}; compadd -- ${{from:#*:}} ;;
    esac
    return 0
  fi
  [[ ${{from[0]}} != -* ]] || from=("${{from[@]%%:*}}")
  case ${{#from[@]}} in
    0) mapfile -t COMPREPLY < <(compgen -f -- "$word"); compopt -o filenames ;;
    *) mapfile -t COMPREPLY < <(compgen -P "$before" -W "${{from[*]}}" -- "${{word#"$before"}}") ;;
  esac
  [[ ${{COMPREPLY[*]}} != *: ]] || compopt -o nospace
}}
if [[ -z $ZSH_VERSION ]]; then complete -F {1} {0}
elif [[ ${{funcstack[1]}} = _{0} ]]; then {1}
else compdef {1} {0}; fi
)";

}  // namespace

std::vector<std::string> shells()
{
  return {"bash", "zsh"};
}

std::string completion_script(const std::string& shell, const std::string& tool,
                              const po::options_description& options)
{
  const auto known = shells();
  if (std::find(known.begin(), known.end(), shell) == known.end())
    throw UsageError(unknown_word("--completion", shell, known));
  std::string all, cases;
  std::map<std::string, std::vector<std::string>> by_source;
  for (const auto& option : options.options())
    for (const auto& name : names_of(*option)) {
      all += fmt::format("    {}\n", shell_word(name + ':' + short_text(option->description())));
      if (takes_value(*option)) by_source[source_of(*option)].push_back(name);
    }
  for (const auto& [source, names] : by_source)
    cases += fmt::format("    {}) {};;\n", fmt::join(names, "|"), source);
  return fmt::format(script, tool, function_of(tool), shell, all, cases);
}

}  // namespace grseg
