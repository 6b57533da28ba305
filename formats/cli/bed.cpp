// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/bed.hpp"

#include <boost/crc.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <set>
#include <sstream>
#include <string_view>

namespace grseg {
namespace {

// crc32, because Python's standard library has it, too (grseg.py).
std::string text_of(const boost::crc_32_type& crc)
{
  return fmt::format("{:08x}", crc.checksum());
}

template <class T>
void add(boost::crc_32_type& crc, const std::vector<T>& values)
{
  crc.process_bytes(values.data(), values.size() * sizeof(T));
}

/// Scene keys and restart options that do not affect the motion: length of the run, and what is
/// stored, how and where.
constexpr std::string_view of_no_effect[] = {
    "duration", "frame-interval",   "burst",  "keep-deposition", "compression",
    "store",    "threads",          "isa",    "restart",         "checkpoint",
    "output",   "checkpoint-every", "strict", "overwrite",       "quiet"};

/// The lines "key = value" of a scene that affect the motion.
std::string acting_lines(const std::string& scene)
{
  std::istringstream lines(scene);
  std::string acting;
  for (std::string line; std::getline(lines, line);)
    if (acts_on_motion(line.substr(0, line.find(' ')))) acting += line + '\n';
  return acting;
}

/// The options of a restart that affect the motion, with their values and start time.
std::string acting_options(const std::string& command)
{
  std::istringstream words(command);
  std::string acting;
  bool takes = false;  // true after an option that affects the motion: the next word is its value
  for (std::string word; words >> word;) {
    const bool option = word.starts_with("--");
    if (option) takes = acts_on_motion(std::string_view(word).substr(2, word.find('=') - 2));
    if (takes) acting += word + ' ';
    if (!option) takes = false;
  }
  const auto since = std::min(command.find(" (from t = "), command.size());
  return acting.empty() ? "" : acting + command.substr(since) + '\n';
}

std::string flow_of(const Parameters& parameters)
{
  const auto scene = parameters.text("scene");
  if (scene.empty()) return "";
  auto acting = acting_lines(scene);
  std::istringstream history(parameters.text("history"));
  for (std::string line; std::getline(history, line);)
    if (line.find(" --restart") != std::string::npos) acting += acting_options(line);
  boost::crc_32_type crc;
  crc.process_bytes(acting.data(), acting.size());
  return text_of(crc);
}

}  // namespace

bool acts_on_motion(std::string_view key)
{
  return std::find(std::begin(of_no_effect), std::end(of_no_effect), key) == std::end(of_no_effect);
}

std::string Bed::text() const
{
  auto text = grains;
  if (come_and_go) text += ", come and go";
  if (!seed.empty()) text += ", seed " + seed;
  if (!flow.empty()) text += ", flow " + flow;
  return text;
}

Bed bed_of(const TrajectoryReader& run)
{
  const auto& radius = run.grains().radius;
  const auto sizes = std::set(radius.begin(), radius.end()).size();
  boost::crc_32_type crc;
  add(crc, radius);
  add(crc, run.grains().id);
  Bed bed;
  bed.grains = fmt::format("grains {}, sizes {}, crc32 {}", radius.size(), sizes, text_of(crc));
  bed.varied = 2 * sizes > radius.size();
  bed.come_and_go = run.grains_come_and_go();
  if (const auto seed = run.parameters().find_number("seed"))
    bed.seed = fmt::format("{:.17g}", *seed);
  bed.flow = flow_of(run.parameters());
  return bed;
}

std::optional<Bed> parse_bed(const std::string& text)
{
  std::vector<std::string> parts;
  std::istringstream all(text);
  for (std::string part; std::getline(all, part, ',');) parts.push_back(part);
  std::size_t grains = 0, sizes = 0;
  if (parts.size() < 3 || std::sscanf(parts[0].c_str(), "grains %zu", &grains) != 1 ||
      std::sscanf(parts[1].c_str(), " sizes %zu", &sizes) != 1)
    return {};
  Bed bed;
  bed.grains = fmt::format("{},{},{}", parts[0], parts[1], parts[2]);
  bed.varied = 2 * sizes > grains;
  for (const auto& part : parts) {
    if (part == " come and go") bed.come_and_go = true;
    if (part.starts_with(" seed ")) bed.seed = part.substr(6);
    if (part.starts_with(" flow ")) bed.flow = part.substr(6);
  }
  return bed;
}

}  // namespace grseg
