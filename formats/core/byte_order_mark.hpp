// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace grseg {

/// What some programs put before text in UTF-8.
inline constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

}  // namespace grseg
