// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/output.hpp"
#include "formats/cli/tool.hpp"
#include "sim/run/earlier_run.hpp"
#include "sim/run/expected_cost.hpp"
#include "sim/run/run.hpp"
#include "sim/run/run_files.hpp"
#include "sim/scene/keys/keys.hpp"
#include "sim/solver/sweep.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>

namespace grseg {
namespace {

/// Starts the program once more with glibc asked for large pages of memory, which cannot be done
/// later. Contacts read their grains at random places; with small pages a step takes 5 % longer for
/// discs and 8 % for spheres. Does nothing if the user has set tunables of glibc.
void ask_for_large_pages(char** argv)
{
  if (std::getenv("GLIBC_TUNABLES") != nullptr) return;
  setenv("GLIBC_TUNABLES", "glibc.malloc.hugetlb=1", 0);
  execv("/proc/self/exe", argv);  // returns only if it fails
}

void add_run_options(po::options_description& options, RunOptions& run)
{
  auto add = options.add_options();
  add("output,o", po::value(&run.output)->value_name("FILE"), "the trajectory to write");
  add_overwrite_to(options, run.overwrite);
  add("isa", po::value(&run.instruction_set)->value_name("NAME"),
      "vector instructions to use, such as avx2 (default: the best that the processor has; an "
      "unknown name lists all); results are bitwise identical");
  add("strict", po::bool_switch(&run.strict),
      "end with exit code 4 if a step missed the tolerance or an overlap exceeded 0.25 d_S");
  add("force", po::bool_switch(&run.force),
      "start even if the run is expected to need more memory or disk space than is free");
  add("estimate", po::bool_switch(&run.estimate),
      "print the expected numbers of grains, bytes and seconds of the run, and exit");
  add("quiet", po::bool_switch(&run.quiet), "print neither progress nor summary");
  add("checkpoint", po::value(&run.checkpoint)->value_name("FILE"),
      "write the state to this file regularly, at the end, and on a signal that ends the run: "
      "SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2, SIGXCPU");
  add("checkpoint-every",
      po::value(&run.checkpoint_every)->default_value(60)->value_name("SECONDS"),
      "wall-clock time between checkpoints, s");
  add("continue", po::bool_switch(&run.continues),
      "continue from the file of --checkpoint if it exists, otherwise start the run: the same "
      "command starts a run and continues it after an interruption. With a longer --duration it "
      "adds frames to a finished run");
  add("restart", po::value(&run.restart)->value_name("FILE"),
      "continue from this checkpoint, with the same bits as an uninterrupted run. SCENE.ini may be "
      "left out. A changed key starts a new trajectory; keys that describe the bed cannot change");
  add("perturb", po::value(&run.perturbation.size)->value_name("X"),
      "at a restart, displace every mobile grain at random by up to X d_S, for example 1e-6");
  add("seed-perturbation", po::value(&run.perturbation.seed)->value_name("N"),
      "seed of the displacements of --perturb (default: seed of the run)");
}

void check(const RunOptions& run, const po::variables_map& given)
{
  if (run.checkpoint_every < 0)
    throw UsageError("--checkpoint-every must be a time in seconds, 0 or more");
  if (run.estimate && (run.continues || !run.restart.empty()))
    throw UsageError("--estimate covers a whole run; leave out --restart and --continue");
  if (run.continues && (run.checkpoint.empty() || !run.restart.empty()))
    throw UsageError("--continue needs --checkpoint FILE, and cannot be combined with --restart");
  if (run.restart.empty() && (given.count("perturb") > 0 || given.count("seed-perturbation") > 0))
    throw UsageError("--perturb displaces the grains of a checkpoint; name one with --restart");
  if (!(run.perturbation.size >= 0 && run.perturbation.size <= largest_perturbation))
    throw UsageError(fmt::format("--perturb is {:g}: it must lie between 0 and {:g} d_S",
                                 run.perturbation.size, largest_perturbation));
}

/// True if `checkpoint`, of the scene `before`, was written after the last step of `scene`, which is
/// the same flow, and `output` is published.
bool is_finished(const AnyCheckpoint& checkpoint, const Scene& before, const Scene& scene,
                 const std::string& output)
{
  const auto steps_done = std::visit([](const auto& c) { return c.state.steps_done; }, checkpoint);
  return same_steps(before, scene) && steps_done >= scene.steps_in_all() &&
         holds_something(output) && !holds_something(part_of(output));
}

void begin(const Scene& scene, const RunOptions& run)
{
  if (run.estimate)
    fmt::print("{}", to_table(expected_cost(scene, 0, Measure::always)));
  else
    simulate(scene, run);
}

}  // namespace
}  // namespace grseg

int main(int argc, char** argv)
{
  using namespace grseg;
  ask_for_large_pages(argv);
  const ToolInfo info{
      "grseg-sim",
      "contact dynamics of small and large rigid discs or spheres: chute, drum, plane shear, column, hopper.",
      "grseg-sim SCENE.ini [--key value ...] -o run.h5\n"
      "       grseg-sim --restart run.chk [--key value ...] -o run.h5",
      "  grseg-sim sim/scenes/chute.ini -o run.h5            flow of Staron & Phillips (2015), 150 s\n"
      "  grseg-sim chute.ini --phi-large 0.45 --slope 21 --duration 60 -o slow.h5\n"
      "  grseg-sim chute.ini --accuracy draft --duration 20 -o quick.h5\n"
      "  grseg-sim chute.ini --slope 10 --slope-rate 2.5 --duration 8 -o steeper.h5\n"
      "  grseg-sim chute.ini --checkpoint run.chk --continue -o run.h5    start, or continue after an interruption\n"
      "  grseg-sim --restart run.chk --duration 300 -o more.h5\n"
      "  grseg-sim --restart run.chk --perturb 1e-6 --seed-perturbation 2 -o twin.h5\n",
      {},
      absent_effect};
  RunOptions run;
  po::options_description options("Options");
  add_run_options(options, run);
  options.add(scene_options());
  run.command_line = command_line(argc, argv);
  return run_tool(argc, argv, info, options, [&](const po::variables_map& given) {
    const auto inputs = given.count("input") > 0 ? given["input"].as<std::vector<std::string>>()
                                                 : std::vector<std::string>{};
    check(run, given);
    use_instruction_set(run.instruction_set);
    if (inputs.size() > 1 || (inputs.empty() && run.restart.empty()))
      throw UsageError("name one scene file, such as sim/scenes/chute.ini; --help shows examples");
    if (run.output.empty() && !run.estimate)
      throw UsageError("name the trajectory to write: -o run.h5");
    if (!inputs.empty()) run.scene_file = inputs[0];
    if (run.continues) run.restart = checkpoint_of_earlier_run(run);
    if (run.restart.empty()) return begin(resolve_scene(inputs[0], given), run);
    const auto checkpoint = read_checkpoint(run.restart);
    const auto& text = std::visit(
        [](const CheckpointHead& head) -> const auto& { return head.scene; }, checkpoint);
    const auto scene =
        inputs.empty() ? scene_of(text, run.restart, given) : resolve_scene(inputs[0], given);
    if (run.continues && is_finished(checkpoint, scene_of(text, run.restart), scene, run.output)) {
      if (!run.quiet) fmt::print(stderr, "grseg-sim: {} is finished\n", run.output);
      return;
    }
    if (given.count("seed-perturbation") == 0) run.perturbation.seed = scene.seed;
    resume(checkpoint, scene, run);
  });
}
