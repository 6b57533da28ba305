// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/common/file_start.hpp"

#include "formats/core/errors.hpp"
#include "formats/core/files.hpp"
#include "formats/import/common/apart.hpp"
#include "formats/import/common/file_kind.hpp"
#include "formats/import/common/packing.hpp"
#include "formats/import/common/text_source.hpp"
#include "formats/trajectory/hdf5.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace grseg {
namespace {

struct Hdf5Start {
  std::vector<std::string> groups;  // names in the root
  bool of_grseg = false;
};

Hdf5Start start_of_hdf5(const std::string& path)
{
  Apart apart(path, [&](const Apart::Send& send) {
    const auto file = hdf5::open_for_reading(path);
    Hdf5Start start{hdf5::names_in(file, "/"), hdf5::exists(file, "/h5md/modules/grseg")};
    packing::Pack pack;
    pack(start.groups, start.of_grseg);
    send(pack.bytes);
  });
  Hdf5Start start;
  packing::Unpack unpack(apart.receive(path));
  unpack(start.groups, start.of_grseg);
  return start;
}

}  // namespace

void refuse_other_kind(const std::string& path)
{
  constexpr std::size_t enough = 4096;
  require_file(path);
  std::string kind;
  if (hdf5::is_hdf5(path)) {
    const auto start = start_of_hdf5(path);
    if (start.of_grseg)
      throw UsageError(fmt::format(
          "{} is a trajectory of grseg already; grseg-stress and the other tools read it as it is",
          path));
    kind = other_kind_of_hdf5(start.groups);
  } else {
    kind = other_kind(unpacked_start(path, enough));
  }
  if (!kind.empty()) throw FormatError(fmt::format("{} {}", path, kind));
}

FileStart read_start(const std::string& path)
{
  refuse_other_kind(path);
  FileStart start{std::filesystem::path(path).filename().string(), {}, {}};
  if (hdf5::is_hdf5(path)) {
    start.groups = start_of_hdf5(path).groups;
    return start;
  }
  constexpr std::size_t most = 20;
  TextSource text({path});
  while (start.lines.size() < most && text.next()) start.lines.emplace_back(text.line());
  return start;
}

}  // namespace grseg
