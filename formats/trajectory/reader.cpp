// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/trajectory/reader.hpp"

#include "formats/core/errors.hpp"
#include "formats/trajectory/digest.hpp"
#include "formats/trajectory/hdf5_attributes.hpp"
#include "formats/trajectory/stored_run.hpp"

#include <numbers>

namespace grseg {

using namespace hdf5;

struct TrajectoryReader::Impl : StoredRun {
  using StoredRun::StoredRun;
};

TrajectoryReader::TrajectoryReader(const std::string& path) : impl_(std::make_unique<Impl>(path))
{
  drop_damaged_end();
}

/// A kill in the middle of a write can leave the last frames committed but damaged, which their
/// digests reveal. A file that was closed has no such end.
void TrajectoryReader::drop_damaged_end()
{
  auto& my = *impl_;
  if (my.parameters.numbers.contains("complete") || !exists(my.file, "/grseg/digest")) return;
  auto digests = this->digests();
  digests.insert(digests.begin(), 0);
  Frame frame;
  const auto whole = [&](std::size_t last) {
    try {
      read(last, frame, {.velocity = true, .contacts = true, .force = true});
    } catch (const FormatError&) {
      return false;
    }
    return frame_digest(frame, digests[last], stores_float32()) == digests[last + 1];
  };
  while (size() > 0 && !whole(size() - 1)) {
    my.offset.pop_back();
    my.steps.pop_back();
    my.times.pop_back();
  }
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
  return impl_->grains;
}
const Box& TrajectoryReader::box() const
{
  return impl_->box;
}
const Parameters& TrajectoryReader::parameters() const
{
  return impl_->parameters;
}
bool TrajectoryReader::has_force() const
{
  return impl_->has_force;
}
const std::vector<std::int64_t>& TrajectoryReader::steps() const
{
  return impl_->steps;
}
const std::vector<double>& TrajectoryReader::times() const
{
  return impl_->times;
}

double TrajectoryReader::small_diameter() const
{
  return impl_->parameters.number("small_diameter", impl_->path);
}
double TrajectoryReader::large_diameter() const
{
  return impl_->parameters.number("large_diameter", impl_->path);
}
double TrajectoryReader::step() const
{
  return impl_->parameters.number("step", impl_->path);
}

Gravity TrajectoryReader::gravity() const
{
  const auto& numbers = impl_->parameters.numbers;
  const auto found = numbers.find("gravity");
  if (found == numbers.end() || found->second.size() != 2)
    impl_->fail("/parameters/gravity should be two numbers; see formats/README.md");
  const double rate =
      numbers.count("slope_rate") > 0 ? impl_->parameters.number("slope_rate", impl_->path) : 0;
  return {{found->second[0], found->second[1]}, rate * std::numbers::pi / 180};
}

void TrajectoryReader::read(std::size_t index, Frame& frame, Fields fields) const
{
  const auto& my = *impl_;
  const std::size_t count = my.grains.size();
  frame.step = my.steps.at(index);
  frame.time = my.times[index];
  my.read_vectors(my.position, index, frame.position, index);
  frame.velocity.clear();
  frame.angular_velocity.clear();
  frame.force.clear();
  frame.image.clear();
  frame.contacts.clear();
  if (fields.velocity) {
    my.read_vectors(my.velocity, index, frame.velocity, index);
    frame.angular_velocity.resize(count);
    my.angular_velocity.read_rows(H5T_NATIVE_DOUBLE, index, 1, frame.angular_velocity.data());
    my.check_finite(frame.angular_velocity.data(), count, my.angular_velocity.path(), index);
  }
  if (fields.force) {
    if (my.has_force) my.read_vectors(my.force, index, frame.force, index);
    frame.image.resize(count);
    my.image.read_rows(H5T_NATIVE_INT32, index, 1, frame.image.data());
  }
  if (fields.contacts) my.read_contacts(index, frame.contacts);
}

bool TrajectoryReader::has_observable(const std::string& name) const
{
  return exists(impl_->file, "/observables/" + name + "/value");
}

std::vector<Observable> TrajectoryReader::observables() const
{
  std::vector<Observable> all;
  for (const auto& name : names_in(impl_->file, "/observables")) {
    if (!has_observable(name)) continue;
    const auto value = impl_->open("/observables/" + name + "/value", H5T_FLOAT, 1);
    const auto unit = read_texts(value.id(), "unit");
    all.push_back({name, unit.empty() ? "" : unit[0]});
  }
  return all;
}

std::vector<double> TrajectoryReader::observable(const std::string& name) const
{
  const auto dataset = impl_->open("/observables/" + name + "/value", H5T_FLOAT, 1);
  dataset.require(0, size(), true);
  std::vector<double> values(size());
  dataset.read_rows(H5T_NATIVE_DOUBLE, 0, size(), values.data());
  return values;
}

std::uint64_t TrajectoryReader::digest() const
{
  return size() == 0 ? 0 : digests().back();
}

std::vector<std::uint64_t> TrajectoryReader::digests() const
{
  const auto dataset = impl_->open("/grseg/digest", H5T_INTEGER, 1);
  dataset.require(0, size(), true);
  std::vector<std::uint64_t> all(size());
  dataset.read_rows(H5T_NATIVE_UINT64, 0, size(), all.data());
  return all;
}

bool TrajectoryReader::stores_float32() const
{
  return impl_->position.stores_float32();
}

}  // namespace grseg
