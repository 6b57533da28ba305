// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/common/text_source.hpp"

#include "formats/cli/interruption.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/files.hpp"
#include "formats/core/text.hpp"
#include "formats/import/common/archive_files.hpp"

#include <boost/iostreams/device/file.hpp>
#include <boost/iostreams/filter/bzip2.hpp>
#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filter/lzma.hpp>
#include <boost/iostreams/filter/symmetric.hpp>
#include <boost/iostreams/filtering_streambuf.hpp>
#include <fmt/format.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <memory>
#include <span>
#include <stdexcept>

namespace grseg {

/// Unpacks zstd as a filter of Boost.Iostreams (a model of its SymmetricFilter). Boost's own one is
/// silent about a stream that ends early.
class ZstdDecoder {
 public:
  using char_type = char;

  /// Unpacks what fits; false at the end of the data. std::runtime_error where they are damaged or end
  /// early.
  bool filter(const char*& from, const char* from_end, char*& to, char* to_end, bool is_all)
  {
    ZSTD_inBuffer in{from, static_cast<std::size_t>(from_end - from), 0};
    ZSTD_outBuffer out{to, static_cast<std::size_t>(to_end - to), 0};
    while (out.pos < out.size && (in.pos < in.size || (is_all && in_frame_))) {
      const auto before = in.pos + out.pos;
      const auto left = ZSTD_decompressStream(stream_.get(), &out, &in);
      if (ZSTD_isError(left) != 0) throw std::runtime_error(ZSTD_getErrorName(left));
      in_frame_ = left != 0;
      if (in_frame_ && in.pos + out.pos == before) throw std::runtime_error("it ends early");
    }
    from += in.pos;
    to += out.pos;
    return !is_all || in_frame_ || in.pos < in.size;
  }
  void close() {}

 private:
  struct Free {
    void operator()(ZSTD_DStream* stream) const { ZSTD_freeDStream(stream); }
  };
  std::unique_ptr<ZSTD_DStream, Free> stream_{ZSTD_createDStream()};
  bool in_frame_ = false;  // data of a frame are still to come
};

namespace {

namespace io = boost::iostreams;

constexpr std::size_t buffer_size = 1 << 20;
constexpr std::streamsize filter_buffer = 1 << 16;

using Stream = io::filtering_streambuf<io::input>;

/// Pushes the filter that unpacks `file`, if its first bytes say that it is packed. (zstd may begin with
/// a frame to be skipped.)
void push_unpacking(const std::string& file, Stream& stream)
{
  std::array<char, 6> head{};
  std::ifstream(file, std::ios::binary).read(head.data(), head.size());
  const std::string_view bytes(head.data(), head.size());
  if (bytes.starts_with("\x1f\x8b"))
    stream.push(io::gzip_decompressor(io::gzip::default_window_bits, filter_buffer), filter_buffer);
  else if (bytes.starts_with("BZh") && bytes[3] >= '1' && bytes[3] <= '9')
    stream.push(io::bzip2_decompressor(false, filter_buffer), filter_buffer);
  else if (bytes == std::string_view("\xfd\x37zXZ\0", 6))
    stream.push(io::lzma_decompressor(filter_buffer), filter_buffer);
  else if (bytes.starts_with("\x28\xb5\x2f\xfd") || bytes.substr(1, 3) == "\x2a\x4d\x18")
    stream.push(io::symmetric_filter<ZstdDecoder>(filter_buffer), filter_buffer);
}

std::unique_ptr<Stream> open_unpacked(const std::string& file)
{
  require_file(file);
  auto stream = std::make_unique<Stream>();
  push_unpacking(file, *stream);
  stream->push(io::file_source(file, std::ios::binary), filter_buffer);
  return stream;
}

/// Fills `to` as far as the file goes. FormatError where its packed data are damaged or end early.
std::size_t read_from(Stream& stream, std::span<char> to, const std::string& file,
                      std::size_t lines_before)
{
  try {
    return static_cast<std::size_t>(stream.sgetn(to.data(), std::ssize(to)));
  } catch (const std::exception& error) {
    throw FormatError(fmt::format(
        "{}, after line {}: the compressed data is damaged or truncated ({}); copy the file again",
        file, lines_before, error.what()));
  }
}

}  // namespace

struct TextSource::Impl {
  std::vector<std::string> files;
  std::size_t opened = 0;  // files
  std::unique_ptr<Stream> stream;
  // Memory that a small file does not fill is never touched.
  std::unique_ptr<char[]> buffer = std::make_unique_for_overwrite<char[]>(buffer_size);
  std::size_t begin = 0, end = 0;  // of what is not yet handed out
  std::string_view line;
  std::size_t number = 0;
  bool whole = true;

  const std::string& file() const { return files[opened - 1]; }
  void open_next();
  void read_start();
  std::size_t read_more();
  bool take_line();
};

void TextSource::Impl::open_next()
{
  ++opened;
  number = 0;
  stream = open_unpacked(file());
  read_start();
}

/// A byte-order mark is passed over. FormatError where the file is of a kind that is no text archive.
void TextSource::Impl::read_start()
{
  constexpr std::size_t enough = 4096;
  read_more();
  const std::string_view start(buffer.get(), std::min(end, enough));
  if (start.starts_with(byte_order_mark)) begin = byte_order_mark.size();
  if (const auto kind = other_kind(start); !kind.empty())
    throw FormatError(fmt::format("{} {}", file(), kind));
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
  const auto count = read_from(*stream, {buffer.get() + end, buffer_size - end}, file(), number);
  end += count;
  return count;
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

const std::string& TextSource::file() const
{
  return impl_->file();
}

std::string TextSource::place() const
{
  return fmt::format("{}, line {}", impl_->file(), impl_->number);
}

std::string unpacked_start(const std::string& file, std::size_t bytes)
{
  const auto stream = open_unpacked(file);
  std::string start(bytes, '\0');
  start.resize(read_from(*stream, start, file, 0));
  return start;
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
