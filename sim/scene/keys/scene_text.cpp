// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/scene/keys/scene_text.hpp"

#include "formats/cli/provenance.hpp"
#include "sim/scene/geometry.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace grseg {

std::string to_text(const Scene& scene)
{
  std::string text;
  for (const auto& key : scene_keys()) {
    if (key.role == KeyRole::machine) continue;
    const auto value = key.value.text(scene);
    if (!value.empty()) text += fmt::format("{} = {}\n", key.name, value);
  }
  return text;
}

Parameters to_parameters(const Scene& scene)
{
  Parameters parameters;
  for (const auto& key : scene_keys()) {
    if (key.stored == InParameters::no) continue;
    std::string name = key.name;
    std::replace(name.begin(), name.end(), '-', '_');
    if (key.value.number)
      parameters.numbers[name] = {key.value.number(scene)};
    else
      parameters.texts[name] = key.value.text(scene);
  }
  const auto gravity = gravity_of(scene).start;
  parameters.numbers["gravity"] = {gravity.x(), gravity.y()};
  parameters.numbers["large_diameter"] = {scene.large_diameter};
  parameters.numbers["contact_margin"] = {law_parameters(scene).margin};
  parameters.texts["scene"] = to_text(scene);
  scene.geometry->describe(scene, parameters);
  return parameters;
}

Scene without_round_off(Scene now, const Scene& before)
{
  for (const auto& key : scene_keys()) {
    const auto text = key.value.text(before);
    if (key.value.text(now) != text && same_setting(key.value.text(now), text))
      key.value.read(key.name, key.with_unit(text), now);
  }
  return now;
}

std::string differing_key(const Scene& a, const Scene& b, KeyRole role)
{
  for (const auto& key : scene_keys())
    if (key.role == role && key.value.text(a) != key.value.text(b)) return key.name;
  return "";
}

}  // namespace grseg
