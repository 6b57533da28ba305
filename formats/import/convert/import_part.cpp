// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/convert/import_part.hpp"

#include "formats/core/errors.hpp"
#include "formats/import/common/text_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <filesystem>
#include <limits>

namespace grseg {
namespace {

constexpr const char* place_name = "import_part";

std::string remedy(const OutputPart& part)
{
  return fmt::format("write it with this command and --part {} in place of --join", part.text());
}

std::string existing(const std::string& output, const OutputPart& part)
{
  auto path = part.path(output, std::filesystem::path(output).extension().string());
  std::error_code error;
  if (!std::filesystem::exists(path, error))
    throw UsageError(fmt::format("{} is missing; {}", path, remedy(part)));
  return path;
}

}  // namespace

std::vector<Observable> import_observables(bool of_part)
{
  auto all = check_observables();
  all.insert(all.begin(), {"momentum_defect", ""});
  if (of_part)
    all.insert(all.end(), {{"part_residual_median", ""},
                           {"part_residual_unexplained", ""},
                           {"part_late_normal", ""},
                           {"part_late_tangential", ""}});
  return all;
}

/// The additional values of a part are NaN if there is no residual, or no late damping.
std::vector<double> import_values(const FrameRecord& record, bool of_part)
{
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const auto& residual = record.residual;
  const bool late = residual && residual->late;
  auto values = check_values(record.numbers);
  values.insert(values.begin(), residual ? residual->largest : 0);
  if (of_part)
    values.insert(values.end(),
                  {residual ? residual->median : none, residual ? residual->unexplained : none,
                   late ? residual->late->normal : none, late ? residual->late->tangential : none});
  return values;
}

Parameters PartPlace::parameters(const ImportReport& report) const
{
  Parameters all;
  const auto number = [](std::size_t n) { return static_cast<double>(n); };
  all.numbers[place_name] = {number(part.number), number(part.count), number(begin), number(end),
                             number(frames)};
  all.texts["import_part_columns"] = report.parameters.text("import_columns");
  all.texts["import_part_remarks"] = fmt::format("{}", fmt::join(report.remarks, "\n"));
  return all;
}

ImportPart::ImportPart(const std::string& output, const OutputPart& part)
    : run_(existing(output, part))
{
  const auto& parameters = run_.parameters();
  const auto found = parameters.numbers.find(place_name);
  if (found == parameters.numbers.end() || found->second.size() != 5)
    fail("is not a part of an import");
  const auto whole = [&](std::size_t k) {
    const double value = found->second[k];
    if (!(value >= 0 && value < 1e15) || value != std::floor(value)) fail("is damaged");
    return static_cast<std::size_t>(value);
  };
  place_ = {{whole(0), whole(1)}, whole(2), whole(3), whole(4)};
  if (place_.part.number != part.number || place_.part.count != part.count)
    fail(fmt::format("is part {}, not {}", place_.part.text(), part.text()));
  if (!run_.closed() || place_.end < place_.begin || run_.size() != place_.end - place_.begin)
    fail("does not contain all its frames");
  for (const auto& observable : import_observables(true)) {
    if (!run_.has_observable(observable.name)) fail("is not a part of an import by this program");
    values_.push_back(run_.observable(observable.name));
  }
}

FrameRecord ImportPart::record(std::size_t frame) const
{
  std::vector<double> values;
  for (const auto& of_all : values_) values.push_back(of_all[frame]);
  const std::size_t checks = check_observables().size();
  FrameRecord record;
  record.numbers.step = run_.steps()[frame];
  record.numbers.time = run_.times()[frame];
  set_check_values(record.numbers,
                   {values.begin() + 1, values.begin() + 1 + static_cast<std::ptrdiff_t>(checks)});
  const double* more = values.data() + 1 + checks;
  if (std::isnan(more[0])) return record;
  record.residual = Residual{values[0], more[0], 0, more[1], more[1], {}};
  if (!std::isnan(more[2])) record.residual->late = LateDamping{more[2], more[3]};
  return record;
}

void ImportPart::add_to(ImportReport& report) const
{
  const auto& parameters = run_.parameters();
  report.parameters.texts["import_columns"] = parameters.text("import_part_columns");
  report.remarks = parts_of(parameters.text("import_part_remarks"), '\n');
}

RunDescription ImportPart::description() const
{
  RunDescription run{
      run_.grains(),    run_.box(),     run_.parameters(),        import_observables(false),
      run_.has_force(), run_.species(), run_.grains_come_and_go()};
  const auto is_of_part = [](const auto& parameter) {
    return parameter.first.starts_with(place_name) || parameter.first == "complete";
  };
  std::erase_if(run.parameters.numbers, is_of_part);
  std::erase_if(run.parameters.texts, is_of_part);
  return run;
}

void ImportPart::fail(const std::string& why) const
{
  throw FormatError(fmt::format("{}: {}; {}", run_.path(), why, remedy(place_.part)));
}

}  // namespace grseg
