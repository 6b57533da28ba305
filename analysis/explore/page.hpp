// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace grseg {

/// JSON as text inside a <script> element: < is escaped, so that no string can end the element. Bytes
/// that are not UTF-8 are replaced.
std::string json_for_page(const nlohmann::ordered_json& json);

/// The whole page: the program of analysis/explore/page, its content, and the arrays of each run
/// (BinaryArrays::base64).
std::string page_of(const nlohmann::ordered_json& content, const std::vector<std::string>& arrays);

/// The page before and after its data, made from analysis/explore/page by the build (page.cmake).
extern const std::string_view page_before_data, page_after_data;

}  // namespace grseg
