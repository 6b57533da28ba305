// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/words.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace grseg {

/// One value of an option that has a few, and the word that stands for it on the command line. An
/// enum has one list of them, from which parsing and --help follow:
///
///   inline constexpr Choice<Pool> pools[] = {{"none", Pool::none}, {"windows", Pool::windows}};
///   const Pool pool = choose(options.pool, "--pool", pools);
template <class T>
struct Choice {
  const char* word;
  T value;
  const char* meaning = "";  // for --help, "" where the word says it all
};

/// What `word` stands for. UsageError, naming all words, where it is none of them.
template <class T, std::size_t size>
T choose(const std::string& word, const char* option, const Choice<T> (&choices)[size])
{
  std::vector<std::string> words;
  for (const auto& choice : choices) words.emplace_back(choice.word);
  return choices[choose(word, option, words)].value;
}

template <class T, std::size_t size>
const char* word_of(T value, const Choice<T> (&choices)[size])
{
  for (const auto& choice : choices)
    if (choice.value == value) return choice.word;
  return "";
}

/// "profile (over the window), layer or instant", for --help.
template <class T, std::size_t size>
std::string list_of(const Choice<T> (&choices)[size])
{
  std::string list;
  for (std::size_t k = 0; k < size; ++k) {
    if (k > 0) list += k + 1 == size ? " or " : ", ";
    list += choices[k].word;
    if (*choices[k].meaning != '\0') list += std::string(" (") + choices[k].meaning + ")";
  }
  return list;
}

}  // namespace grseg
