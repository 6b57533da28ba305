// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/trajectory/reader.hpp"

#include "formats/core/dimension.hpp"
#include "formats/core/errors.hpp"
#include "formats/trajectory/digest.hpp"
#include "formats/trajectory/integrity.hpp"
#include "formats/trajectory/stored_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <numbers>
#include <optional>

namespace grseg {
namespace {

using namespace hdf5;

constexpr TrajectoryReader::Fields whole{.velocity = true, .contacts = true, .force = true};

constexpr const char* names_of_fields[number_of_fields] = {
    "/particles/grains/position/step, time or its rows of contacts",
    "/particles/grains/position",
    "/particles/grains/image",
    "/particles/grains/velocity",
    "/particles/grains/angular_velocity",
    "/particles/grains/force",
    "/grseg/contacts/i",
    "/grseg/contacts/j",
    "/grseg/contacts/force",
    "/grseg/contacts/branch",
    "/grseg/contacts/gap",
    "/observables"};

}  // namespace

struct TrajectoryReader::Impl : StoredRun {
  Impl(const std::string& its_path, Verify its_verify) : StoredRun(its_path), verify(its_verify) {}

  Verify verify;
  Seal::Numbers seal{};
  bool closed = false;
  mutable bool observables_verified = false;
  mutable std::vector<double> parts;  // observable frame_step, once a frame with forces is read

  void read_seal();
  std::string damage_of_run() const;
  std::string damage_of_observables() const;
  void drop_damaged_end();
  template <int D>
  Packed load(std::size_t index, Frame<D>& frame, Fields fields) const;
  template <int D>
  void unpack(const Packed& packed, Frame<D>& frame) const;
  template <int D>
  std::optional<Field> changed_field(std::size_t index, const Frame<D>& frame, Fields fields) const;
  void verify_whole(std::size_t index) const;
  bool matches(std::size_t index, Field field, std::uint64_t digest) const
  {
    return field_digests[index][static_cast<std::size_t>(field)] == digest;
  }
  template <int D>
  bool chain_matches(std::size_t index, const Frame<D>& frame) const
  {
    return frame_digest(frame, index == 0 ? 0 : chain[index - 1], stores_float32()) == chain[index];
  }
  static std::string changed(Field field, std::size_t index)
  {
    return fmt::format(
        "{} of frame {} is not what was written: the file is damaged; take a copy "
        "that is whole, or leave the frame out with --begin or --end",
        names_of_fields[static_cast<std::size_t>(field)], index);
  }
};

TrajectoryReader::TrajectoryReader(const std::string& path, Verify verify)
    : impl_(std::make_unique<Impl>(path, verify))
{
  auto& my = *impl_;
  if (my.has_field_digests())
    my.read_seal();
  else
    my.drop_damaged_end();
  if (verify == Verify::no) return;
  if (const auto damage = my.damage_of_run(); !damage.empty()) my.fail(damage);
}

/// The seal says that the file was closed; /parameters/complete repeats it for other readers. Before
/// that, what is known at the end is not there.
void TrajectoryReader::Impl::read_seal()
{
  const auto dataset = open("/grseg/seal", H5T_INTEGER, 1);
  dataset.require(0, seal.size());
  dataset.read_all(H5T_NATIVE_UINT64, seal.data());
  closed = seal != Seal{}.numbers();
  std::erase_if(run.parameters.numbers,
                [&](const auto& number) { return !closed && is_known_at_end(number.first); });
}

/// In files of version 1.0 a kill in the middle of a write can leave the last frames committed but
/// damaged, which their digests reveal. A file that was closed has no such end.
void TrajectoryReader::Impl::drop_damaged_end()
{
  closed = run.parameters.numbers.contains("complete");
  if (closed) return;
  const auto is_whole = [&](std::size_t last) {
    return with_dimension(dimension(), [&](auto d) {
      Frame<d> frame;
      try {
        unpack(load(last, frame, whole), frame);
      } catch (const FormatError&) {
        return false;
      }
      return chain_matches(last, frame);
    });
  };
  while (size() > 0 && !is_whole(size() - 1)) drop_last();
}

/// What is damaged outside frames, or where they stand.
std::string TrajectoryReader::Impl::damage_of_run() const
{
  if (!has_field_digests()) return {};
  constexpr const char* remedy = "the file is damaged; take a copy that is whole";
  std::uint64_t stored = 0;
  open("/grseg/static_digest", H5T_INTEGER, 0).read_all(H5T_NATIVE_UINT64, &stored);
  const auto digest = static_digest(run);
  if (digest != stored)
    return fmt::format(
        "box, grains, species, observables or parameters are not what was written: {}", remedy);
  for (std::size_t k = 0; k < size(); ++k)
    if (!matches(
            k, Field::place,
            field_digest(k, FramePlace{steps[k], times[k], offset[k], offset[k + 1], chain[k]})))
      return changed(Field::place, k);
  if (!closed) return {};
  const auto last = chain.empty() ? 0 : chain.back();
  if (make_seal(size(), offset.back(), last, digest, run.parameters).numbers() != seal)
    return fmt::format("/grseg/seal names other frames or another summary than the file holds: {}",
                       remedy);
  return {};
}

std::string TrajectoryReader::Impl::damage_of_observables() const
{
  if (!has_field_digests()) return {};
  std::vector<std::vector<double>> all;
  for (const auto& observable : run.observables) all.push_back(read_observable(observable.name));
  std::vector<double> of_frame(all.size());
  for (std::size_t k = 0; k < size(); ++k) {
    for (std::size_t q = 0; q < all.size(); ++q) of_frame[q] = all[q][k];
    if (!matches(k, Field::observables, field_digest(k, of_frame)))
      return changed(Field::observables, k);
  }
  return {};
}

template <int D>
TrajectoryReader::Packed TrajectoryReader::Impl::load(std::size_t index, Frame<D>& frame,
                                                      Fields fields) const
{
  if (D != dimension())
    fail(fmt::format("is a run in {} dimensions, which this program does not read",
                     dimension() == 2 ? "two" : "three"));
  Packed packed{index, fields, {}};
  auto& rows = packed.rows;
  frame.step = steps.at(index);
  frame.time = times[index];
  load_row(position, index, frame.position, rows);
  frame.velocity.clear();
  frame.angular_velocity.clear();
  frame.force.clear();
  frame.image.clear();
  frame.contacts.clear();
  if (fields.velocity) {
    load_row(velocity, index, frame.velocity, rows);
    load_row(angular_velocity, index, frame.angular_velocity, rows);
  }
  if (fields.force) {
    if (run.has_force) load_row(force, index, frame.force, rows);
    load_row(image, index, frame.image, rows);
  }
  if (fields.contacts) load_contacts(index, frame.contacts, rows);
  return packed;
}

/// Decompresses and checks, without digests.
template <int D>
void TrajectoryReader::Impl::unpack(const Packed& packed, Frame<D>& frame) const
{
  for (const auto& rows : packed.rows) rows.unpack();
  check(packed.index, frame);
}

/// The first of the fields that were read which is not as it was written.
template <int D>
std::optional<Field> TrajectoryReader::Impl::changed_field(std::size_t index, const Frame<D>& frame,
                                                           Fields fields) const
{
  const bool float32 = stores_float32();
  const auto find = [&](bool was_read, std::initializer_list<Field> these) -> std::optional<Field> {
    if (was_read)
      for (const auto field : these)
        if (!matches(index, field, field_digest(field, index, frame, float32))) return field;
    return {};
  };
  auto found = find(true, {Field::position});
  if (!found) found = find(fields.velocity, {Field::velocity, Field::angular_velocity});
  if (!found) found = find(fields.force, {Field::image, Field::force});
  if (!found)
    found = find(fields.contacts, {Field::contact_i, Field::contact_j, Field::contact_force,
                                   Field::contact_branch, Field::contact_gap});
  return found;
}

/// In files of version 1.0 only a whole frame can be verified.
void TrajectoryReader::Impl::verify_whole(std::size_t index) const
{
  with_dimension(dimension(), [&](auto d) {
    Frame<d> frame;
    unpack(load(index, frame, whole), frame);
    if (!chain_matches(index, frame))
      fail(
          fmt::format("frame {} is not what was written: the file is damaged; take a copy that is "
                      "whole, or leave the frame out with --begin or --end",
                      index));
  });
}

TrajectoryReader::~TrajectoryReader() = default;
TrajectoryReader::TrajectoryReader(TrajectoryReader&&) noexcept = default;

const std::string& TrajectoryReader::path() const
{
  return impl_->path;
}
std::size_t TrajectoryReader::size() const
{
  return impl_->size();
}
std::size_t TrajectoryReader::contacts() const
{
  return impl_->offset.back();
}
const Grains& TrajectoryReader::grains() const
{
  return impl_->run.grains;
}
const SpeciesList& TrajectoryReader::species() const
{
  return impl_->run.species;
}
const Box& TrajectoryReader::box() const
{
  return impl_->run.box;
}
const Parameters& TrajectoryReader::parameters() const
{
  return impl_->run.parameters;
}
bool TrajectoryReader::has_force() const
{
  return impl_->run.has_force;
}
int TrajectoryReader::minor_version() const
{
  return impl_->minor_version;
}
bool TrajectoryReader::closed() const
{
  return impl_->closed;
}
const std::vector<std::int64_t>& TrajectoryReader::steps() const
{
  return impl_->steps;
}
const std::vector<double>& TrajectoryReader::times() const
{
  return impl_->times;
}

std::string TrajectoryReader::verified() const
{
  if (impl_->verify == Verify::no) return "no (--trust)";
  return impl_->has_field_digests() ? "all" : "frames only";
}

double TrajectoryReader::small_diameter() const
{
  return parameters().number("small_diameter", path());
}
double TrajectoryReader::large_diameter() const
{
  return parameters().number("large_diameter", path());
}
double TrajectoryReader::step() const
{
  return parameters().number("step", path());
}

template <int D>
Gravity<D> TrajectoryReader::gravity() const
{
  const auto& numbers = parameters().numbers;
  const auto found = numbers.find("gravity");
  if (found == numbers.end() || found->second.size() != D)
    impl_->fail(fmt::format("/parameters/gravity should be {} numbers; see formats/README.md",
                            D == 2 ? "two" : "three"));
  const double rate =
      numbers.count("slope_rate") > 0 ? parameters().number("slope_rate", path()) : 0;
  return {Vector<D>(found->second.data()), rate * std::numbers::pi / 180};
}

template <int D>
TrajectoryReader::Packed TrajectoryReader::load(std::size_t index, Frame<D>& frame,
                                                Fields fields) const
{
  const auto& my = *impl_;
  auto packed = my.load(index, frame, fields);
  frame.part = 0;
  if (fields.force && has_observable("frame_step")) {
    if (my.parts.empty()) my.parts = observable("frame_step");
    frame.part = my.parts.at(index);
  }
  if (my.verify == Verify::yes && !my.has_field_digests()) my.verify_whole(index);
  return packed;
}

template <int D>
void TrajectoryReader::unpack(const Packed& packed, Frame<D>& frame) const
{
  const auto& my = *impl_;
  my.unpack(packed, frame);
  if (my.verify == Verify::no || !my.has_field_digests()) return;
  if (const auto field = my.changed_field(packed.index, frame, packed.fields))
    my.fail(Impl::changed(*field, packed.index));
}

bool TrajectoryReader::has_observable(const std::string& name) const
{
  const auto& all = observables();
  return std::any_of(all.begin(), all.end(), [&](const auto& known) { return known.name == name; });
}

const std::vector<Observable>& TrajectoryReader::observables() const
{
  return impl_->run.observables;
}

std::vector<double> TrajectoryReader::observable(const std::string& name) const
{
  const auto& my = *impl_;
  if (my.verify == Verify::yes && !my.observables_verified) {
    if (const auto damage = my.damage_of_observables(); !damage.empty()) my.fail(damage);
    my.observables_verified = true;
  }
  return my.read_observable(name);
}

std::uint64_t TrajectoryReader::digest() const
{
  return size() == 0 ? 0 : digests().back();
}

const std::vector<std::uint64_t>& TrajectoryReader::digests() const
{
  return impl_->chain;
}

bool TrajectoryReader::stores_float32() const
{
  return impl_->stores_float32();
}

std::string TrajectoryReader::damage_outside_frames() const
{
  const auto damage = impl_->damage_of_run();
  return damage.empty() ? impl_->damage_of_observables() : damage;
}

template <int D>
bool TrajectoryReader::is_intact(std::size_t index, const Frame<D>& frame) const
{
  const auto& my = *impl_;
  return my.chain_matches(index, frame) &&
         (!my.has_field_digests() || !my.changed_field(index, frame, whole));
}

template Gravity<2> TrajectoryReader::gravity() const;
template Gravity<3> TrajectoryReader::gravity() const;
using Packed = TrajectoryReader::Packed;
using Fields = TrajectoryReader::Fields;
template Packed TrajectoryReader::load(std::size_t, Frame<2>&, Fields) const;
template Packed TrajectoryReader::load(std::size_t, Frame<3>&, Fields) const;
template void TrajectoryReader::unpack(const Packed&, Frame<2>&) const;
template void TrajectoryReader::unpack(const Packed&, Frame<3>&) const;
template bool TrajectoryReader::is_intact(std::size_t, const Frame<2>&) const;
template bool TrajectoryReader::is_intact(std::size_t, const Frame<3>&) const;

}  // namespace grseg
