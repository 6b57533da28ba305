// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <boost/program_options.hpp>

#include <string>
#include <vector>

namespace grseg {

/// What the value of an option may be, for --completion. Words are written as messages list them: what
/// follows a colon stands for something else, as in "uniform:P".
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

/// An option that takes one of `words`; by default what `place` holds, if there is a place and text.
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
