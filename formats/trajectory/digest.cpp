// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/trajectory/digest.hpp"

#include <fmt/format.h>

#include <algorithm>

#define XXH_STATIC_LINKING_ONLY  // declares XXH3_state_t completely, so that it can be a member
#include <xxhash.h>
#if __has_include(<xxh_x86dispatch.h>) && !defined(XXH_INLINE_ALL)
#include <xxh_x86dispatch.h>  // uses the widest vectors of the processor: twice as fast
#endif

namespace grseg {
namespace {

class Hasher {
 public:
  Hasher(std::uint64_t before, bool float32) : float32_(float32)
  {
    XXH3_64bits_reset(&state_);
    add(&before, sizeof before);
  }
  void add(const void* data, std::size_t bytes)
  {
    if (bytes > 0) XXH3_64bits_update(&state_, data, bytes);
  }
  void add_reals(const double* values, std::size_t count)
  {
    if (!float32_) return add(values, count * sizeof(double));
    rounded_.resize(count);
    std::transform(values, values + count, rounded_.begin(),
                   [](double value) { return static_cast<float>(value); });
    add(rounded_.data(), count * sizeof(float));
  }
  template <class T>
  void add_array(Field field, const std::vector<T>& values)
  {
    const auto bytes = values.size() * sizeof(T);
    if (holds_reals(field))
      add_reals(reinterpret_cast<const double*>(values.data()), bytes / sizeof(double));
    else
      add(values.data(), bytes);
  }
  std::uint64_t digest() const { return XXH3_64bits_digest(&state_); }

 private:
  XXH3_state_t state_;
  std::vector<float> rounded_;
  bool float32_;
};

std::uint64_t seed_of(Field field, std::uint64_t index)
{
  return 16 * index + static_cast<std::uint64_t>(field);
}

}  // namespace

template <int D>
std::uint64_t frame_digest(const Frame<D>& frame, std::uint64_t before, bool float32)
{
  Hasher hash(before, float32);
  hash.add(&frame.step, sizeof frame.step);
  hash.add(&frame.time, sizeof frame.time);
  for_each_array(frame, [&](Field field, const auto& values) { hash.add_array(field, values); });
  return hash.digest();
}

template <int D>
std::uint64_t field_digest(Field field, std::uint64_t index, const Frame<D>& frame, bool float32)
{
  Hasher hash(seed_of(field, index), float32);
  for_each_array(frame, [&](Field known, const auto& values) {
    if (known == field) hash.add_array(known, values);
  });
  return hash.digest();
}

template std::uint64_t frame_digest(const Frame<2>&, std::uint64_t, bool);
template std::uint64_t frame_digest(const Frame<3>&, std::uint64_t, bool);
template std::uint64_t field_digest(Field, std::uint64_t, const Frame<2>&, bool);
template std::uint64_t field_digest(Field, std::uint64_t, const Frame<3>&, bool);

std::uint64_t field_digest(std::uint64_t index, const FramePlace& place)
{
  Hasher hash(seed_of(Field::place, index), false);
  hash.add(&place.step, sizeof place.step);
  hash.add(&place.time, sizeof place.time);
  for (const auto number : {place.begin, place.end, place.chain}) hash.add(&number, sizeof number);
  return hash.digest();
}

std::uint64_t field_digest(std::uint64_t index, const std::vector<double>& observables)
{
  Hasher hash(seed_of(Field::observables, index), false);
  hash.add_reals(observables.data(), observables.size());
  return hash.digest();
}

std::uint64_t chain_digest(const void* data, std::size_t bytes, std::uint64_t before)
{
  Hasher hash(before, false);
  hash.add(data, bytes);
  return hash.digest();
}

std::string format_digest(std::uint64_t digest)
{
  return fmt::format("{:016x}", digest);
}

}  // namespace grseg
