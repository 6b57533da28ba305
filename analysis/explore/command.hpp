// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/tool.hpp"

namespace grseg {

/// The tab at which the page opens.
enum class PageTab { explore, report };

/// Runs grseg-explore or grseg-report: both write the same page, which opens at tab `tab`. Returns the
/// exit code.
int write_explore_page(int argc, char** argv, const ToolInfo& info, PageTab tab);

}  // namespace grseg
