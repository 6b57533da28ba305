// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

/// Digests of the content of a trajectory: xxh3 (64 bit) of bytes in little endian. They reveal
/// damage, but not deliberate forgery.
namespace grseg {

/// Digest of a frame as it is stored, chained with `before`, the digest of the previous frame (0
/// for the first). The bytes are, in this order: step, time, position, image, velocity,
/// angular_velocity, force, then i, j, force, branch, gap of the contacts. With `float32` the
/// floating-point arrays (not `time`) are first rounded to 4 bytes, as in the file.
template <int D>
std::uint64_t frame_digest(const Frame<D>& frame, std::uint64_t before, bool float32);

/// Parts of a frame that have their own digests: the columns of /grseg/field_digest. A reader of
/// only some parts can thus verify these.
enum class Field {
  place,  // step, time, rows of the frame's contacts, and frame_digest (FramePlace)
  position,
  image,
  velocity,
  angular_velocity,
  force,
  contact_i,
  contact_j,
  contact_force,
  contact_branch,
  contact_gap,
  observables,
};
constexpr std::size_t number_of_fields = 12;
using FieldDigests = std::array<std::uint64_t, number_of_fields>;

/// Calls use(field, array) for each array of a frame, in the order of frame_digest().
template <class SomeFrame, class Use>
void for_each_array(SomeFrame&& frame, const Use& use)
{
  auto& contacts = frame.contacts;
  use(Field::position, frame.position);
  use(Field::image, frame.image);
  use(Field::velocity, frame.velocity);
  use(Field::angular_velocity, frame.angular_velocity);
  use(Field::force, frame.force);
  use(Field::contact_i, contacts.i);
  use(Field::contact_j, contacts.j);
  use(Field::contact_force, contacts.force);
  use(Field::contact_branch, contacts.branch);
  use(Field::contact_gap, contacts.gap);
}
inline bool is_of_contacts(Field field)
{
  return Field::contact_i <= field && field <= Field::contact_gap;
}
/// True for arrays of floating-point numbers or vectors, false for whole numbers.
inline bool holds_reals(Field field)
{
  return field != Field::image && field != Field::contact_i && field != Field::contact_j;
}

/// Place of a frame in the run (Field::place).
struct FramePlace {
  std::int64_t step = 0;
  double time = 0;                   // time of the frame, s
  std::uint64_t begin = 0, end = 0;  // rows [begin, end) of its contacts
  std::uint64_t chain = 0;           // frame_digest() of the frame
};

/// Digest of a field of frame number `index`, over the number 16 index + field and then the bytes
/// of the field, with floating-point numbers as in frame_digest(). The number changes the digest of
/// a field that moved to another frame or dataset. Not for `place` and `observables`.
template <int D>
std::uint64_t field_digest(Field field, std::uint64_t index, const Frame<D>& frame, bool float32);
/// Digest of Field::place.
std::uint64_t field_digest(std::uint64_t index, const FramePlace& place);
/// Digest of Field::observables: one value per observable, in the alphabetical order of names.
std::uint64_t field_digest(std::uint64_t index, const std::vector<double>& observables);

/// Digest of any bytes, chained with `before`, the digest of the preceding bytes.
std::uint64_t chain_digest(const void* data, std::size_t bytes, std::uint64_t before);

/// Digest of a sequence of values: each add() chains the size in bytes and then the value.
class Digester {
 public:
  void add(std::string_view text) { add(text.data(), text.size()); }
  template <class T>
  void add(const std::vector<T>& values)
  {
    add(values.data(), values.size() * sizeof(T));
  }
  template <class T>
  void add(const T& value) requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  {
    add(&value, sizeof value);
  }
  void add(const void* data, std::size_t bytes)
  {
    const std::uint64_t size = bytes;
    digest_ = chain_digest(&size, sizeof size, digest_);
    digest_ = chain_digest(data, bytes, digest_);
  }
  std::uint64_t digest() const { return digest_; }

 private:
  std::uint64_t digest_ = 0;
};

/// A digest as 16 hexadecimal digits.
std::string format_digest(std::uint64_t digest);

}  // namespace grseg
