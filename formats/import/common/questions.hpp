// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/errors.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace grseg {

/// Something that an import needs and neither the archive nor the command line says.
struct Question {
  std::string what;    // "the length of a time step"
  std::string option;  // "--boundary 3" where the files suggest a value, "--step DT" where they do
                       // not: what is in capitals is for the user to fill in
  std::string reason;  // for the value, or what may be given: "all 35 grains of type 3 are at rest"
};

/// The import cannot go on without answers to these questions. The sentence asks them all.
struct OpenQuestions : UsageError {
  explicit OpenQuestions(std::vector<Question> open);
  explicit OpenQuestions(const Question& open) : OpenQuestions(std::vector<Question>{open}) {}

  /// The options that answer them, in the order of the questions.
  std::string options() const;

  std::vector<Question> questions;
};

/// Collects questions, so that all are asked in one answer.
class Questions {
 public:
  void ask(Question question) { open_.push_back(std::move(question)); }
  /// Runs `answer` and keeps the questions that it throws, each once.
  template <class Function>
  void collect(Function&& answer)
  {
    try {
      answer();
    } catch (const OpenQuestions& open) {
      for (const auto& question : open.questions) {
        const auto is_same = [&](const Question& asked) { return asked.what == question.what; };
        if (std::none_of(open_.begin(), open_.end(), is_same)) ask(question);
      }
    }
  }
  bool any() const { return !open_.empty(); }
  void report() const
  {
    if (any()) throw OpenQuestions(open_);
  }

 private:
  std::vector<Question> open_;
};

}  // namespace grseg
