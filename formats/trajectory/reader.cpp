// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/trajectory/reader.hpp"

#include "formats/core/errors.hpp"
#include "formats/trajectory/layout.hpp"
#include "formats/trajectory/row_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

namespace grseg {

using namespace hdf5;

namespace {

constexpr TrajectoryReader::Fields whole{.velocity = true, .contacts = true, .force = true};

template <class T>
std::span<const double> numbers_of(const std::vector<T>& values)
{
  return {reinterpret_cast<const double*>(values.data()),
          values.size() * sizeof(T) / sizeof(double)};
}

template <int D>
void check_presence(const StoredRun& run, std::size_t index, const Frame<D>& frame)
{
  for_each_array(frame, [&](Field field, const auto& values) {
    if (!holds_reals(field) || is_of_contacts(field)) return;
    const auto numbers = numbers_of(values);
    const auto each = values.empty() ? 0 : numbers.size() / values.size();
    for (std::size_t g = 0; g < values.size(); ++g) {
      const auto own = numbers.subspan(g * each, each);
      const bool present = is_present(frame, g);
      if (!std::all_of(own.begin(), own.end(),
                       [present](double x) { return present ? std::isfinite(x) : std::isnan(x); }))
        run.fail(fmt::format(
            "{} of grain {} in frame {} is {}; the frame is damaged", row_of(field).path, g, index,
            present ? "not finite" : "not NaN, although the position marks the grain as absent"));
    }
  });
  const auto& contacts = frame.contacts;
  for (std::size_t k = 0; k < contacts.size(); ++k)
    for (const auto g : {contacts.i[k], contacts.j[k]})
      if (g >= 0 && !is_present(frame, static_cast<std::size_t>(g)))
        run.fail(fmt::format("contact {} of frame {} names grain {}, which is absent in this frame",
                             k, index, g));
}

/// Throws FormatError if a number of the frame is not finite (for an absent grain: not NaN), or if
/// a contact names a grain that does not exist or is absent.
template <int D>
void check_frame(const StoredRun& run, std::size_t index, const Frame<D>& frame)
{
  const bool come_and_go = run.description.grains_come_and_go;
  for_each_array(frame, [&](Field field, const auto& values) {
    if (!holds_reals(field) || (come_and_go && !is_of_contacts(field))) return;
    const auto numbers = numbers_of(values);
    const auto wrong =
        std::find_if(numbers.begin(), numbers.end(), [](double x) { return !std::isfinite(x); });
    if (wrong != numbers.end())
      run.fail(fmt::format("{} is not a finite number in frame {}, entry {}; the frame is damaged",
                           row_of(field).path, index, wrong - numbers.begin()));
  });
  const auto& contacts = frame.contacts;
  const auto grain_count = static_cast<std::int64_t>(run.description.grains.size());
  for (std::size_t k = 0; k < contacts.size(); ++k)
    if (contacts.i[k] < 0 || contacts.i[k] >= grain_count || contacts.j[k] >= grain_count ||
        contacts.i[k] == contacts.j[k])
      run.fail(fmt::format("contact {} of frame {} joins grains {} and {}, which is impossible", k,
                           index, contacts.i[k], contacts.j[k]));
  if (come_and_go) check_presence(run, index, frame);
}

/// Settings for a small cache of HDF5 metadata, so that memory does not grow with the number of
/// frames, which are read one after the other.
Properties small_index_cache()
{
  silence();
  Properties access(H5Pcreate(H5P_FILE_ACCESS));
  H5AC_cache_config_t cache{};
  cache.version = H5AC__CURR_CACHE_CONFIG_VERSION;
  H5Pget_mdc_config(access, &cache);
  cache.set_initial_size = true;
  cache.initial_size = cache.min_size = cache.max_size = 131072;  // bytes
  H5Pset_mdc_config(access, &cache);
  return access;
}

/// Name of a field for messages: "/particles/grains/position" for ".../position/value".
std::string name_in_messages(Field field)
{
  if (field == Field::place) return "/particles/grains/position/step, time or its rows of contacts";
  if (field == Field::observables) return "/observables";
  const std::string path = row_of(field).path;
  return path.substr(0, path.find("/value"));
}

std::string changed(Field field, std::size_t index)
{
  return fmt::format(
      "{} of frame {} is not what was written: the file is damaged; use an intact copy, or leave "
      "the frame out with --begin or --end",
      name_in_messages(field), index);
}

/// True if `fields` include the array `array`.
bool include(TrajectoryReader::Fields fields, Field array)
{
  if (is_of_contacts(array)) return fields.contacts;
  if (array == Field::velocity || array == Field::angular_velocity) return fields.velocity;
  return array == Field::position || fields.force;
}

bool matches(const StoredRun& run, std::size_t index, Field field, std::uint64_t digest)
{
  return run.field_digests[index][static_cast<std::size_t>(field)] == digest;
}

/// One sentence about damage outside frames or to Field::place; "" if there is none.
std::string damage_of(const StoredRun& run)
{
  constexpr const char* remedy = "the file is damaged; use an intact copy";
  const auto digest = static_digest(run.description);
  if (digest != run.static_digest)
    return fmt::format(
        "box, grains, species, observables or parameters are not what was written: {}", remedy);
  for (std::size_t k = 0; k < run.size(); ++k) {
    const FramePlace place{run.steps[k], run.times[k], run.offset[k], run.offset[k + 1],
                           run.chain[k]};
    if (!matches(run, k, Field::place, field_digest(k, place))) return changed(Field::place, k);
  }
  if (!run.closed()) return {};
  const auto last = run.chain.empty() ? 0 : run.chain.back();
  const auto seal =
      make_seal(run.size(), run.offset.back(), last, digest, run.description.parameters);
  return seal.numbers() == run.seal
             ? ""
             : fmt::format(
                   "/grseg/seal does not agree with the frames or the summary in the file: {}",
                   remedy);
}

/// The first field of `fields` that does not agree with its digest; empty if all agree.
template <int D>
std::optional<Field> changed_field(const StoredRun& run, bool float32, std::size_t index,
                                   const Frame<D>& frame, TrajectoryReader::Fields fields)
{
  std::optional<Field> found;
  for_each_array(frame, [&](Field field, const auto&) {
    if (!found && include(fields, field) &&
        !matches(run, index, field, field_digest(field, index, frame, float32)))
      found = field;
  });
  return found;
}

}  // namespace

/// The datasets that store frames and contacts; the constructor checks their types and shapes.
struct TrajectoryReader::Datasets {
  Datasets(File its_file, const StoredRun& of_run) : file(std::move(its_file)), run(of_run)
  {
    const auto& description = run.description;
    const LayoutSizes sizes{run.size(), run.offset.back(), description.grains.size(), 0,
                            description.box.dimension};
    for_each_array(Frame<2>(), [&](Field field, const auto&) {
      if (field == Field::force && !description.has_force) return;
      const auto& row = row_of(field);
      const auto shape = shape_of(row.shape, sizes);
      auto dataset = open(row.path, row.type == Number::real ? H5T_FLOAT : H5T_INTEGER,
                          static_cast<int>(shape.size()));
      for (std::size_t axis = 0; axis < shape.size(); ++axis)
        dataset.require(axis, shape[axis], axis == 0);
      rows[static_cast<std::size_t>(field)] = RowReader(std::move(dataset));
    });
  }

  CheckedDataset open(const std::string& at, H5T_class_t kind, int rank) const
  {
    return {file, at, kind, rank, run.path};
  }
  const RowReader& rows_of(Field field) const { return rows[static_cast<std::size_t>(field)]; }

  /// Reads a field of a frame, or of its contacts, as stored. Compressed rows are appended to
  /// `packed`.
  template <class T>
  void load(Field field, std::size_t frame, std::vector<T>& out,
            std::vector<PackedRows>& packed) const
  {
    const auto grains = run.description.grains.size();
    if (!is_of_contacts(field)) {
      out.resize(grains);
      return rows_of(field).load(frame, 1, out.data(), packed);
    }
    const hsize_t begin = run.offset[frame], count = run.offset[frame + 1] - begin;
    if (count > 64 * grains + 1024)
      run.fail(fmt::format(
          "frame {} claims {} contacts for {} grains; /grseg/contacts/offset is damaged", frame,
          count, grains));
    out.resize(count);
    if (count > 0) rows_of(field).load(begin, count, out.data(), packed);
  }

  std::vector<double> observable(const std::string& name) const
  {
    const auto dataset = open("/observables/" + name + "/value", H5T_FLOAT, 1);
    dataset.require(0, run.size(), true);
    std::vector<double> values(run.size());
    dataset.read_rows(H5T_NATIVE_DOUBLE, 0, run.size(), values.data());
    return values;
  }

  std::string damage_of_observables() const
  {
    std::vector<std::vector<double>> all;
    for (const auto& known : run.description.observables) all.push_back(observable(known.name));
    std::vector<double> of_frame(all.size());
    for (std::size_t k = 0; k < run.size(); ++k) {
      for (std::size_t q = 0; q < all.size(); ++q) of_frame[q] = all[q][k];
      if (!matches(run, k, Field::observables, field_digest(k, of_frame)))
        return changed(Field::observables, k);
    }
    return {};
  }

  File file;
  const StoredRun& run;
  std::array<RowReader, number_of_fields> rows;  // index: Field
};

TrajectoryReader::TrajectoryReader(const std::string& path, Verify verify)
try : verify_(verify) {
  auto file = open_for_reading(path, small_index_cache());
  run_ = std::make_unique<StoredRun>(read_stored_run(file, path));
  datasets_ = std::make_unique<Datasets>(std::move(file), *run_);
  if (!closed())  // parameters that are known only at the end have no values yet
    std::erase_if(run_->description.parameters.numbers,
                  [](const auto& number) { return is_known_at_end(number.first); });
  if (verify == Verify::no) return;
  if (const auto damage = damage_of(*run_); !damage.empty()) run_->fail(damage);
} catch (const FormatError&) {
  require_system(path);
  throw;
}

TrajectoryReader::~TrajectoryReader() = default;
TrajectoryReader::TrajectoryReader(TrajectoryReader&&) noexcept = default;

template <int D>
Gravity<D> TrajectoryReader::gravity() const
{
  const auto& numbers = parameters().numbers;
  const auto found = numbers.find("gravity");
  if (found == numbers.end() || found->second.size() != D)
    run_->fail(fmt::format("/parameters/gravity should be {} numbers; see formats/README.md",
                           D == 2 ? "two" : "three"));
  const double rate =
      numbers.count("slope_rate") > 0 ? parameters().number("slope_rate", path()) : 0;
  return {Vector<D>(found->second.data()), rate * std::numbers::pi / 180};
}

template <int D>
TrajectoryReader::Packed TrajectoryReader::load(std::size_t index, Frame<D>& frame,
                                                Fields fields) const
{
  if (D != dimension())
    run_->fail(fmt::format("is a run in {} dimensions, which this program does not read",
                           dimension() == 2 ? "two" : "three"));
  Packed packed{index, fields, {}};
  frame.step = steps().at(index);
  frame.time = times()[index];
  frame.part = 0;
  if (fields.force && has_observable("frame_step")) {
    if (parts_.empty()) parts_ = observable("frame_step");
    frame.part = parts_.at(index);
  }
  for_each_array(frame, [&](Field field, auto& values) {
    if (include(fields, field) && (field != Field::force || has_force()))
      datasets_->load(field, index, values, packed.rows);
    else
      values.clear();
  });
  return packed;
}

template <int D>
void TrajectoryReader::unpack(const Packed& packed, Frame<D>& frame) const
{
  for (const auto& rows : packed.rows) rows.unpack();
  check_frame(*run_, packed.index, frame);
  if (verify_ == Verify::no) return;
  if (const auto field = changed_field(*run_, stores_float32(), packed.index, frame, packed.fields))
    run_->fail(changed(*field, packed.index));
}

bool TrajectoryReader::has_images() const
{
  const auto& told = parameters();
  return !(box().periodic_x || box().periodic_z) || told.text("import_format").empty() ||
         told.text("import_images") == "known";
}

bool TrajectoryReader::has_observable(const std::string& name) const
{
  const auto& all = observables();
  return std::any_of(all.begin(), all.end(), [&](const auto& known) { return known.name == name; });
}

std::vector<double> TrajectoryReader::observable(const std::string& name) const
{
  if (verify_ == Verify::yes && !observables_verified_) {
    if (const auto damage = datasets_->damage_of_observables(); !damage.empty()) run_->fail(damage);
    observables_verified_ = true;
  }
  return datasets_->observable(name);
}

bool TrajectoryReader::stores_float32() const
{
  return datasets_->rows_of(Field::position).stores_float32();
}

std::string TrajectoryReader::damage_outside_frames() const
{
  const auto damage = damage_of(*run_);
  return damage.empty() ? datasets_->damage_of_observables() : damage;
}

template <int D>
bool TrajectoryReader::is_intact(std::size_t index, const Frame<D>& frame) const
{
  const auto before = index == 0 ? 0 : digests()[index - 1];
  return frame_digest(frame, before, stores_float32()) == digests()[index] &&
         !changed_field(*run_, stores_float32(), index, frame, whole);
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
