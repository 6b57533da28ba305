// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/common/text_source.hpp"

#include "formats/cli/interruption.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/files.hpp"

#include <boost/iostreams/device/file.hpp>
#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filter/zstd.hpp>
#include <boost/iostreams/filtering_streambuf.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>

namespace grseg {
namespace {

namespace io = boost::iostreams;

constexpr std::size_t buffer_size = 1 << 20;
constexpr std::streamsize filter_buffer = 1 << 16;

enum class Packing { none, gzip, zstd };

Packing packing_of(const std::string& file)
{
  std::array<char, 4> head{};
  std::ifstream(file, std::ios::binary).read(head.data(), head.size());
  const std::string_view bytes(head.data(), head.size());
  if (bytes.starts_with("\x1f\x8b")) return Packing::gzip;
  if (bytes == "\x28\xb5\x2f\xfd") return Packing::zstd;
  return Packing::none;
}

}  // namespace

struct TextSource::Impl {
  std::vector<std::string> files;
  std::size_t opened = 0;  // files
  std::unique_ptr<io::filtering_streambuf<io::input>> stream;
  // Memory that a small file does not fill is never touched.
  std::unique_ptr<char[]> buffer = std::make_unique_for_overwrite<char[]>(buffer_size);
  std::size_t begin = 0, end = 0;  // of what is not yet handed out
  std::string_view line;
  std::size_t number = 0;
  bool whole = true;

  const std::string& file() const { return files[opened - 1]; }
  void open_next();
  std::size_t read_more();
  bool take_line();
};

void TextSource::Impl::open_next()
{
  ++opened;
  number = 0;
  require_file(file());
  stream = std::make_unique<io::filtering_streambuf<io::input>>();
  const auto packing = packing_of(file());
  if (packing == Packing::gzip)
    stream->push(io::gzip_decompressor(io::gzip::default_window_bits, filter_buffer),
                 filter_buffer);
  if (packing == Packing::zstd) stream->push(io::zstd_decompressor(filter_buffer), filter_buffer);
  stream->push(io::file_source(file(), std::ios::binary), filter_buffer);
}

/// Fills the buffer behind what is left in it; 0 at the end of the file.
std::size_t TextSource::Impl::read_more()
{
  stop_if_interrupted();
  std::memmove(buffer.get(), buffer.get() + begin, end - begin);
  end -= begin;
  begin = 0;
  if (end == buffer_size)
    throw FormatError(fmt::format("{}, line {}: is longer than a megabyte; is this a text archive?",
                                  file(), number + 1));
  std::streamsize count = 0;
  try {
    count = stream->sgetn(buffer.get() + end, static_cast<std::streamsize>(buffer_size - end));
  } catch (const std::exception& error) {
    throw FormatError(fmt::format(
        "{}, after line {}: the compressed data is damaged or truncated ({}); copy the file again",
        file(), number, error.what()));
  }
  end += static_cast<std::size_t>(count);
  return static_cast<std::size_t>(count);
}

/// The next line of the file that is open; false where there is none.
bool TextSource::Impl::take_line()
{
  std::size_t searched = 0;
  for (;;) {
    const char* from = buffer.get() + begin;
    const auto* stop =
        static_cast<const char*>(std::memchr(from + searched, '\n', end - begin - searched));
    if (stop != nullptr) {
      line = {from, static_cast<std::size_t>(stop - from)};
      begin += line.size() + 1;
      whole = true;
      break;
    }
    searched = end - begin;
    if (read_more() > 0) continue;
    if (begin == end) return false;
    line = {buffer.get() + begin, end - begin};
    begin = end;
    whole = false;
    break;
  }
  if (line.ends_with('\r')) line.remove_suffix(1);
  ++number;
  return true;
}

TextSource::TextSource(std::vector<std::string> files) : impl_(std::make_unique<Impl>())
{
  impl_->files = std::move(files);
}

TextSource::~TextSource() = default;
TextSource::TextSource(TextSource&&) noexcept = default;

bool TextSource::next()
{
  auto& my = *impl_;
  while (my.stream == nullptr || !my.take_line()) {
    if (my.opened == my.files.size()) return false;
    my.open_next();
  }
  return true;
}

std::string_view TextSource::line() const
{
  return impl_->line;
}

bool TextSource::line_is_whole() const
{
  return impl_->whole;
}

std::string TextSource::place() const
{
  return fmt::format("{}, line {}", impl_->file(), impl_->number);
}

std::vector<std::string_view> words_of(std::string_view line)
{
  constexpr std::string_view blanks = " \t";
  std::vector<std::string_view> words;
  for (auto begin = line.find_first_not_of(blanks); begin != std::string_view::npos;) {
    const auto end = std::min(line.find_first_of(blanks, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(blanks, end);
  }
  return words;
}

std::string in_quotes(std::string_view text)
{
  constexpr std::size_t most = 40;
  std::string shown = "'";
  for (const char c : text.substr(0, most)) shown += c >= ' ' && c <= '~' ? c : '?';
  return shown + (text.size() > most ? "...'" : "'");
}

}  // namespace grseg
