// SPDX-License-Identifier: GPL-3.0-or-later
// Imports an archive of another program frame by frame, without writing a file. The parts of an
// input: words of the command line, grains, contacts, restart file; of LMGC90 also BULK_BEHAV.DAT and
// DRV_DOF.DAT.
#include "formats/core/frame.hpp"
#include "formats/import/convert/verified_frames.hpp"
#include "formats/import/facts/import_settings.hpp"
#include "tests/fuzz/fuzz.hpp"

#include <array>
#include <map>
#include <sstream>

namespace {

using namespace grseg;
namespace po = boost::program_options;

ImportSettings settings_of(std::string_view words)
{
  ImportSettings settings;
  std::istringstream line{std::string(words)};
  std::vector<std::string> arguments;
  for (std::string word; line >> word;) arguments.push_back(word);
  po::variables_map values;
  po::store(po::command_line_parser(arguments).options(import_options(settings)).run(), values);
  po::notify(values);
  return settings;
}

void require_a_whole_frame(const Frame<3>& frame, const Grains& grains)
{
  const auto n = grains.size(), contacts = frame.contacts.size();
  fuzz::require(frame.position.size() == n && frame.velocity.size() == n, "a row for each grain");
  fuzz::require(frame.contacts.j.size() == contacts && frame.contacts.force.size() == contacts &&
                    frame.contacts.branch.size() == contacts,
                "a row for each contact");
  for (std::size_t c = 0; c < contacts; ++c) {
    const auto i = frame.contacts.i[c], j = frame.contacts.j[c];
    fuzz::require(i >= 0 && i < static_cast<int>(n) && j < static_cast<int>(n), "i and j are rows");
    fuzz::require(frame.contacts.force[c].allFinite(), "forces are finite");
  }
}

/// Settings of the import, from a cache, because most inputs have the same words.
const ImportSettings& known_settings(std::string_view words)
{
  static std::map<std::string, ImportSettings, std::less<>> known;
  if (known.size() > 1000) known.clear();
  const auto found = known.find(words);
  return found != known.end() ? found->second
                              : known.emplace(words, settings_of(words)).first->second;
}

void import(const std::vector<std::string_view>& parts)
{
  // The names are those by which LMGC90's files are found beside others.
  static std::array<fuzz::ScratchFile, 5> files{
      fuzz::ScratchFile("DOF"), fuzz::ScratchFile("Vloc_Rloc"), fuzz::ScratchFile("BODIES.DAT"),
      fuzz::ScratchFile("BULK_BEHAV.DAT"), fuzz::ScratchFile("DRV_DOF.DAT")};
  auto settings = known_settings(parts[0]);
  settings.format = FUZZED_FORMAT;
  for (std::size_t k = 0; k < files.size(); ++k)
    files[k].write(k + 1 < parts.size() ? parts[k + 1] : "");
  settings.files.grains = {files[0].path()};
  if (parts.size() > 2 && settings.format != "lmgc90") settings.files.contacts = {files[1].path()};
  if (parts.size() > 3) settings.files.restart = files[2].path();
  VerifiedFrames frames(ScannedArchive(settings), settings);
  for (Frame<3> frame; frames.next(frame);)
    if (!frames.complaint()) require_a_whole_frame(frame, frames.bed().grains);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const auto parts = fuzz::parts_of(fuzz::text_of(data, size));
  fuzz::try_to([&] {
    try {
      import(parts);
    } catch (const po::error&) {  // run_tool refuses the command line
    }
  });
  return 0;
}
