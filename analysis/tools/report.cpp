// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/explore/command.hpp"

int main(int argc, char** argv)
{
  constexpr grseg::ToolInfo info{
      "grseg-report",
      "writes a page for a paper: what was run, how accurately, with its checks, tables, digests.",
      "grseg-report run.h5 ... [sums.tsv ...] [options] -o report.html",
      "  grseg-report run.h5 -o report.html                   to read or print with a browser\n"
      "  grseg-report a.h5 b.h5 --heights 4dS:56dS -o report.html\n"
      "  grseg-report run.h5 --rules size,half,uniform:0.6 -o report.html\n"};
  return grseg::write_explore_page(argc, argv, info, grseg::PageTab::report);
}
