// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/verification.hpp"

#include "formats/core/text.hpp"

#include <fmt/format.h>

#include <sstream>
#include <string>

namespace grseg {
namespace {

/// A header line for each line of a parameter.
void add_lines(Header& header, const char* key, const TrajectoryReader& run, const char* parameter)
{
  std::istringstream lines(run.parameters().text(parameter));
  for (std::string line; std::getline(lines, line);) header.emplace_back(key, printable(line));
}

}  // namespace

void TrustOption::add_to(po::options_description& options)
{
  options.add_options()("trust", po::bool_switch(&trust),
                        "do not compare what is read with its digests");
}

Header verification_lines(const TrajectoryReader& run)
{
  Header lines{{"verified", run.verified()}};
  if (!run.closed())
    lines.emplace_back(
        "incomplete",
        run.size() == 0
            ? std::string("the run had not ended, and had no frame")
            : fmt::format("the run had not ended; it had {} frames, the last at {:.9g} s",
                          run.size(), run.times().back()));
  add_lines(lines, "cell", run, "import_cell");
  add_lines(lines, "undecided", run, "import_undecided");
  add_lines(lines, "waived", run, "import_waived");
  return lines;
}

}  // namespace grseg
