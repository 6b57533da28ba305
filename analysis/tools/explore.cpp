// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/explore/command.hpp"

int main(int argc, char** argv)
{
  constexpr grseg::ToolInfo info{
      "grseg-explore",
      "writes a page to look at runs in a browser: flow, force chains, and B under any rule.",
      "grseg-explore run.h5 ... [sums.tsv ...] [options] -o explore.html",
      "  grseg-explore run.h5 -o explore.html                  open the file with a browser\n"
      "  grseg-explore run.h5 sums.tsv -o explore.html         with sums from grseg-stress\n"
      "  grseg-explore a.h5 b.h5 --heights 4dS: -o both.html   runs side by side, and together\n"
      "  grseg-explore run.h5 --begin 10 --frames 50 --partition half -o page.html\n"};
  return grseg::write_explore_page(argc, argv, info, grseg::PageTab::explore);
}
