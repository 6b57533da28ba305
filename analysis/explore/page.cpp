// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/explore/page.hpp"

#include "formats/core/text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <string_view>

namespace grseg {
namespace {

using Json = nlohmann::ordered_json;

std::string list_of(const Json& sentences)
{
  std::string items;
  for (const auto& sentence : sentences)
    items += fmt::format("<li>{}.</li>", xml_escaped(sentence.get<std::string>()));
  return items;
}

std::string three_decimals(const Json& value)
{
  const auto text = fmt::format("{:.3f}", value.get<double>());
  return text.starts_with('-') ? "\u2212" + text.substr(1) : text;
}

/// B by the rule with which the page opens, of the first run that has one.
void add_result(const Json& fit, const std::string& rule, std::map<std::string, std::string>& texts)
{
  texts["verdict"] = list_of(fit["verdict"]);
  auto doubts = fit["doubts"];
  for (const auto& own : fit["rules"]) {
    const auto& b = own["B"];
    if (own["name"] != rule || !std::isfinite(b[0].get<double>())) continue;
    texts["B"] = three_decimals(b[0]);
    if (const auto doubt = own["doubt"].get<std::string>(); !doubt.empty()) doubts.push_back(doubt);
    if (!std::isfinite(b[1].get<double>())) continue;
    texts["interval"] = fmt::format("[{}, {}] (95 %)", three_decimals(b[1]), three_decimals(b[2]));
    texts["over"] = xml_escaped(fmt::format("95 % over {}: {}.", fit["over"].get<std::string>(),
                                            fit["over_words"].get<std::string>()));
  }
  texts["doubts"] = list_of(doubts);
}

/// HTML for the marks {{name}} of the page, by name: what the page shows before its script has run.
std::map<std::string, std::string> first_texts(const Json& content)
{
  std::map<std::string, std::string> texts{{"B", "\u2013"},
                                           {"program", xml_escaped(content["program"])},
                                           {"rule", xml_escaped(content["start"])}};
  for (const auto& run : content["runs"])
    texts["names"] += (texts["names"].empty() ? "" : ", ") + xml_escaped(run["name"]);
  for (const auto& run : content["runs"])
    if (run.contains("fit")) {
      add_result(run["fit"], content["start"], texts);
      break;
    }
  return texts;
}

/// The page with a text in place of each mark {{name}}.
std::string filled(std::string_view page, const std::map<std::string, std::string>& texts)
{
  std::string whole;
  for (auto at = page.find("{{"); at != std::string_view::npos; at = page.find("{{")) {
    const auto end = page.find("}}", at);
    const auto text = texts.find(std::string(page.substr(at + 2, end - at - 2)));
    whole += page.substr(0, at);
    if (text != texts.end()) whole += text->second;
    page.remove_prefix(end + 2);
  }
  return whole += page;
}

}  // namespace

std::string json_for_page(const nlohmann::ordered_json& json)
{
  auto text = json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  for (auto at = text.find('<'); at != std::string::npos; at = text.find('<', at))
    text.replace(at, 1, "\\u003c");
  return text;
}

std::string page_of(const nlohmann::ordered_json& content, const std::vector<std::string>& arrays)
{
  auto page = filled(page_before_data, first_texts(content));
  page += fmt::format("<script type=\"application/json\" id=\"content\">{}</script>\n",
                      json_for_page(content));
  for (std::size_t k = 0; k < arrays.size(); ++k)
    page += fmt::format("<script type=\"text/plain\" id=\"arrays-{}\">{}</script>\n", k, arrays[k]);
  page += page_after_data;
  return page;
}

}  // namespace grseg
