// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a text file of an archive, plain or compressed: its lines, words and numbers.
#include "formats/core/text.hpp"

#include "formats/import/common/text_source.hpp"
#include "formats/import/common/text_values.hpp"
#include "tests/fuzz/fuzz.hpp"

#include <cmath>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  using namespace grseg;
  static fuzz::ScratchFile file("text");
  if (size == 0) return 0;
  file.write(fuzz::text_of(data + 1, size - 1));
  fuzz::try_to([&] {
    TextSource source({file.path(), file.path()});
    std::vector<double> numbers;
    while (source.next()) {
      fuzz::require(source.line().find('\n') == std::string_view::npos, "a line is one line");
      for (const auto& word : words_of(source.line()))
        fuzz::require(!word.empty(), "no word is empty");
      for (const unsigned char c : printable(source.line()))
        fuzz::require(c >= ' ' && c != 127, "printable text holds no control character");
      fuzz::try_to([&] { read_numbers(source, numbers, " ,;\t"[data[0] % 4]); });
    }
  });
  return 0;
}
