// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/output.hpp"

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

Output::Output(std::string path, bool overwrite, const std::vector<std::string>& inputs)
    : path_(std::move(path)), overwrite_(overwrite), temporary_(temporary_path(path_))
{
  check_output(path_, overwrite, inputs);
}

void write_whole(const OutputOptions& output, std::string_view text)
{
  const auto& path = output.path;
  if (output.is_standard_output()) {
    std::cout << text;
    return;
  }
  if (is_device(path)) return write_file(path, text, path);
  const RemoveAtEnd temporary(temporary_path(path));
  write_file(temporary.path(), text, path);
  publish_file(temporary.path(), path, output.overwrite);
}

}  // namespace grseg
