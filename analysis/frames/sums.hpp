// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

namespace grseg {

/// Value in tables of numbers that are not known or not defined.
inline constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// a/b, or NaN unless b > 0: the mean of an empty set is not defined.
inline double ratio(double a, double b)
{
  return b > 0 ? a / b : no_number;
}

/// Adds `others` to `sums`, element by element: structs that list their `members`, types with +=,
/// and arrays and vectors of these. A vector grows to the length of the other one.
template <class Sums>
void accumulate(Sums& sums, const Sums& others)
{
  if constexpr (requires { Sums::members; }) {
    std::apply([&](auto... member) { (accumulate(sums.*member, others.*member), ...); },
               Sums::members);
  } else if constexpr (requires { sums += others; }) {
    sums += others;
  } else {
    if constexpr (requires { sums.resize(others.size()); })
      if (sums.size() < others.size()) sums.resize(others.size());
    for (std::size_t k = 0; k < others.size(); ++k) accumulate(sums[k], others[k]);
  }
}

/// Calls use(part) with every number, vector and tensor in `sums`, which are as for accumulate().
template <class Sums, class Use>
void for_each_part(Sums& sums, const Use& use)
{
  if constexpr (requires { Sums::members; })
    std::apply([&](auto... member) { (for_each_part(sums.*member, use), ...); }, Sums::members);
  else if constexpr (requires { sums *= 1.0; })
    use(sums);
  else
    for (auto& part : sums) for_each_part(part, use);
}

template <class Sums>
concept ListsMembers = requires
{
  Sums::members;
};

template <ListsMembers Sums>
Sums& operator+=(Sums& sums, const Sums& others)
{
  accumulate(sums, others);
  return sums;
}
template <ListsMembers Sums>
Sums operator*(Sums sums, double factor)
{
  for_each_part(sums, [factor](auto& part) { part *= factor; });
  return sums;
}
template <ListsMembers Sums>
Sums operator/(Sums sums, double number)
{
  for_each_part(sums, [number](auto& part) { part /= number; });
  return sums;
}

/// One number of a table's row with the name and unit of its column, "f_S[N]". A table's columns
/// and its rows both come from one list of cells.
struct Cell {
  std::string column;
  double value;
};

/// Appends `more` to a list.
template <class List>
List& add_all(List& list, const List& more)
{
  list.insert(list.end(), more.begin(), more.end());
  return list;
}

/// Results of `of`, a function or a member, for each element of a list.
template <class List, class Of>
auto listed(const List& list, const Of& of)
{
  std::vector<std::decay_t<std::invoke_result_t<const Of&, decltype(*list.begin())>>> all;
  all.reserve(list.size());
  for (const auto& one : list) all.push_back(std::invoke(of, one));
  return all;
}

inline std::vector<std::string> columns_of(const std::vector<Cell>& cells)
{
  return listed(cells, &Cell::column);
}
inline std::vector<double> values_of(const std::vector<Cell>& cells)
{
  return listed(cells, &Cell::value);
}

}  // namespace grseg
