// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/stress/contact_assignment.hpp"

#include "analysis/frames/frame_loop.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/errors.hpp"

#include <fmt/format.h>

#include <utility>

namespace grseg {
namespace {

struct AssignmentWord {
  Assignment assignment;
  std::optional<KernelShape> shape;
};

constexpr Choice<AssignmentWord> assignments[] = {
    {"contact-point", {Assignment::contact_point, {}}},
    {"branch", {Assignment::branch, {}}, "by the length in each layer"},
    {"grain", {Assignment::grain, {}}, "each grain's part at its centre"},
    {kernel_shapes[0].word, {Assignment::kernel, KernelShape::gauss}},
    {kernel_shapes[1].word, {Assignment::kernel, KernelShape::lucy}},
    {kernel_shapes[2].word,
     {Assignment::kernel, KernelShape::heaviside},
     "spread along the branch by this kernel"},
};

}  // namespace

void ContactAssignmentOptions::add_to(po::options_description& options)
{
  const auto where = "the layer to which a contact counts: " + list_of(assignments);
  options.add_options()("assign", word_option(&assign, words_of(assignments)), where.c_str());
  options.add_options()("kernel-width",
                        po::value(&width)->default_value(width)->value_name("LENGTH"),
                        "of the kernel: standard deviation of gauss, half the support of lucy and "
                        "heaviside");
  options.add_options()("composition", word_option(&composition, words_of(grain_areas)),
                        "a grain's area is clipped at the layers' edges (default), counted whole "
                        "at its centre, or spread from there by the kernel (default where there "
                        "is one): clipped, centre or kernel. In maps centre");
}

ContactAssignment ContactAssignmentOptions::contact_assignment(const po::variables_map& values,
                                                               const std::string& otherwise)
{
  const auto [assignment, shape] = choose(assign, "--assign", assignments);
  ContactAssignment chosen{assignment, shape, {}};
  if (composition.empty()) composition = chosen.shape ? "kernel" : otherwise;
  chosen.area = choose(composition, "--composition", grain_areas);
  for (const auto& [given, option] :
       {std::pair{chosen.area == GrainArea::kernel, "--composition kernel"},
        {!values["kernel-width"].defaulted(), "--kernel-width"}})
    if (given && !chosen.shape)
      throw UsageError(fmt::format("{} needs a kernel: --assign gauss, lucy or heaviside", option));
  return chosen;
}

std::optional<Kernel> ContactAssignmentOptions::kernel(const ContactAssignment& chosen,
                                                       const LengthUnits& units) const
{
  if (!chosen.shape) return {};
  return Kernel(*chosen.shape, parse_length(width, "--kernel-width", units));
}

}  // namespace grseg
