// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/errors.hpp"
#include "formats/import/common/archive.hpp"
#include "formats/import/common/archive_files.hpp"
#include "formats/import/common/guarded_reading.hpp"
#include "formats/import/lmgc90/lmgc90.hpp"
#include "formats/trajectory/hdf5.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace grseg {
namespace {

class Lmgc90Archive : public Archive {
 public:
  Lmgc90Archive(Lmgc90Bodies bodies, Lmgc90Steps steps, bool is_text)
      : bodies_(std::move(bodies)), steps_(std::move(steps))
  {
    facts_.discs = bodies_.dimension == 2;
    facts_.gravity = bodies_.gravity;
    facts_.walls = bodies_.walls;
    facts_.lists_all = false;
    facts_.at_detection = true;
    facts_.tolerance = is_text ? 1e-3 : 1e-6;
    facts_.tolerance_reason = is_text ? "the texts of LMGC90 have 7 digits"
                                      : "LMGC90 writes masses with 7 digits, all else with 16";
    const auto count = steps_.numbers.size();
    std::size_t following = 0;
    for (std::size_t k = 0; k < count; ++k) following += follows(k) ? 1 : 0;
    with_forces_ = bodies_.know_masses && 2 * following >= count;
    if (with_forces_ && following < count)
      remarks_.push_back(
          fmt::format("steps are left out if the step before was not written: {} of {}",
                      count - following, count));
  }

  const ArchiveFacts& facts() const override { return facts_; }
  std::vector<std::string> remarks() const override { return remarks_; }

  bool next(ArchiveFrame& frame) override
  {
    do {
      if (at_ == steps_.numbers.size()) return false;
      before_ = std::move(step_);
      step_ = steps_.read(at_++);
      if (step_.bodies.size() != bodies_.all.size())
        throw FormatError(fmt::format(
            "{} has {} bodies, but {} has {}: are they of the same run, and is the first complete?",
            step_.place, step_.bodies.size(), bodies_.path, bodies_.all.size()));
    } while (with_forces_ && !follows(at_ - 1));
    if (!facts_.step) facts_.step = step_.length;
    frame = ArchiveFrame{};
    frame.step = steps_.numbers[at_ - 1];
    frame.time = step_.time;
    frame.place = step_.place;
    for (std::size_t b = 0; b < bodies_.all.size(); ++b)
      if (is_grain(b)) add_grain(b, frame.grains);
    for (const auto& pair : step_.pairs) add_contact(pair, frame.contacts);
    if (frame.grains.size() == 0) throw FormatError(step_.place + " has no grains");
    enclose_grains(frame);
    return true;
  }

 private:
  /// True if the step before this one was written, too.
  bool follows(std::size_t k) const
  {
    const auto& numbers = steps_.numbers;
    return k > 0 && numbers[k] > 0 && numbers[k] - 1 == numbers[k - 1];
  }

  bool is_grain(std::size_t b) const
  {
    return bodies_.all[b].radius > 0 && step_.bodies[b].visible;
  }

  void add_grain(std::size_t b, ArchiveGrains& grains) const
  {
    const auto& body = bodies_.all[b];
    const auto& now = step_.bodies[b];
    const double h = step_.length;
    grains.id.push_back(static_cast<std::int64_t>(b + 1));
    grains.radius.push_back(body.radius);
    if (bodies_.know_masses) grains.mass.push_back(body.mass);
    grains.fixed.push_back(body.fixed);
    grains.position.push_back(body.position + now.displacement - step_.theta * h * now.velocity);
    grains.velocity.push_back(now.velocity);
    grains.angular_velocity.push_back(now.spin);
    if (with_forces_)
      grains.force.push_back(body.mass * (now.velocity - before_.bodies[b].velocity) / h);
  }

  void add_contact(const Lmgc90Step::Pair& pair, ArchiveContacts& contacts) const
  {
    if (pair.force.isZero() && pair.gap > 0) return;  // a pair that is only near
    const auto fail = [&](const std::string& why) {
      throw FormatError(fmt::format("{}: the contact of bodies {} and {} {}", step_.place,
                                    pair.candidate, pair.antagonist, why));
    };
    const auto i = static_cast<std::size_t>(pair.candidate) - 1,
               j = static_cast<std::size_t>(pair.antagonist) - 1;  // huge if it was not positive
    const bool known = std::max(i, j) < bodies_.all.size();
    const bool at_wall = known && bodies_.all[j].radius == 0;
    if (!known || !is_grain(i) || (!at_wall && !is_grain(j)) || pair.contactor < 1 ||
        pair.contactor > bodies_.all[j].contactors)
      fail("is not one of a grain and a grain or wall of " + bodies_.path);
    if (std::abs(pair.normal.norm() - 1) > 1e-3) fail("has a normal whose length is not 1");
    const auto wall = bodies_.all[j].first_wall + static_cast<std::int32_t>(pair.contactor) - 1;
    contacts.add(pair.candidate, pair.antagonist, at_wall ? wall : -1, pair.force,
                 at_wall ? Vec3(pair.normal * (bodies_.all[i].radius + pair.gap))
                         : Vec3::Constant(std::nan("")),
                 -pair.gap);
  }

  Lmgc90Bodies bodies_;
  Lmgc90Steps steps_;
  ArchiveFacts facts_;
  std::vector<std::string> remarks_;
  bool with_forces_ = false;  // true: only steps are read of which the step before is known
  std::size_t at_ = 0;
  Lmgc90Step step_, before_;
};

FileRole role_of(const FileStart& start)
{
  const auto has = [](const std::vector<std::string>& texts, std::string_view begin) {
    return std::any_of(texts.begin(), texts.end(),
                       [&](const std::string& text) { return text.starts_with(begin); });
  };
  if (has(start.groups, "Evolution") && has(start.groups, "Simulation")) return FileRole::grains;
  if (has(start.lines, "$blmty")) return FileRole::restart;
  if (!has(start.lines, "$steps")) return FileRole::none;
  if (has(start.lines, "! Vloc_Rloc")) return FileRole::contacts;
  return has(start.lines, "! DOF") ? FileRole::grains : FileRole::none;
}

/// DATBOX/BODIES.DAT in the folder of an output, or in the folder above.
std::string bodies_of(const std::string& output)
{
  const auto folder = std::filesystem::path(output).parent_path();
  for (const auto& path : {folder / "DATBOX/BODIES.DAT", folder / "../DATBOX/BODIES.DAT"})
    if (std::filesystem::is_regular_file(path)) return path.string();
  throw OpenQuestions({"the bodies of the run, which have radii and reference positions",
                       "--restart BODIES.DAT",
                       fmt::format("no folder DATBOX is beside {} or above it", output)});
}

/// Opens a run of LMGC90, a program of contact dynamics: its HDF5 file, or its texts DOF.OUT.n with
/// Vloc_Rloc.OUT.n beside them. --restart names BODIES.DAT if it is not in DATBOX beside or above.
///
/// * Forces: the files contain impulse over step on the candidate, along t, n and s of the contact;
///   n points from the antagonist to the candidate.
/// * Positions: LMGC90 writes those at the end of a step. Contacts were looked for at x - theta h v,
///   which is the position here, so that branches belong to the forces.
/// * Gaps: the files have the gap expected at the next step, gap + h v_n; h v_n is subtracted.
/// * Walls: every contactor JONCx, xKSID (a disc around the grains), PLANx or DNLYC is one.
/// * Force of a grain: m (v - v of the previous step) / h, if most steps were written. Steps whose
///   previous step was not are then left out, with a remark.
/// * Near pairs, without a force, and invisible bodies are left out.
///
/// Sources: mod_h5_interaction, format_v0, mod_a_DOF, mod_DKDKx (and the like), mod_nlgs, mod_RBDY2
/// and mod_RBDY3 of LMGC90 (lmgc90_user 2025). Files of its own tests agree to round-off.
std::unique_ptr<Archive> open_lmgc90(const ArchiveFiles& files)
{
  const auto names = archive_files(files.grains, "--grains");
  const auto bodies = read_lmgc90_bodies(files.restart.empty()
                                             ? bodies_of(names[0])
                                             : archive_files({files.restart}, "--restart").front());
  if (!hdf5::is_hdf5(names[0]))
    return std::make_unique<Lmgc90Archive>(bodies, open_lmgc90_texts(names), true);
  if (names.size() != 1) throw UsageError("--grains: a run of LMGC90 is one HDF5 file");
  hdf5::silence();
  return open_guarded(names[0], [&] {
    return std::make_unique<Lmgc90Archive>(bodies, open_lmgc90_hdf5(names[0]), false);
  });
}

}  // namespace

const ArchiveFormat lmgc90_format{
    .name = "lmgc90",
    .open = open_lmgc90,
    .role = role_of,
    .takes_contacts = false,
    .takes_columns = false,
    .takes_restart = true,
    .examples =
        "  grseg-import --format lmgc90 --grains lmgc90.h5 --units si --cell x:0:1:periodic \\\n"
        "    -o run.h5\n",
    .notes =
        "  lmgc90: lmgc90.h5, or OUTBOX/DOF.OUT.* with Vloc_Rloc.OUT.* beside them; BODIES.DAT is\n"
        "    found in DATBOX, or named with --restart\n"};

}  // namespace grseg
