// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/trajectory/layout.hpp"
#include "formats/trajectory/stored_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace grseg {
namespace {

bool is_finite(double value)
{
  return std::isfinite(value);
}
bool is_nan(double value)
{
  return std::isnan(value);
}

template <class T>
std::span<const double> numbers_of(const std::vector<T>& values)
{
  return {reinterpret_cast<const double*>(values.data()),
          values.size() * sizeof(T) / sizeof(double)};
}

void check_finite(const StoredRun& run, std::size_t index, Field field,
                  std::span<const double> numbers)
{
  const auto wrong = std::find_if_not(numbers.begin(), numbers.end(), is_finite);
  if (wrong != numbers.end())
    run.fail(fmt::format("{} is not a finite number in frame {}, entry {}; the frame is damaged",
                         row_of(field).path, index, wrong - numbers.begin()));
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
      if (!std::all_of(own.begin(), own.end(), present ? is_finite : is_nan))
        run.fail(fmt::format(
            "{} of grain {} in frame {} is {}; the frame is damaged", row_of(field).path, g, index,
            present ? "not finite"
                    : "not NaN throughout, though its position says that it is absent"));
    }
  });
  const auto& contacts = frame.contacts;
  for (std::size_t k = 0; k < contacts.size(); ++k)
    for (const auto g : {contacts.i[k], contacts.j[k]})
      if (g >= 0 && !is_present(frame, static_cast<std::size_t>(g)))
        run.fail(fmt::format("contact {} of frame {} names grain {}, which is absent there", k,
                             index, g));
}

}  // namespace

template <int D>
void check_frame(const StoredRun& run, std::size_t index, const Frame<D>& frame)
{
  const bool come_and_go = run.description.grains_come_and_go;
  for_each_array(frame, [&](Field field, const auto& values) {
    if (holds_reals(field) && (is_of_contacts(field) || !come_and_go))
      check_finite(run, index, field, numbers_of(values));
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

template void check_frame(const StoredRun&, std::size_t, const Frame<2>&);
template void check_frame(const StoredRun&, std::size_t, const Frame<3>&);

}  // namespace grseg
