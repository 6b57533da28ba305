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

/// A word that a user may type and what it stands for. The words of one option stand in one array;
/// the functions below read and list them.
template <class Value>
struct Choice {
  const char* word;
  Value value;
  const char* meaning = "";  // for --help; "" where the word is enough
};

template <class Value, std::size_t N>
std::vector<std::string> words_of(const Choice<Value> (&choices)[N])
{
  std::vector<std::string> words;
  words.reserve(N);
  for (const auto& choice : choices) words.emplace_back(choice.word);
  return words;
}

/// "1 table", "2 tables".
std::string counted(std::size_t number, const char* thing);

/// "gauss, lucy or heaviside".
std::string list_of_words(const std::vector<std::string>& words);

/// "unknown --kernel 'gaus'; choose gauss, lucy or heaviside". `what` names the option or key. Of a
/// long list the nearest word is suggested first.
std::string unknown_word(const std::string& what, const std::string& word,
                         const std::vector<std::string>& known);

/// The word of `value`; "" where it has none.
template <class Value, std::size_t N>
const char* word_of(Value value, const Choice<Value> (&choices)[N])
{
  for (const auto& choice : choices)
    if (choice.value == value) return choice.word;
  return "";
}

/// "profile (over the window), layer or instant", for --help.
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

/// Value of `word`; none where it is not among the choices.
template <class Value, std::size_t N>
std::optional<Value> find_choice(const std::string& word, const Choice<Value> (&choices)[N])
{
  for (const auto& choice : choices)
    if (word == choice.word) return choice.value;
  return std::nullopt;
}

/// Value of `word`. UsageError (unknown_word) where it is not among the choices.
template <class Value, std::size_t N>
Value choose(const std::string& word, const char* what, const Choice<Value> (&choices)[N])
{
  if (const auto found = find_choice(word, choices)) return *found;
  throw UsageError(unknown_word(what, word, words_of(choices)));
}

/// "%value%" or another placeholder of Boost.ProgramOptions in `text`, else "". Boost puts the
/// typed text in the place of such words of its sentences, and never ends where that is again such
/// a word.
std::string placeholder_in(std::string_view text);

/// The known word nearest to `word`, or "" where all differ in more than one letter of three.
/// Dashes before a word do not count as letters.
std::string nearest(const std::string& word, const std::vector<std::string>& known);

/// `word` as a shell's command line writes it, in printable characters: bare where every character
/// is harmless, else in single quotes, and as $'...' (bash, zsh, ksh, POSIX 2024) where it holds a
/// control character or what is not UTF-8.
std::string shell_word(std::string_view word);

/// Values of an option, for --completion. Words are written as messages list them: letters after a
/// colon stand for something else, as in "uniform:P".
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

/// An option that takes one of `words`. Its default is the text at `place`, if there is any.
inline auto* word_option(std::string* place, const std::vector<std::string>& words)
{
  auto* option = new WordOption<std::string>(place, words);  // whoever takes it owns it
  if (place != nullptr && !place->empty()) option->default_value(*place);
  return option;
}

/// An option that takes several by comma, and may be given more than once.
inline auto* words_option(std::vector<std::string>& place, const std::vector<std::string>& words)
{
  auto* option = new WordOption<std::vector<std::string>>(&place, words);
  option->composing()->value_name("WORD,...");
  return option;
}

}  // namespace grseg
