"""Faults in sim/ and the tests that may detect them: hard cases and unit tests, each a separate program."""
import concurrent.futures
import os

# Faults: (description, file, code in the file, code that replaces it).
FAULTS = [
    ("sign: the partner is pushed the same way", "sim/contact/contact_law-inl.hpp",
     "b.vy = b.vy - weight_b * p.py;", "b.vy = b.vy + weight_b * p.py;"),
    ("sign: the partner is pushed the same way outside sweeps", "sim/contact/bodies-inl.hpp",
     "add(hn::Xor(part, hn::Load(Row(), opposite_velocity + from)), from,", "add(part, from,"),
    ("sign: both grains are turned opposite ways", "sim/contact/contact_law-inl.hpp",
     "b.rim_speed = b.rim_speed - weight_b * p.spin;", "b.rim_speed = b.rim_speed + weight_b * p.spin;"),
    ("sign: both grains are turned the wrong way outside sweeps", "sim/contact/bodies-inl.hpp",
     "Bodies<D>{px, py, hn::Neg(spin), hn::Zero(d)}", "Bodies<D>{px, py, spin, hn::Zero(d)}"),
    ("clamp: contacts may pull", "sim/contact/contact_law-inl.hpp",
     "  return number<V>(0);\n}\n/// Tangential impulse",
     "  return number<V>(-1e300);\n}\n/// Tangential impulse"),
    ("clamp: friction is limited to one side only", "sim/contact/contact_law-inl.hpp",
     "return {minus(limit), limit};", "return {number<V>(-1e300), limit};"),
    ("clamp: friction is limited by the impulse of the sweep before", "sim/contact/contact_law-inl.hpp",
     "    const auto [least, most] = cone(c, friction);",
     "    auto before = c;\n    before.impulse_n = before_n;\n    const auto [least, most] = cone(before, friction);"),
    ("lever arm: radius instead of its part of the distance", "sim/contact/contact_law-inl.hpp",
     "p.spin = number<V>(disc_rim_factor) * kappa * tangential;",
     "p.spin = number<V>(disc_rim_factor) * tangential;"),
    ("lever arm: spins do not count in the sliding velocity", "sim/contact/contact_law-inl.hpp",
     "return sliding - c.kappa * (a.rim_speed + b.rim_speed);", "return sliding;"),
    ("effective mass: the tangent's is the normal's", "sim/contact/contact_law-inl.hpp",
     "return normal_mass / (number<V>(1) + number<V>(rim_factor) * (kappa * kappa));",
     "return normal_mass / (number<V>(1) + number<V>(0 * rim_factor) * (kappa * kappa));"),
    ("restitution: added on parting too", "sim/contact/contact_law-inl.hpp",
     "  V approach = fresh_approach(separation, load);", "  V approach = magnitude(separation);"),
    ("restitution: pairs that part do not come back", "sim/contact/contact_law-inl.hpp",
     "  V approach = fresh_approach(separation, load);",
     "  V approach = larger(fresh_approach(separation, load), zero);"),
    ("restitution: of the solver's errors of parting, too", "sim/contact/contact_law.hpp",
     "parting_error = 0.1;", "parting_error = 0;"),
    ("restitution: of the solver's errors, too", "sim/contact/contact_law.hpp",
     "solver_error = 0.01;", "solver_error = 0;"),
    ("restitution: its square", "sim/contact/contact_law-inl.hpp",
     "number<V>(restitution) * approach", "number<V>(restitution * restitution) * approach"),
    ("restitution: gravity of the step is in the approach", "sim/step/simulation.cpp",
     "  const bool renewed = find_contacts(spread, report);",
     "  accelerate(h * world_.gravity, state_, threads_);\n"
     "  const bool renewed = find_contacts(spread, report);\n"
     "  accelerate(-h * world_.gravity, state_, threads_);"),
    ("colours: a body's second contact gets the colour of its first", "sim/neighbours/pair_list.cpp",
     "    taken[b].among_grains |= bit(free);", "    taken[b].among_grains |= 0;"),
    ("warm start: lost", "sim/neighbours/detection.cpp",
     "    store(n, block.impulse_n);\n    store(t, block.impulse_t);",
     "    store(hn::Zero(d), block.impulse_n);\n    store(hn::Zero(d), block.impulse_t);"),
    ("warm start: impulses of contacts that have ended are kept", "sim/step/simulation.cpp",
     "    grseg::forget_impulses(pairs_.pairs(), contacts_, pairs_.memories(), threads_);", "    (void)0;"),
    ("warm start: guessed but not applied", "sim/solver/solver.cpp",
     "    apply_impulses(strips[s].blocks, motion.data(), task.effects);", "    (void)s;"),
    ("warm start: guessed but not applied, in single precision", "sim/solver/single_contacts.cpp",
     "    push<with>(c, a, b, push_of<with>(c.nx, c.ny, c.kappa, c.impulse_n, c.impulse_t));\n", ""),
    ("mid-point: contacts are looked for at the end of the step", "sim/step/simulation.cpp",
     "move_bodies(h / 2, world_.law.forecast * h,", "move_bodies(h, world_.law.forecast * h,"),
    ("gravity: boundary grains fall, too", "sim/step/free_flight.cpp",
     "      if (!(motion[b].inverse_mass > 0)) continue;\n", ""),
    ("stop: when the quadratic mean is small", "sim/solver/solver.cpp",
     "report.converged = report.residual <= task_.settings.tolerance;",
     "report.converged = report.residual_rms <= task_.settings.tolerance;"),
    ("stop: friction is not looked at", "sim/contact/contact_law-inl.hpp",
     "magnitude(change_t) * w_tt,\n          c.impulse_t * w_tt};", "w_tt - w_tt, w_tt - w_tt};"),
    ("period: pairs across it are shifted the wrong way", "sim/neighbours/detection.cpp",
     "  if constexpr (periodic) x = x + shift;\n  const auto normal",
     "  if constexpr (periodic) x = x - shift;\n  const auto normal"),
    ("detection: velocities of a pair are added", "sim/contact/bodies-inl.hpp",
     "hn::Xor(other, sign));", "other);"),
    ("effective mass: twice what it is", "sim/contact/contact_law-inl.hpp",
     "choose(used, one / choose(used, inverse_masses, one))",
     "choose(used, (one + one) / choose(used, inverse_masses, one))"),
    ("lever arm: the distance, not its part of the reach", "sim/neighbours/detection.cpp",
     "n.distance * (one / reach)", "n.distance"),
    ("list: renewed too late", "sim/step/simulation.cpp",
     "const bool renew = !pairs_.complete(ahead_);",
     "const bool renew = !pairs_.complete(ahead_) && (steps_done_ % 64 == 0 || pairs_.pairs().size() == 0);"),
    ("stop: round-off does not count", "sim/solver/solver.cpp",
     "report.converged = result.largest <= round_off_;", "report.converged = false;"),
    ("slope: gravity of the step's beginning, not of its middle", "sim/step/simulation.cpp",
     "gravity_.at(begin + h / 2)", "gravity_.at(begin)"),
    ("steps in parts: what grains will meet in the second half is not looked for",
     "sim/step/simulation.cpp",
     "std::max({sums.fastest_approach, unlisted, unlisted_ahead(spread)})",
     "std::max(sums.fastest_approach, unlisted)"),
    ("steps in parts: the list of the step that was too long stays", "sim/step/simulation.cpp",
     "  renew_pairs(0);    // at", "  // at"),
    ("steps in parts: unlisted grains do not count", "sim/step/simulation.cpp",
     "    unlisted = pairs_.fastest_unlisted(state_.motion);\n", ""),
    ("steps in parts: listed pairs that do not act yet may pass each other", "sim/step/simulation.cpp",
     "std::min(world_.skin, most_approach_) - world_.law.margin", "world_.skin - world_.law.margin"),
    ("steps in parts: centres that coincide do not count", "sim/step/simulation.cpp",
     "sums.coincident ? infinity : report.fastest_approach * world_.step",
     "report.fastest_approach * world_.step"),
    ("steps in parts: impulses keep their length", "sim/step/simulation.cpp",
     "memory.n *= factor;", "memory.n *= factor == 0 ? 0 : 1;"),
    ("steps in parts: no two velocities differ", "sim/step/free_flight.cpp",
     "return all.diagonal().norm();", "return 0 * all.diagonal().norm();"),
    ("slope: stands still after the tilt", "sim/step/simulation.cpp",
     "if (gravity_.turns()) world_.gravity", "if (false) world_.gravity"),
    ("moving boundaries: along the tangent instead of the chord", "sim/solver/boundary_body.hpp",
     "velocity += (std::sin(angle) * across - 2 * half * half * arm) / step;",
     "velocity += body.spin * across + 0 * half * arm;"),
    ("moving boundaries: their rims do not turn", "sim/step/free_flight.cpp",
     "time + world.step > 0 ? body.spin * world.grains.radius[row] : 0",
     "0 * body.spin"),
    ("moving boundaries: a free body feels no contact", "sim/solver/solved_apart.cpp",
     "impulse -= block->impulse_n[lane] * ny + block->impulse_t[lane] * nx;", "impulse -= 0 * ny;"),
    ("moving boundaries: a free body feels no load", "sim/step/free_flight.cpp",
     "duration * body.load / body.mass", "0 * duration * body.load / body.mass"),
    ("moving boundaries: a free body is solved once per sweep", "sim/solver/solved_apart.cpp",
     "constexpr int most_body_rounds = 40;", "constexpr int most_body_rounds = 1;"),
    ("wedges: locked grains rebound", "sim/solver/solved_apart.hpp",
     "block->rebound[lane] = std::min(block->rebound[lane], 0.0);", "(void)0;"),
    ("wedges: swept like others", "sim/solver/solved_apart.cpp",
     "constexpr int most_rounds = 40;", "constexpr int most_rounds = 0;"),
    ("stop: a few contacts may make the reference", "sim/solver/solver.cpp",
     "std::clamp(mean, task_.range.least, task_.range.most)", "std::max(mean, task_.range.least)"),
    ("impacts: guesses never catch up with loads that last", "sim/step/simulation.cpp",
     "{origin.entry(lane), most_growth_of_loads * before / block.impulse_n[lane]}",
     "{origin.entry(lane), before / block.impulse_n[lane]}"),
    ("effects: friction is never left out", "sim/step/simulation.cpp",
     "world.general || world.material.friction > 0,", "true,"),
    ("effects: restitution is never left out", "sim/step/simulation.cpp",
     "world.general || world.material.restitution > 0 || world.law.horizon > 0};", "true};"),
    ("effects: sweeps without friction see to it all the same", "sim/solver/sweep.cpp",
     "e.friction, e.rotation, e.restitution, measured", "true, e.rotation, e.restitution, measured"),
    ("sweeps: largest changes are never looked for", "sim/solver/solver.cpp",
     "sweep_strip(s, may_be_last ? Measured::all : Measured::squares)", "sweep_strip(s, Measured::squares)"),
    ("sweeps: those of the least sweeps over several strips are never looked for", "sim/solver/solver.cpp",
     "sweep_strip(s, round < last ? Measured::squares : Measured::all)",
     "sweep_strip(s, Measured::squares)"),
    ("wavefront: odd strips do not wait for even ones", "sim/solver/wavefront.cpp",
     "neighbours_have(even ? finished_ : worked_, strip, even ? round : round + 1)", "neighbours_have(finished_, strip, round)"),
    ("wavefront: a round begins before the neighbours are closed", "sim/solver/wavefront.cpp",
     "strip, even ? round : round + 1)", "strip, even ? 0 : round + 1)"),
    ("wavefront: a strip is closed before its neighbours are done", "sim/solver/wavefront.cpp",
     "  if (!neighbours_have(worked_, strip, round + 1)) return false;\n  finish", "  finish"),
    ("wavefront: round after round", "sim/solver/wavefront.cpp",
     "if (s > begin) --s;", "s = s + 1 < end ? s + 1 : begin;"),
    ("wavefront: bodies of a strip are not extrapolated", "sim/solver/extrapolation.cpp",
     "motion.subspan(bodies.begin, bodies.end - bodies.begin)", "motion.subspan(bodies.begin, 0)"),
    ("extrapolation: begins from the end of the step before", "sim/solver/extrapolation.cpp",
     "  remember(strips, motion, threads);\n}", "  if (motion_.size() != motion.size()) remember(strips, motion, threads);\n}"),
    ("single precision: a contact cannot bear less than before", "sim/contact/contact_law-inl.hpp",
     "return minus(c.base_n);", "return number<V>(0);"),
    ("single precision: friction is limited by the increment alone", "sim/contact/contact_law-inl.hpp",
     "held = friction * c.base_n,", "held = c.base_n - c.base_n,"),
    ("single precision: the limit of friction forgets what there is", "sim/contact/contact_law-inl.hpp",
     "(held - c.base_t) + more}", "held + more}"),
    ("single precision: friction is limited to one side only", "sim/contact/contact_law-inl.hpp",
     "{(minus(held) - c.base_t) - more,", "{number<V>(-1e30),"),
    ("single precision: rebounds are forgotten", "sim/contact/contact_law-inl.hpp",
     "with.restitution ? c.impulse_n + c.rebound : c.impulse_n", "c.impulse_n"),
    ("single precision: changes of friction are those of impulses", "sim/contact/contact_law-inl.hpp",
     "with.rotation ? t * ratio : t,", "t,"),
    ("single precision: both bodies have the weight of one", "sim/solver/single_contacts.cpp",
     "store(c.mass_n * b.inverse_mass, to.weight_j);", "store(c.mass_n * a.inverse_mass, to.weight_j);"),
    ("single precision: what there is is not per mass", "sim/solver/single_contacts.cpp",
     "store(c.impulse_n * w_nn, to.base_n);", "store(c.impulse_n, to.base_n);"),
    ("single precision: tangents have the mass of normals", "sim/solver/single_contacts.cpp",
     "store(c.mass_t * w_nn, to.mass_ratio);", "store(c.mass_n * w_nn, to.mass_ratio);"),
    ("single precision: increments replace the first guess", "sim/solver/single_contacts.cpp",
     "sum = c.impulse_n + more * c.mass_n;", "sum = more * c.mass_n;"),
    ("single precision: velocities get the first guess twice", "sim/solver/single_contacts.cpp",
     "apply<with>(to, lane, normal - c.impulse_n, more_t,", "apply<with>(to, lane, normal, more_t,"),
    ("single precision: an impulse that ends leaves its last digits", "sim/solver/single_contacts.cpp",
     "hn::IfThenZeroElse(opened, larger(sum, hn::Zero(d)))",
     "hn::IfThenElse(opened, larger(sum, hn::Zero(d)), larger(sum, hn::Zero(d)))"),
    ("single precision: friction keeps its rounding", "sim/solver/single_contacts.cpp",
     "smaller(larger(sum_t, minus(limit)), limit)", "larger(sum_t, minus(sum_t + limit))"),
    ("single precision: the second half of a block is the first", "sim/solver/single_contacts.cpp",
     "give_half<with>(*from, block_lanes,", "give_half<with>(*from, 0,"),
    ("single precision: a lone block's other half acts", "sim/solver/single_contacts.cpp",
     "take_half<with>(b + 1 < run.size() ? run[b + 1] : neutral,", "take_half<with>(b + 1 < run.size() ? run[b + 1] : run[b],"),
    ("single precision: increments are not given their mass", "sim/solver/single_contacts.cpp",
     "c.impulse_t + single(from.impulse_t) * c.mass_n;", "c.impulse_t + single(from.impulse_t);"),
]

ARGUED = set()
LIBRARY = "grseg_simulator"
FOLDER = "sim"  # folder of the library
HARD = ["impacts", "falls", "rolling", "columns", "stacks", "overlaps", "sizes", "balances",
        "invariances", "newcomer", "extremes", "slopes"]
UNIT = ["contact_law", "sweep", "single_contacts", "solver", "wavefront", "detection", "pair_list", "simulation", "restart",
        "divided_step", "effects", "energy_balance", "boundary_body", "wedged_grains"]
# This test stops the processor after every instruction and takes minutes, so it runs only if no other test fails.
SLOW, SLOW_SECONDS = "left_out_test", 300
OPTIONS = []
QUICK = [f"{name}_test" for name in HARD + UNIT]
TARGETS = [*QUICK, SLOW]


def noticed(copy, _=None):
    """Names of the failing tests: of the hard cases, and of the unit tests."""
    with concurrent.futures.ThreadPoolExecutor(copy.jobs) as pool:
        found = dict(zip(QUICK, pool.map(copy.failures, QUICK)))
    of = lambda names: sum((found[f"{name}_test"] for name in names), [])
    hard, unit = of(HARD), of(UNIT)
    return {"hard": hard, "unit": unit if hard or unit else copy.failures(SLOW, SLOW_SECONDS)}


def sound(copy):
    """Names of tests that fail without a fault. The slow test runs here, too, if no other test fails."""
    return sum(noticed(copy).values(), [])


def table(results):
    yield "| what is broken | file | hard cases that fail | among them | other tests that fail |"
    yield "|---|---|---|---|---|"
    for r in results:
        shown = ", ".join(f"`{name}`" for name in r["hard"][:3]) or "–"
        others = f"{len(r['unit'])}" + (f": `{r['unit'][0]}`" if r["unit"] and not r["hard"] else "")
        yield f"| {r['what']} | {os.path.basename(r['file'])} | {len(r['hard'])} | {shown} | {others} |"
