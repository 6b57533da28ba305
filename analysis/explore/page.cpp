// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/explore/page.hpp"

#include <fmt/format.h>

#include <string_view>

namespace grseg {

std::string json_for_page(const nlohmann::ordered_json& json)
{
  auto text = json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  for (auto at = text.find('<'); at != std::string::npos; at = text.find('<', at))
    text.replace(at, 1, "\\u003c");
  return text;
}

std::string page_of(const nlohmann::ordered_json& content, const std::vector<std::string>& arrays)
{
  std::string page(page_before_data);
  page += fmt::format("<script type=\"application/json\" id=\"content\">{}</script>\n",
                      json_for_page(content));
  for (std::size_t k = 0; k < arrays.size(); ++k)
    page += fmt::format("<script type=\"text/plain\" id=\"arrays-{}\">{}</script>\n", k, arrays[k]);
  page += page_after_data;
  return page;
}

}  // namespace grseg
