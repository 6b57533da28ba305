// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace grseg {

/// JSON for the inside of a <script> element: as it is but for <, which no string may hold, so that
/// none can end the element. What is not UTF-8 is replaced.
std::string json_for_page(const nlohmann::ordered_json& json);

/// The whole page: the program of analysis/explore/page, what it shows, and for each run its arrays
/// (BinaryArrays::base64).
std::string page_of(const nlohmann::ordered_json& content, const std::vector<std::string>& arrays);

/// The page without its data, made of analysis/explore/page when grseg is built (page.cmake).
extern const std::string_view page_before_data, page_after_data;

}  // namespace grseg
