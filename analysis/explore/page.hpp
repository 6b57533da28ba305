// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace grseg {

/// JSON text for a <script> element: < is escaped, so that no string can close the element. Bytes that
/// are not UTF-8 are replaced.
std::string json_for_page(const nlohmann::ordered_json& json);

/// HTML of the whole page: B, its verdict and doubts as text, the JavaScript of analysis/explore/page, `content`
/// as JSON, and the arrays of each run (BinaryArrays::base64).
std::string page_of(const nlohmann::ordered_json& content, const std::vector<std::string>& arrays);

/// HTML before and after the data, which the build makes from analysis/explore/page (page.cmake).
extern const std::string_view page_before_data, page_after_data;

}  // namespace grseg
