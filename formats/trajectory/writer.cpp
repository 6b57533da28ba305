// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/trajectory/writer.hpp"

#include "formats/core/errors.hpp"
#include "formats/core/files.hpp"
#include "formats/trajectory/digest.hpp"
#include "formats/trajectory/hdf5.hpp"
#include "formats/trajectory/layout.hpp"
#include "formats/trajectory/reader.hpp"
#include "formats/trajectory/run_description.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <numeric>

namespace grseg {
namespace {

using namespace hdf5;

/// A growing dataset, with the type in memory of the numbers that are appended.
struct Series {
  Dataset dataset;
  hid_t memory_type = H5I_INVALID_HID;
  std::string path;

  void append(hsize_t rows, const void* data) const
  {
    append_rows(dataset, memory_type, rows, data, path);
  }
};

/// Indices of the observables in alphabetical order of their names.
std::vector<std::size_t> alphabetical(const std::vector<Observable>& observables)
{
  std::vector<std::size_t> order(observables.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return observables[a].name < observables[b].name;
  });
  return order;
}

}  // namespace

struct TrajectoryWriter::Impl {
  std::string path;
  RunDescription run;
  StorageSettings storage;
  File file;
  std::array<Series, number_of_fields> arrays;  // index: Field
  Series step, time, offset, digest, field_digests;
  std::vector<Series> observables;
  std::vector<std::size_t> observables_in_order;
  std::size_t frames_so_far = 0;
  std::uint64_t contacts_so_far = 0;
  std::uint64_t digest_so_far = 0;
  bool is_writing = false;  ///< true during a write, and forever after a write that failed

  /// Creates and opens the file. A live file gets its final name after creation and before it is
  /// opened again in SWMR mode, so that readers never meet it in a state which they cannot read.
  void open_file()
  {
    const RemoveAtEnd unfinished(storage.live ? temporary_path(path) : "");
    create_trajectory(storage.live ? unfinished.path() : path, run, storage);
    if (storage.live) rename_path(unfinished.path(), path);
    const unsigned mode = H5F_ACC_RDWR | (storage.live ? H5F_ACC_SWMR_WRITE : 0U);
    const Properties access = newest_format();
    if (storage.live) keep_in_pages(access);
    file = File(H5Fopen(path.c_str(), mode, access));
    if (!file.valid())
      throw RunError(fmt::format("cannot open {} for writing: {}", path, reason_of_failure()));
  }

  Series series(const std::string& at, Number number) const
  {
    Series result{Dataset(H5Dopen2(file, at.c_str(), H5P_DEFAULT)), type_of(number),
                  path + ": " + at};
    if (!result.dataset.valid()) throw RunError(fmt::format("cannot open {}", result.path));
    return result;
  }

  Series series(const LayoutRow& row) const { return series(row.path, row.type); }

  void open_arrays(bool of_contacts)
  {
    for_each_array(Frame<2>(), [&](Field field, const auto&) {
      if (is_of_contacts(field) == of_contacts && (field != Field::force || run.has_force))
        arrays[static_cast<std::size_t>(field)] = series(row_of(field));
    });
  }

  /// Opens all datasets in a fixed order, because HDF5 writes them in the order of their opening.
  void open_series()
  {
    step = series(row_at("/particles/grains/position/step"));
    time = series(row_at("/particles/grains/position/time"));
    open_arrays(false);
    for (const auto& [name, unit] : run.observables)
      observables.push_back(series("/observables/" + name + "/value", Number::f64));
    open_arrays(true);
    offset = series(row_at("/grseg/contacts/offset"));
    digest = series(row_at("/grseg/digest"));
    field_digests = series(row_at("/grseg/field_digest"));
  }

  template <int D>
  void require_presence(const Frame<D>& frame) const
  {
    if (run.grains_come_and_go) return;
    for (std::size_t g = 0; g < frame.position.size(); ++g)
      if (!is_present(frame, g))
        throw RunError(fmt::format(
            "{}: grain {} has no position in frame {}, but this run allows no absent grains", path,
            run.grains.id[g], frames_so_far));
  }

  template <int D>
  void append_arrays(const Frame<D>& frame, bool of_contacts) const
  {
    for_each_array(frame, [&](Field field, const auto& values) {
      if (is_of_contacts(field) == of_contacts && !values.empty())
        arrays[static_cast<std::size_t>(field)].append(of_contacts ? values.size() : 1,
                                                       values.data());
    });
  }

  template <int D>
  void append_digests(const Frame<D>& frame, std::span<const double> values)
  {
    digest_so_far = frame_digest(frame, digest_so_far, storage.float32);
    digest.append(1, &digest_so_far);

    std::vector<double> in_order;
    in_order.reserve(values.size());
    for (const auto k : observables_in_order) in_order.push_back(values[k]);
    FieldDigests all;
    for (std::size_t f = 0; f < all.size(); ++f)
      all[f] = field_digest(static_cast<Field>(f), frames_so_far, frame, storage.float32);
    all[static_cast<std::size_t>(Field::place)] = field_digest(
        frames_so_far, FramePlace{frame.step, frame.time, contacts_so_far,
                                  contacts_so_far + frame.contacts.size(), digest_so_far});
    all[static_cast<std::size_t>(Field::observables)] = field_digest(frames_so_far, in_order);
    field_digests.append(1, all.data());
  }

  void write_seal()
  {
    const auto seal =
        make_seal(frames_so_far, contacts_so_far, digest_so_far, static_digest(run), run.parameters)
            .numbers();
    overwrite(file, "/grseg/seal", H5T_NATIVE_UINT64, seal.data());
  }

  void flush()
  {
    if (H5Fflush(file, H5F_SCOPE_GLOBAL) < 0)
      throw RunError(fmt::format("cannot write {}: {}", path, reason_of_failure()));
  }
};

TrajectoryWriter::TrajectoryWriter(const std::string& path, const RunDescription& run,
                                   const StorageSettings& storage)
    : impl_(std::make_unique<Impl>())
{
  silence();
  auto& my = *impl_;
  my.path = path;
  my.run = run;
  my.storage = storage;
  my.observables_in_order = alphabetical(run.observables);
  my.open_file();
  my.open_series();
  my.offset.append(1, &my.contacts_so_far);
  if (storage.live) my.flush();
}

TrajectoryWriter::~TrajectoryWriter()
{
  // Closing a live file after a failed write would mark it as whole, and HDF5 would then refuse to
  // open it. Without closing, the file stays as after a kill, with all frames but the last one.
  static Impl* abandoned = nullptr;
  if (impl_ && impl_->storage.live && impl_->is_writing) abandoned = impl_.release();
  static_cast<void>(abandoned);
}
TrajectoryWriter::TrajectoryWriter(TrajectoryWriter&&) noexcept = default;

template <int D>
void TrajectoryWriter::append(const Frame<D>& frame, std::span<const double> observables)
{
  auto& my = *impl_;
  assert(D == my.run.box.dimension);
  assert(frame.position.size() == my.run.grains.size());
  assert(frame.force.size() == (my.run.has_force ? my.run.grains.size() : 0));
  assert(observables.size() == my.observables.size());
  my.require_presence(frame);
  my.is_writing = true;
  my.append_arrays(frame, true);
  my.append_arrays(frame, false);
  for (std::size_t k = 0; k < observables.size(); ++k) my.observables[k].append(1, &observables[k]);
  my.step.append(1, &frame.step);
  my.time.append(1, &frame.time);
  my.append_digests(frame, observables);
  if (my.storage.live) my.flush();
  my.contacts_so_far += frame.contacts.size();
  my.offset.append(1, &my.contacts_so_far);
  if (my.storage.live) H5Dflush(my.offset.dataset);
  ++my.frames_so_far;
  my.is_writing = false;
}

template void TrajectoryWriter::append(const Frame<2>&, std::span<const double>);
template void TrajectoryWriter::append(const Frame<3>&, std::span<const double>);

void TrajectoryWriter::flush()
{
  impl_->is_writing = true;
  impl_->flush();
  impl_->is_writing = false;
}

std::size_t TrajectoryWriter::frames() const
{
  return impl_->frames_so_far;
}

std::uint64_t TrajectoryWriter::digest() const
{
  return impl_->digest_so_far;
}

void TrajectoryWriter::add_parameters(const Parameters& parameters)
{
  auto& my = *impl_;
  for (const auto& [name, values] : parameters.numbers) {
    write_parameter(my.file, name, values, my.storage.live);
    my.run.parameters.numbers[name] = values;
  }
  for (const auto& [name, text] : parameters.texts) {
    write_parameter(my.file, name, text);
    my.run.parameters.texts[name] = text;
  }
  const auto digest = static_digest(my.run);
  overwrite(my.file, "/grseg/static_digest", H5T_NATIVE_UINT64, &digest);
}

void TrajectoryWriter::close()
{
  auto& my = *impl_;
  my.is_writing = true;
  my.write_seal();
  my.flush();
  write_parameter(my.file, "complete", {1}, my.storage.live);
  my.flush();
  const std::string path = my.path;
  File file = std::move(my.file);
  impl_ = std::make_unique<Impl>();  // closes every dataset; must precede closing the file
  if (close_file(file.release()) < 0)
    throw RunError(fmt::format("cannot write {}: {}", path, reason_of_failure()));
}

TrajectoryWriter copy_frames(const TrajectoryReader& run, std::size_t frames, const std::string& to,
                             const Parameters& parameters,
                             const std::vector<Observable>& observables,
                             const StorageSettings& storage)
{
  std::vector<std::vector<double>> series;
  series.reserve(observables.size());
  for (const auto& observable : observables) series.push_back(run.observable(observable.name));

  TrajectoryWriter writer(to,
                          {run.grains(), run.box(), parameters, observables, run.has_force(),
                           run.species(), run.grains_come_and_go()},
                          storage);
  std::vector<double> values(observables.size());
  with_dimension(run.dimension(), [&](auto d) {
    Frame<d> frame;
    for (std::size_t k = 0; k < frames; ++k) {
      run.read(k, frame, {.velocity = true, .contacts = true, .force = true});
      for (std::size_t q = 0; q < values.size(); ++q) values[q] = series[q][k];
      writer.append(frame, values);
    }
  });
  return writer;
}

void repack(const std::string& from, const std::string& to, const StorageSettings& storage)
{
  const TrajectoryReader run(from);
  copy_frames(run, run.size(), to, run.parameters(), run.observables(), storage).close();
}

}  // namespace grseg
