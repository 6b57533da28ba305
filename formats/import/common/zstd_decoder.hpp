// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <zstd.h>

#include <memory>
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

}  // namespace grseg
