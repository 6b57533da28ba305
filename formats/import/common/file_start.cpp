// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/common/file_start.hpp"

#include "formats/core/errors.hpp"
#include "formats/core/files.hpp"
#include "formats/import/common/apart.hpp"
#include "formats/import/common/packing.hpp"
#include "formats/import/common/text_source.hpp"
#include "formats/trajectory/hdf5.hpp"

#include <filesystem>

namespace grseg {
namespace {

std::vector<std::string> names_in_root(const std::string& path)
{
  Apart apart(path, [&](const Apart::Send& send) {
    auto names = hdf5::names_in(hdf5::open_for_reading(path), "/");
    packing::Pack pack;
    pack(names);
    send(pack.bytes);
  });
  std::vector<std::string> names;
  packing::Unpack unpack(apart.receive(path));
  unpack(names);
  return names;
}

}  // namespace

FileStart read_start(const std::string& path)
{
  require_file(path);
  FileStart start{std::filesystem::path(path).filename().string(), {}, {}};
  if (H5Fis_hdf5(path.c_str()) > 0) {
    start.groups = names_in_root(path);
    return start;
  }
  constexpr std::size_t most = 20;
  try {
    TextSource text({path});
    while (start.lines.size() < most && text.next()) start.lines.emplace_back(text.line());
    constexpr std::string_view mark = "\xef\xbb\xbf";  // of UTF-8
    if (!start.lines.empty() && start.lines[0].starts_with(mark))
      start.lines[0].erase(0, mark.size());
  } catch (const FormatError&) {  // not a text, or damaged: told when it is read
  }
  return start;
}

}  // namespace grseg
