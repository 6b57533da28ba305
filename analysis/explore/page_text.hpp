// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace grseg {

/// The page without its data, made of analysis/explore/page when grseg is built (page.cmake).
extern const std::string_view page_before_data, page_after_data;

}  // namespace grseg
