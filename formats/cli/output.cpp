// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/output.hpp"

#include "formats/cli/readable_table.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <xxhash.h>

#include <iostream>
#include <utility>

namespace grseg {
void add_overwrite_to(po::options_description& options, bool& overwrite)
{
  options.add_options()("overwrite", po::bool_switch(&overwrite),
                        "replace an output that already exists; an input is never replaced");
}

void OutputOptions::add_to(po::options_description& options, const char* help)
{
  options.add_options()("output,o", po::value(&path)->value_name("FILE"), help);
  add_overwrite_to(options, overwrite);
}

void OutputOptions::check(const po::variables_map& values) const
{
  if (is_standard_output() || is_device(path)) return;
  const bool none = values.count("input") == 0;
  auto inputs = none ? std::vector<std::string>{} : values["input"].as<std::vector<std::string>>();
  std::erase(inputs, "-");
  check_output(path, overwrite, inputs);
}

void TableOptions::add_to(po::options_description& options)
{
  options.add_options()("short", po::bool_switch(&short_form),
                        "print a short, readable table, as on a terminal; with -o FILE also write "
                        "the whole table");
  options.add_options()("digits", po::value(&digits)->value_name("N"),
                        "significant digits of numbers (default: 17 in the whole table, fewer in "
                        "the short one)");
  OutputOptions::add_to(options,
                        "write the whole table to FILE; -: to standard output, also on a terminal");
}

void TableOptions::check(const po::variables_map& values) const
{
  constexpr int most = 17;  // significant digits of a double
  if (values.contains("digits") && (digits < 1 || digits > most))
    throw UsageError(fmt::format("--digits {}: it must be 1 to {}", digits, most));
  const bool json = values.contains("json") && values["json"].as<bool>();
  if (json && (short_form || digits > 0))
    throw UsageError(
        fmt::format("--{} and --json exclude each other", short_form ? "short" : "digits"));
  OutputOptions::check(values);
}

bool TableOptions::prints_short() const
{
  return short_form || (path.empty() && isatty(STDOUT_FILENO) == 1);
}

namespace {

std::string checked(const std::string& path, bool overwrite, const std::vector<std::string>& inputs)
{
  check_output(path, overwrite, inputs);
  return behind_links(path);
}

}  // namespace

Output::Output(const std::string& path, bool overwrite, const std::vector<std::string>& inputs)
    : path_(checked(path, overwrite, inputs)),
      overwrite_(overwrite),
      temporary_(new_temporary(path_))
{
}

void write_whole(const OutputOptions& output, std::string_view text)
{
  if (output.is_standard_output()) {
    std::cout << text;
    return;
  }
  const auto path = behind_links(output.path);
  if (is_device(path)) return write_file(path, text, path);
  const RemoveAtEnd temporary(temporary_path(path));
  write_file(temporary.path(), text, path);
  publish_file(temporary.path(), path, output.overwrite);
}

void write_table(const TableOptions& output, const std::string& text, const std::string& short_text)
{
  constexpr int few = 4;
  const bool brief = output.prints_short() && !text.starts_with('{');
  if (!brief || !output.path.empty())
    write_whole(output, output.digits > 0 ? rounded_table(text, output.digits) : text);
  if (brief)
    std::cout << (short_text.empty() ? readable_table(text, output.digits > 0 ? output.digits : few)
                                     : short_text);
}

struct GrowingTable::Digest {
  XXH3_state_t* state = XXH3_createState();

  Digest() { XXH3_64bits_reset(state); }
  ~Digest() { XXH3_freeState(state); }
  Digest(const Digest&) = delete;
  Digest& operator=(const Digest&) = delete;
};

GrowingTable::GrowingTable(OutputOptions output)
    : output_(std::move(output)), digest_(std::make_unique<Digest>())
{
  if (output_.is_standard_output()) return;
  output_.path = behind_links(output_.path);
  temporary_.emplace(new_temporary(output_.path));
}

GrowingTable::~GrowingTable() = default;

bool GrowingTable::is_large(const Table& table)
{
  constexpr std::size_t many_numbers = 1'000'000;  // about 20 MB of text
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
  if (temporary_) publish_file(temporary_->path(), output_.path, output_.overwrite);
}

void GrowingTable::write(const std::string& text)
{
  if (temporary_)
    append_to_file(temporary_->path(), text, output_.path);
  else
    std::cout << text;
}

}  // namespace grseg
