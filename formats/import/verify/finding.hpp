// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/verdict.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

/// What the verification of an import finds. Every check has a name, by which it can be waived.
///
///   contacts      they join grains that touch, and each is listed once
///   completeness  grains that overlap are listed, and none are parts of one body
///   overlap       they are not too deep
///   pull          they push rather than pull
///   balance       they add up to the force on each grain
///   gravity       the weight of the grains is that of gravity as given
///   masses        small and large grains weigh what their masses say
///   sizes         small grains are smaller than large ones
///   time          displacements are velocity times time
namespace grseg {

inline constexpr const char* check_names[] = {
    "contacts", "completeness", "overlap", "pull", "balance", "gravity", "masses", "sizes", "time"};

/// The answer of one check.
struct Finding {
  std::string check;
  Verdict verdict = Verdict::passed;
  std::string sentence;
  double measure = 0;  // what --accept-residual NAME=R is compared with
};

/// What --accept-residual has accepted: the largest measure of each check that is named.
class Waivers {
 public:
  Waivers() = default;
  /// From "NAME=R", or "R" for balance=R. UsageError for another check or another number.
  explicit Waivers(const std::vector<std::string>& texts);

  std::optional<double> of(const std::string& check) const;
  /// The limit of a check: what is accepted, or else `otherwise`.
  double limit(const std::string& check, double otherwise) const
  {
    return of(check).value_or(otherwise);
  }
  /// "balance=0.1 overlap=0.6": what the constructor takes, one word each.
  std::string text() const;

  /// The finding as it stands after the waivers: waived where its measure is accepted.
  Finding applied_to(Finding finding) const;

 private:
  std::map<std::string, double> largest_;
};

/// "check: sentence" of all findings with this verdict, one per line; "" where there are none.
std::string lines_with(const std::vector<Finding>& findings, Verdict verdict);

bool any_with(const std::vector<Finding>& findings, Verdict verdict);

}  // namespace grseg
