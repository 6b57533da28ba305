// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sim/scene/keys/keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/// Kinds of values of keys. `member` is a pointer to a member of Scene, or a function that returns
/// a reference to a part of a Scene.
namespace grseg::kinds {

double read_number(const std::string& key, const std::string& text);
long read_whole_number(const std::string& key, const std::string& text);
/// Length in m, not negative.
double read_length(const std::string& key, const std::string& text, const Scene& scene);

template <class Member>
KeyValue number(Member member, double low, double high, const char* placeholder = "X")
{
  KeyValue value;
  value.kind = "number";
  value.placeholder = placeholder;
  value.allowed = fmt::format("{:g} to {:g}", low, high);
  value.read = [=](const std::string& key, const std::string& text, Scene& scene) {
    const double given = read_number(key, text);
    require_within(given, key, low, high);
    std::invoke(member, scene) = given;
  };
  value.number = [=](const Scene& scene) { return std::invoke(member, scene); };
  value.text = [=](const Scene& scene) { return fmt::format("{}", std::invoke(member, scene)); };
  return value;
}

/// Length, stored in m. Bounds are written as in a scene file: "1e-9m", "4dL".
template <class Member>
KeyValue length(Member member, const char* low, const char* high)
{
  auto value = number(member, 0, 0, "LENGTH");
  value.kind = "length";
  value.allowed = fmt::format("{} to {}", low, high);
  value.read = [=](const std::string& key, const std::string& text, Scene& scene) {
    const double given = read_length(key, text, scene);
    require_within(given, key, read_length(key, low, scene), read_length(key, high, scene));
    std::invoke(member, scene) = given;
  };
  return value;
}

/// Whole number; its member of Scene may be a std::optional.
template <class Member>
KeyValue whole_number(Member member, long low, long high)
{
  using T = std::remove_cvref_t<std::invoke_result_t<Member, Scene&>>;
  KeyValue value;
  value.kind = "whole number";
  value.placeholder = "N";
  value.allowed = fmt::format("{} to {}", low, high);
  value.read = [=](const std::string& key, const std::string& text, Scene& scene) {
    const long given = read_whole_number(key, text);
    require_within(static_cast<double>(given), key, static_cast<double>(low),
                   static_cast<double>(high));
    std::invoke(member, scene) = static_cast<T>(given);
  };
  if constexpr (std::is_same_v<T, std::optional<long>>) {
    value.text = [=](const Scene& scene) {
      const auto& given = std::invoke(member, scene);
      return given ? fmt::format("{}", *given) : std::string();
    };
  } else {
    value.number = [=](const Scene& scene) {
      return static_cast<double>(std::invoke(member, scene));
    };
    value.text = [=](const Scene& scene) { return fmt::format("{}", std::invoke(member, scene)); };
  }
  return value;
}

/// Words that a user may choose from, with their values.
template <class T>
using Words = std::vector<std::pair<std::string, T>>;

/// Value that is one of `words`.
template <class Member, class T>
KeyValue choice(Member member, const Words<T>& words)
{
  KeyValue value;
  value.kind = "choice";
  for (const auto& [word, meaning] : words) value.words.push_back(word);
  const auto all = fmt::format("{}", fmt::join(value.words, ", "));
  value.allowed = all;
  value.read = [=](const std::string& key, const std::string& text, Scene& scene) {
    for (const auto& [word, meaning] : words)
      if (text == word) {
        std::invoke(member, scene) = meaning;
        return;
      }
    throw SceneError(key, fmt::format("unknown {} '{}'; choose one of {}", key, text, all));
  };
  value.text = [=](const Scene& scene) {
    for (const auto& [word, meaning] : words)
      if (std::invoke(member, scene) == meaning) return word;
    return std::string();
  };
  return value;
}

/// Switch whose value is the word on or off.
template <class Member>
KeyValue on_or_off(Member member)
{
  auto value = choice(member, Words<bool>{{"on", true}, {"off", false}});
  value.kind = "switch";
  value.allowed = "on or off";
  value.number = [=](const Scene& scene) { return std::invoke(member, scene) ? 1.0 : 0.0; };
  return value;
}

/// Switch whose option has no value on the command line and means on.
template <class Member>
KeyValue flag(Member member)
{
  auto value = on_or_off(member);
  value.is_flag = true;
  return value;
}

}  // namespace grseg::kinds
