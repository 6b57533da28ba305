// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/errors.hpp"

#include <boost/program_options.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace grseg {

/// A word that a user may type, and the value that it means. The words of one option form an array;
/// the functions below search and list such arrays.
template <class Value>
struct Choice {
  const char* word;
  Value value;
  const char* meaning = "";  // explanation in --help; "" if the word explains itself
};

template <class Value, std::size_t N>
std::vector<std::string> words_of(const Choice<Value> (&choices)[N])
{
  std::vector<std::string> words;
  words.reserve(N);
  for (const auto& choice : choices) words.emplace_back(choice.word);
  return words;
}

/// Number and noun: "1 table", "2 tables".
std::string counted(std::size_t number, const char* thing);

/// Words joined by commas and "or": "size, half or drop".
std::string list_of_words(const std::vector<std::string>& words);

/// Message "unknown --rule 'hal'; choose size, half or drop". `what` names the option or
/// key. If there are five or more known words, the message suggests the nearest one first.
std::string unknown_word(const std::string& what, const std::string& word,
                         const std::vector<std::string>& known);

/// The word that means `value`; "" if there is none.
template <class Value, std::size_t N>
const char* word_of(Value value, const Choice<Value> (&choices)[N])
{
  for (const auto& choice : choices)
    if (choice.value == value) return choice.word;
  return "";
}

/// List of words with their meanings for --help: "profile (over the window), layer or instant".
template <class Value, std::size_t N>
std::string list_of(const Choice<Value> (&choices)[N])
{
  std::vector<std::string> words;
  for (const auto& choice : choices) {
    words.emplace_back(choice.word);
    if (*choice.meaning != '\0') words.back() += std::string(" (") + choice.meaning + ")";
  }
  return list_of_words(words);
}

/// Value of `word`; empty if the word is not among the choices.
template <class Value, std::size_t N>
std::optional<Value> find_choice(const std::string& word, const Choice<Value> (&choices)[N])
{
  for (const auto& choice : choices)
    if (word == choice.word) return choice.value;
  return std::nullopt;
}

/// Value of `word`. Throws UsageError (unknown_word()) if the word is not among the choices.
template <class Value, std::size_t N>
Value choose(const std::string& word, const char* what, const Choice<Value> (&choices)[N])
{
  if (const auto found = find_choice(word, choices)) return *found;
  throw UsageError(unknown_word(what, word, words_of(choices)));
}

/// "%value%" or another placeholder of Boost.ProgramOptions that `text` contains, else "". Boost
/// replaces placeholders in its messages by the typed text, and loops for ever if the typed text is
/// itself a placeholder.
std::string placeholder_in(std::string_view text);

/// The known word nearest to `word`; "" if all differ in more than one letter of three. Dashes
/// before a word do not count as letters.
std::string nearest(const std::string& word, const std::vector<std::string>& known);

/// `word` quoted for a shell command line, in printable characters: unquoted if no character is
/// special, else in single quotes, or as $'...' (bash, zsh, ksh, POSIX 2024) if it contains control
/// characters or invalid UTF-8.
std::string shell_word(std::string_view word);

/// Words that an option accepts, for --completion. They are written as messages list them: letters
/// after a colon are placeholders, such as P in "uniform:P".
struct OptionWords {
  std::vector<std::string> words;

  virtual ~OptionWords() = default;
};

template <class T>
struct WordOption : boost::program_options::typed_value<T>, OptionWords {
  WordOption(T* place, const std::vector<std::string>& all)
      : boost::program_options::typed_value<T>(place)
  {
    words = all;
    this->value_name("WORD");
  }
};

/// An option whose value is one of `words`. Its default is the text at `place`, unless it is empty.
inline auto* word_option(std::string* place, const std::vector<std::string>& words)
{
  auto* option = new WordOption<std::string>(place, words);  // owned by the options_description
  if (place != nullptr && !place->empty()) option->default_value(*place);
  return option;
}

/// An option whose value is a comma-separated list of `words`; it may be given more than once.
inline auto* words_option(std::vector<std::string>& place, const std::vector<std::string>& words)
{
  auto* option = new WordOption<std::vector<std::string>>(&place, words);
  option->composing()->value_name("WORD,...");
  return option;
}

}  // namespace grseg
