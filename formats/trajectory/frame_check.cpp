// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/trajectory/stored_run.hpp"

#include <fmt/format.h>

#include <cmath>

namespace grseg {
namespace {

bool is_finite(double value)
{
  return std::isfinite(value);
}
template <int D>
bool is_finite(const Vector<D>& value)
{
  return value.allFinite();
}

bool is_nan(double value)
{
  return std::isnan(value);
}
template <int D>
bool is_nan(const Vector<D>& value)
{
  return value.array().isNaN().all();
}

/// Calls `check` with the path of each field of grains that has real numbers, and its values.
template <int D, class Check>
void for_each_field(const Frame<D>& frame, const Check& check)
{
  check("/particles/grains/position/value", frame.position);
  check("/particles/grains/velocity/value", frame.velocity);
  check("/particles/grains/angular_velocity/value", frame.angular_velocity);
  check("/particles/grains/force/value", frame.force);
}

template <class T>
void check_finite(const StoredRun& run, std::size_t index, const char* path,
                  const std::vector<T>& values)
{
  const auto* numbers = reinterpret_cast<const double*>(values.data());
  for (std::size_t k = 0; k < values.size() * sizeof(T) / sizeof(double); ++k)
    if (!std::isfinite(numbers[k]))
      run.fail(fmt::format("{} is not a finite number in frame {}, entry {}; the frame is damaged",
                           path, index, k));
}

template <int D>
void check_presence(const StoredRun& run, std::size_t index, const Frame<D>& frame)
{
  for_each_field(frame, [&](const char* path, const auto& values) {
    for (std::size_t g = 0; g < values.size(); ++g)
      if (is_present(frame, g) ? !is_finite(values[g]) : !is_nan(values[g]))
        run.fail(
            fmt::format("{} of grain {} in frame {} is {}; the frame is damaged", path, g, index,
                        is_present(frame, g)
                            ? "not finite"
                            : "not NaN throughout, though its position says that it is absent"));
  });
  const auto& contacts = frame.contacts;
  for (std::size_t k = 0; k < contacts.size(); ++k)
    for (const auto g : {contacts.i[k], contacts.j[k]})
      if (g >= 0 && !is_present(frame, static_cast<std::size_t>(g)))
        run.fail(fmt::format("contact {} of frame {} names grain {}, which is absent there", k,
                             index, g));
}

template <int D>
void check_contacts(const StoredRun& run, std::size_t index, const ContactList<D>& contacts)
{
  const auto grain_count = static_cast<std::int64_t>(run.description.grains.size());
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    if (contacts.i[k] < 0 || contacts.i[k] >= grain_count || contacts.j[k] >= grain_count ||
        contacts.i[k] == contacts.j[k])
      run.fail(fmt::format("contact {} of frame {} joins grains {} and {}, which is impossible", k,
                           index, contacts.i[k], contacts.j[k]));
  }
}

}  // namespace

template <int D>
void check_frame(const StoredRun& run, std::size_t index, const Frame<D>& frame)
{
  if (!run.description.grains_come_and_go)
    for_each_field(frame, [&](const char* path, const auto& values) {
      check_finite(run, index, path, values);
    });
  check_finite(run, index, "/grseg/contacts/force", frame.contacts.force);
  check_finite(run, index, "/grseg/contacts/branch", frame.contacts.branch);
  check_finite(run, index, "/grseg/contacts/gap", frame.contacts.gap);
  check_contacts(run, index, frame.contacts);
  if (run.description.grains_come_and_go) check_presence(run, index, frame);
}

template void check_frame(const StoredRun&, std::size_t, const Frame<2>&);
template void check_frame(const StoredRun&, std::size_t, const Frame<3>&);

}  // namespace grseg
