// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/common/text_source.hpp"

#include "formats/cli/interruption.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/files.hpp"
#include "formats/core/text.hpp"
#include "formats/import/common/archive.hpp"

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
#include <cerrno>
#include <cstring>
#include <fstream>
#include <span>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace grseg {

/// Decompresses zstd, as a filter of Boost.Iostreams (a model of its SymmetricFilter). Boost's own
/// filter does not report a stream that ends early.
class ZstdDecoder {
 public:
  using char_type = char;

  /// Decompresses as much as fits into `to`; false at the end of the data. Throws
  /// std::runtime_error if the data are damaged or end early.
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
  bool in_frame_ = false;  // true: the current frame of zstd is not complete
};

namespace {

namespace io = boost::iostreams;

constexpr std::size_t buffer_size = 1 << 20;
constexpr std::streamsize filter_buffer = 1 << 16;

using Stream = io::filtering_streambuf<io::input>;

/// Pushes the filter that decompresses `file`, if its first bytes show that it is compressed. (A
/// zstd file may begin with a skippable frame.)
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
  require_seekable(file);
  auto stream = std::make_unique<Stream>();
  push_unpacking(file, *stream);
  const io::file_source source(file, std::ios::binary);
  if (!source.is_open()) throw RunError(file + ": cannot be opened: " + reason(errno));
  stream->push(source, filter_buffer);
  return stream;
}

/// Fills `to`, or the first part of it if the file is shorter; returns the number of bytes. Throws
/// FormatError if compressed data are damaged or truncated.
std::size_t read_from(std::streambuf& stream, std::span<char> to, const std::string& file,
                      std::size_t lines_before)
{
  try {
    return static_cast<std::size_t>(stream.sgetn(to.data(), std::ssize(to)));
  } catch (const std::exception& error) {
    const auto* system = dynamic_cast<const std::system_error*>(&error);
    if (system != nullptr && system->code().category() != std::iostream_category())
      throw RunError(fmt::format("{}: cannot be read: {}", file, reason(system->code().value())));
    throw FormatError(fmt::format(
        "{}, after line {}: the compressed data is damaged or truncated ({}); copy the file again",
        file, lines_before, error.what()));
  }
}

}  // namespace

TextSource::TextSource(std::vector<std::string> files)
    : files_(std::move(files)), buffer_(std::make_unique_for_overwrite<char[]>(buffer_size))
{
}

/// Reads the start of a file, skips its byte-order mark. Throws FormatError for other than text.
void TextSource::read_start()
{
  constexpr std::size_t enough = 4096;
  read_more();
  const std::string_view start(buffer_.get(), std::min(end_, enough));
  if (start.starts_with(byte_order_mark)) begin_ = byte_order_mark.size();
  if (const auto kind = other_kind(start); !kind.empty())
    throw FormatError(fmt::format("{} {}", file(), kind));
}

/// Moves the rest of the buffer to its start and reads more bytes; returns their number.
std::size_t TextSource::read_more()
{
  stop_if_interrupted();
  std::memmove(buffer_.get(), buffer_.get() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  if (end_ == buffer_size)
    throw FormatError(
        fmt::format("{}, line {}: the line is longer than a megabyte; is this a text archive?",
                    file(), number_ + 1));
  const auto count =
      read_from(*stream_, {buffer_.get() + end_, buffer_size - end_}, file(), number_);
  end_ += count;
  return count;
}

/// Reads the next line of the open file; false at its end.
bool TextSource::take_line()
{
  std::size_t searched = 0;
  for (;;) {
    const char* from = buffer_.get() + begin_;
    const auto* stop =
        static_cast<const char*>(std::memchr(from + searched, '\n', end_ - begin_ - searched));
    if (stop != nullptr) {
      line_ = {from, static_cast<std::size_t>(stop - from)};
      begin_ += line_.size() + 1;
      whole_ = true;
      break;
    }
    searched = end_ - begin_;
    if (read_more() > 0) continue;
    if (begin_ == end_) return false;
    line_ = {buffer_.get() + begin_, end_ - begin_};
    begin_ = end_;
    whole_ = false;
    break;
  }
  if (line_.ends_with('\r')) line_.remove_suffix(1);
  ++number_;
  return true;
}

bool TextSource::next()
{
  while (stream_ == nullptr || !take_line()) {
    if (opened_ == files_.size()) return false;
    ++opened_;
    number_ = 0;
    stream_ = open_unpacked(file());
    read_start();
  }
  return true;
}

std::string TextSource::place() const
{
  return fmt::format("{}, line {}", file(), number_);
}

void TextSource::fail(const std::string& why) const
{
  throw FormatError(fmt::format("{}: {}", place(), why));
}

void TextSource::fail_at_end(const char* what)
{
  const auto end = place();
  if (next())
    throw FormatError(
        fmt::format("{}: the file ends in {}, and {} goes on; copy it "
                    "again, or cut the incomplete frame off",
                    end, what, file()));
  throw TruncatedArchive(
      fmt::format("{}: the archive ends in {}; copy it again, or leave out the incomplete "
                  "frame with --drop-incomplete",
                  end, what));
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
