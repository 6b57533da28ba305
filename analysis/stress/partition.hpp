// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/cli/table.hpp"
#include "formats/core/frame.hpp"

#include <optional>
#include <string>
#include <vector>

/// How the stress of contacts between a large and a small grain is shared between the species. The
/// rules are algebra on stored sums: changing one reads no contact again.
namespace grseg {

/// The share of a mixed contact that goes to its large grain; the small one gets the rest.
struct PartitionRule {
  enum class Kind {
    size,           ///< r_L/(r_L + r_S) of the actual radii (Staron & Phillips 2015)
    contact_point,  ///< the branch cut at the contact point (MercuryCG; Weinhart et al. 2012)
    half,           ///< one half (LAMMPS and LIGGGHTS compute stress/atom)
    drop,           ///< nobody's: a stress restricted to one group (LAMMPS continuum/chunk)
    uniform,        ///< `value`, the same for every contact
    power,          ///< r_L^Q/(r_L^Q + r_S^Q) of the actual radii, Q = `value`
  };
  Kind kind = Kind::size;
  double value = 0;

  /// As it is typed: "size", "uniform:0.8".
  std::string name() const;
  /// The codes that share mixed contacts so; "" where none is known.
  std::string used_by() const;
  bool operator==(const PartitionRule&) const = default;
};

/// UsageError, naming the rules, where `text` is none.
PartitionRule parse_rule(const std::string& text);
/// Several rules; each text may be a list "size,uniform:0.8", in which "stock" stands for those of
/// published codes: size, contact-point, half and drop.
std::vector<PartitionRule> parse_rules(const std::vector<std::string>& texts);

/// What a contact with the base or a wall gives to the species of its mobile grain.
enum class BasePart {
  contact_point,  ///< the branch from the grain's centre to the contact point
  half,           ///< half the whole branch (LAMMPS and LIGGGHTS)
  none,
};
BasePart parse_base(const std::string& text);

/// Sums of force (x) branch over the contacts of one layer in one window, N m, compression
/// positive: a row of the table of grseg-stress, means per frame.
struct ContactSums {
  double volume = 0;                        // m^2, voids included
  double area_small = 0, area_large = 0;    // m^2
  Tensor2 ss = Tensor2::Zero();             // A_SS
  Tensor2 ll = Tensor2::Zero();             // A_LL
  Tensor2 mixed = Tensor2::Zero();          // M, whole branch
  Tensor2 mixed_size = Tensor2::Zero();     // Msize, the large grain's part by size
  Tensor2 mixed_contact = Tensor2::Zero();  // Mcp, the large grain's part up to the contact point
  Tensor2 mixed_power = Tensor2::Zero();    // Mpower, the large grain's part by power:Q
  Tensor2 base_small = Tensor2::Zero(), base_large = Tensor2::Zero();    // A_Sb, A_Lb
  Tensor2 whole_small = Tensor2::Zero(), whole_large = Tensor2::Zero();  // F_Sb, F_Lb

  /// Where each grain's part is booked at that grain's centre (--assign grain), the sums above hold
  /// parts cut by size. What shares are taken of that are the same for all contacts:
  struct AtCentres {
    Tensor2 ss = Tensor2::Zero(), ll = Tensor2::Zero();  // HSS, HLL: half at either grain
    // ML, MS: the whole branch at the large grain, and once more at the small one
    Tensor2 mixed_large = Tensor2::Zero(), mixed_small = Tensor2::Zero();
  };
  AtCentres at_centres{};
  bool booked_at_centres = false;  // at_centres is there
};

enum class StressVolume { bulk, solid };

/// N/m. small + large = total for every rule but `drop`.
struct PartialStress {
  Tensor2 small, large, total;
};

/// sigma^L = (A_LL + share + base_L)/V, sigma^S = (A_SS + M - share + base_S)/V, V with voids
/// (bulk) or the area of the mobile grains in the layer (solid). Of parts booked at the grains'
/// centres half and uniform:P take P ML and (1 - P) MS, and of equal grains half at either; half is
/// then compute stress/atom, summed by species and layer.
PartialStress partial_stress(const ContactSums& sums, const PartitionRule& rule,
                             BasePart base = BasePart::contact_point,
                             StressVolume volume = StressVolume::bulk);

/// The neutral contact model's share-by-share answer: contact ends in proportion to perimeter,
/// random pairing and a mean force blind to type give
///   B(phi_L) = (P - r/(1+r)) (1+r)/(phi_L + r phi_S),  r = d_L/d_S,
/// for the rules that give all mixed contacts of nominal sizes the share P; NaN for `drop`.
double neutral_b(const PartitionRule& rule, double size_ratio, double phi_large);

/// Reads the rows of a table of grseg-stress as ContactSums. FormatError, naming the column and
/// how to get it, where one is missing that `rules` need, or where a number is not finite.
class ContactSumsReader {
 public:
  ContactSumsReader(const Table& table, const std::vector<PartitionRule>& rules);
  ContactSums read(std::size_t row) const;

 private:
  struct TensorColumns {
    std::size_t xx, xy, yx, yy;
  };
  TensorColumns find(const std::string& name, const std::string& remedy) const;
  Tensor2 tensor(std::size_t row, const TensorColumns& columns) const;

  const Table& table_;
  std::size_t volume_, area_small_, area_large_;
  TensorColumns ss_, ll_, mixed_, mixed_size_, mixed_contact_;
  TensorColumns base_small_, base_large_, whole_small_, whole_large_;
  std::optional<TensorColumns> mixed_power_;
  struct CentreColumns {
    TensorColumns ss, ll, mixed_large, mixed_small;
  };
  std::optional<CentreColumns> at_centres_;
};

/// Column number; FormatError that adds `remedy` ("make it with ...") where there is none.
std::size_t find_column(const Table& table, const std::string& name, const std::string& remedy);
/// A cell that must be a finite number; FormatError naming row and column where it is not.
double finite_cell(const Table& table, std::size_t row, std::size_t column);

}  // namespace grseg
