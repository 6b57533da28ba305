// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/growing_table.hpp"

#include <xxhash.h>

#include <iostream>

namespace grseg {

struct GrowingTable::Digest {
  XXH3_state_t* state = XXH3_createState();

  Digest() { XXH3_64bits_reset(state); }
  ~Digest() { XXH3_freeState(state); }
  Digest(const Digest&) = delete;
  Digest& operator=(const Digest&) = delete;
};

GrowingTable::GrowingTable(OutputOptions output)
    : output_(std::move(output)),
      temporary_(output_.is_standard_output() ? "" : temporary_path(output_.path)),
      digest_(std::make_unique<Digest>())
{
}

GrowingTable::~GrowingTable() = default;

bool GrowingTable::is_large(const Table& table)
{
  constexpr std::size_t many_numbers = 1'000'000;  // some 20 MB of text
  return table.rows.size() * table.columns.size() > many_numbers;
}

void GrowingTable::add(Table& table)
{
  auto text = has_begun() ? "" : table_head(table.header, table.columns);
  add_rows(text, table.rows);
  XXH3_64bits_update(digest_->state, text.data(), text.size());
  write(text);
  rows_ += table.rows.size();
  table.rows.clear();
}

void GrowingTable::finish(Table rest)
{
  add(rest);
  write(end_line(rows_, XXH3_64bits_digest(digest_->state)) + '\n');
  if (!output_.is_standard_output())
    publish_file(temporary_.path(), output_.path, output_.overwrite);
}

void GrowingTable::write(const std::string& text)
{
  if (output_.is_standard_output())
    std::cout << text;
  else
    append_to_file(temporary_.path(), text, output_.path);
}

}  // namespace grseg
