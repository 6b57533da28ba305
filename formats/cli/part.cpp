// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/part.hpp"

#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

namespace grseg {
namespace {

constexpr std::size_t most_parts = 9999;

OutputPart parse_part(const std::string& text)
{
  OutputPart part;
  char more = 0;
  if (text.find_first_not_of("0123456789/") != std::string::npos ||
      std::sscanf(text.c_str(), "%zu/%zu%c", &part.number, &part.count, &more) != 2 ||
      part.number < 1 || part.number > part.count || part.count > most_parts)
    throw UsageError(fmt::format(
        "--part '{}': write the number of the part and the number of parts, as in 3/16", text));
  return part;
}

}  // namespace

std::string OutputPart::text() const
{
  return fmt::format("{}/{}", number, count);
}

std::pair<std::size_t, std::size_t> OutputPart::range(std::size_t things) const
{
  return {things * (number - 1) / count, things * number / count};
}

std::string OutputPart::path(const std::string& output, const std::string& extension) const
{
  const auto name = std::filesystem::path(output).replace_extension().string();
  return fmt::format("{}.part-{:0{}}-of-{}{}", name, number, fmt::formatted_size("{}", count),
                     count, extension);
}

void PartOptions::add_to(po::options_description& options)
{
  options.add_options()(
      "part",
      po::value<std::string>()->value_name("K/N")->notifier(
          [this](const std::string& text) { part = parse_part(text); }),
      "make only part K of N of the output (with -o run.tsv: run.part-K-of-N.tsv), so that several "
      "processes can share the work");
  options.add_options()(
      "join", po::value<std::size_t>(&join)->value_name("N")->notifier([](std::size_t n) {
        if (n < 1 || n > most_parts)
          throw UsageError(fmt::format("--join {}: it must be 1 to {}", n, most_parts));
      }),
      "join the N parts of the output; all other options as for --part. The result has the same "
      "bytes as without parts");
}

void PartOptions::check(const std::string& output) const
{
  if (part && join > 0) throw UsageError("--part and --join cannot be combined; use one of them");
  if (part && (output.empty() || output == "-"))
    throw UsageError(fmt::format(
        "--part {} writes a file: name the whole output with -o, as in -o sums.tsv", part->text()));
  if (join > 0 && (output.empty() || output == "-"))
    throw UsageError("--join makes a file from its parts: name it with -o, as in -o sums.tsv");
}

}  // namespace grseg
