// SPDX-License-Identifier: GPL-3.0-or-later
// Reads scene files.
#include "sim/scene/keys/keys.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace {

using namespace grseg;

Scene scene_of(const std::string& text)
{
  boost::program_options::variables_map values;
  read_scene_text(text, "scene.ini", {}, values);
  return resolve_scene(values);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  fuzz::try_to([&] {
    const auto text = to_text(scene_of(std::string(fuzz::text_of(data, size))));
    fuzz::require(to_text(scene_of(text)) == text, "a scene is read as it was written");
  });
  return 0;
}
