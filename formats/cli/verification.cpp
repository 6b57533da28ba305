// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/verification.hpp"

#include <fmt/format.h>

namespace grseg {

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
  return lines;
}

}  // namespace grseg
