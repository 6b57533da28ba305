// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/tool.hpp"
#include "sim/run.hpp"

int main(int argc, char** argv)
{
  using namespace grseg;
  const ToolInfo info{
      "grseg-sim", "contact dynamics of a two-dimensional chute of small and large rigid discs.",
      "grseg-sim SCENE.ini [--key value ...] -o run.h5",
      "  grseg-sim sim/scenes/chute.ini -o run.h5            the paper's flow, 150 s\n"
      "  grseg-sim chute.ini --phi-large 0.45 --slope 21 --duration 60 -o slow.h5\n"
      "  grseg-sim chute.ini --accuracy draft --duration 20 -o quick.h5\n"};
  RunOptions run;
  po::options_description options("Options");
  options.add_options()("output,o", po::value(&run.output)->value_name("FILE"),
                        "the trajectory to write")("overwrite", po::bool_switch(&run.overwrite),
                                                   "replace a trajectory that is there already")(
      "strict", po::bool_switch(&run.strict), "exit code 4 when a step missed the tolerance")(
      "quiet", po::bool_switch(&run.quiet), "no progress, no summary");
  options.add(scene_options());
  run.command_line = command_line(argc, argv);
  return run_tool(argc, argv, info, options, [&](const po::variables_map& given) {
    const auto inputs = given.count("input") > 0 ? given["input"].as<std::vector<std::string>>()
                                                 : std::vector<std::string>{};
    if (inputs.size() != 1)
      throw UsageError("name one scene file, such as sim/scenes/chute.ini; --help shows examples");
    if (run.output.empty()) throw UsageError("name the trajectory to write: -o run.h5");
    simulate(resolve_scene(inputs[0], given), run);
  });
}
