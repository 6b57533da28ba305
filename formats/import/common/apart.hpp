// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/import/common/archive.hpp"

#include <sys/types.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace grseg {

/// Reads an untrusted file in a separate process. On some damaged files the HDF5 library crashes,
/// never ends or asks for unlimited memory; this class turns that into an error message.
class Apart {
 public:
  using Send = std::function<void(const std::string& message)>;
  using Work = std::function<void(const Send& send)>;

  /// Starts `work`, which sends messages about `file`. Throws RunError if this is impossible.
  Apart(std::string file, const Work& work);
  Apart(const Apart&) = delete;
  Apart& operator=(const Apart&) = delete;
  /// Kills the process.
  ~Apart();

  /// The next message, valid until the next call. Throws a ToolError with the text and exit code of
  /// the error that `work` threw. Throws FormatError naming `place` if the process crashes, or if
  /// the message takes more processor time or memory than the size of the file explains.
  const std::string& receive(const std::string& place);

 private:
  [[noreturn]] void explain_end(const std::string& place);

  std::string file_;
  pid_t process_ = -1;
  int end_ = -1;  // file descriptor of the pipe's reading end
  std::string message_;
};

}  // namespace grseg

/// Converts values to bytes and back, for another process of the same program. A struct needs a
/// function `each_of(value, pass)` in its namespace, which calls `pass` with all its members.
namespace grseg::packing {

template <class T>
constexpr bool is_plain = std::is_trivially_copyable_v<T> || std::is_same_v<T, Vec3>;

/// Writes values to bytes, or reads them from bytes.
template <bool writes>
class Pass {
 public:
  std::conditional_t<writes, std::string, std::string_view> bytes;

  template <class... T>
  void operator()(T&... values)
  {
    (pass(values), ...);
  }

 private:
  void pass_bytes(void* data, std::size_t count)
  {
    if constexpr (writes)
      bytes.append(static_cast<const char*>(data), count);
    else
      bytes.remove_prefix(bytes.copy(static_cast<char*>(data), count));
  }
  std::size_t pass_size(std::size_t size)
  {
    pass_bytes(&size, sizeof size);
    return size;
  }

  template <class T>
  void pass(std::optional<T>& value)
  {
    const bool has_value = pass_size(value ? 1 : 0) > 0;
    if (!writes) value.reset();
    if (!writes && has_value) value.emplace();
    if (has_value) pass(*value);
  }
  void pass(std::string& text)
  {
    text.resize(pass_size(text.size()));
    pass_bytes(text.data(), text.size());
  }
  template <class T>
  void pass(std::vector<T>& values)
  {
    values.resize(pass_size(values.size()));
    if constexpr (is_plain<T>)
      pass_bytes(values.data(), values.size() * sizeof(T));
    else
      for (auto& value : values) pass(value);
  }
  template <class T>
  void pass(T& value)
  {
    if constexpr (is_plain<T>)
      pass_bytes(&value, sizeof(T));
    else
      each_of(value, *this);
  }
};

/// Converts values to bytes; unpack() reads them back.
template <class... T>
std::string packed(T&... values)
{
  Pass<true> pass;
  pass(values...);
  return std::move(pass.bytes);
}
template <class... T>
void unpack(std::string_view bytes, T&... values)
{
  Pass<false> pass{bytes};
  pass(values...);
}

}  // namespace grseg::packing

namespace grseg {

/// Opens an archive of a single `file` by `open`, and reads it in a separate process. Only for
/// formats without --columns.
std::unique_ptr<Archive> open_apart(const std::string& file,
                                    const std::function<std::unique_ptr<Archive>()>& open);

}  // namespace grseg
