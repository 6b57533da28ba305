// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/errors.hpp"
#include "formats/import/lmgc90/lmgc90.hpp"
#include "formats/import/lmgc90/lmgc90_fields.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace grseg {
namespace {

using Words = std::vector<std::string_view>;

struct Head {
  std::int64_t number = 0;
  double time = 0;
};

/// Moves behind the line "$steps      1                time= 0.1000000D-02"; returns its numbers.
Head read_head(TextSource& text)
{
  while (text.next()) {
    const auto words = words_of(text.line());
    if (words.size() < 2 || words[0] != "$steps") continue;
    Lmgc90Fields fields;
    fields.read(text.line());
    Head head{0, fields.number("time=", text)};
    if (parse_whole(words[1], head.number)) return head;
  }
  text.fail("a line '$steps' with the number of a step is missing");
}

/// In 3D the spin is given in the axes of inertia of the body: alpha, beta and gamma.
Lmgc90Step::Body body_of(int dimension, const Lmgc90Fields& fields, const TextSource& text)
{
  Lmgc90Step::Body body{fields.vector("X({})=", 1, dimension, text),
                        fields.vector("V({})=", 1, dimension, text), Vec3::Zero()};
  if (dimension == 2) body.spin.z() = fields.number("V(3)=", text);
  const char* const axes[] = {"a({})=", "b({})=", "g({})="};
  for (int k = 0; dimension == 3 && k < 3; ++k)
    body.spin +=
        fields.number(fmt::format("V({})=", 4 + k), text) * fields.vector(axes[k], 1, 3, text);
  return body;
}

int read_bodies(TextSource& text, Lmgc90Step& step)
{
  int dimension = 2;
  Lmgc90Fields fields;
  while (text.next()) {
    const auto words = words_of(text.line());
    if (words.size() == 2 && words[0].starts_with("RBDY")) {
      dimension = words[0] == "RBDY3" ? 3 : 2;
      fields.clear();
      if (number_of(words[1]) != step.bodies.size() + 1)
        text.fail("a body is missing before this line; let the run write invisible ones, too");
    } else if (words.size() == 1 && words[0] == "$$$$$$") {
      step.bodies.push_back(body_of(dimension, fields, text));
    }
    fields.read(text.line());
  }
  return dimension;
}

/// The bodies in a line "cdbdy numbr cdtac numbr behav anbdy numbr antac numbr sttus".
Lmgc90Step::Pair pair_of(const Words& words, const TextSource& text)
{
  Lmgc90Step::Pair pair;
  if (!parse_whole(words[1], pair.candidate) || !words[5].starts_with("RBDY") ||
      !parse_whole(words[6], pair.antagonist) || !parse_whole(words[8], pair.contactor))
    text.fail("a contact needs two bodies (RBDY2 or RBDY3) and contactors with their numbers");
  return pair;
}

void complete(int dimension, double length, const Lmgc90Fields& fields, const TextSource& text,
              Lmgc90Step::Pair& pair)
{
  const auto axis = [&](const char* keys) { return fields.vector(keys, 1, 3, text); };
  const bool in_space = dimension == 3;
  pair.normal = axis("n({})=");
  const Vec3 t = in_space ? axis("t({})=") : Vec3(pair.normal.y(), -pair.normal.x(), 0);
  pair.force = fields.number("rlt/H", text) * t + fields.number("rln/H", text) * pair.normal;
  if (in_space) pair.force += fields.number("rls/H", text) * axis("s({})=");
  pair.gap = fields.number(fields.contains("gTT =") ? "gTT =" : "gapTT", text) -
             length * fields.number("vln =", text);
}

void read_pairs(int dimension, TextSource& text, Lmgc90Step& step)
{
  Lmgc90Fields fields;
  std::size_t begun = 0;
  const auto finish = [&] {
    if (!step.pairs.empty()) complete(dimension, step.length, fields, text, step.pairs.back());
    fields.clear();
  };
  while (text.next()) {
    const auto words = words_of(text.line());
    if (!words.empty() && words[0] == "$icdan") ++begun;
    if (words.size() > 8 && words[0].starts_with("RBDY")) {
      finish();
      step.pairs.push_back(pair_of(words, text));
    }
    fields.read(text.line());
  }
  finish();
  if (begun != step.pairs.size())
    text.fail(fmt::format("{} contacts begin ('$icdan'), but {} have a line with their bodies",
                          begun, step.pairs.size()));
}

Lmgc90Step read_step(const std::string& path, double length)
{
  TextSource bodies({path});
  const auto head = read_head(bodies);
  Lmgc90Step step;
  step.time = head.time;
  step.length = length;
  step.place = path;
  const int dimension = read_bodies(bodies, step);
  auto name = std::filesystem::path(path).filename().string();
  name.replace(std::min(name.rfind("DOF"), name.size()), 3, "Vloc_Rloc");
  TextSource pairs({std::filesystem::path(path).replace_filename(name).string()});
  if (const auto number = read_head(pairs).number; number != head.number)
    pairs.fail(fmt::format("this is step {}, but {} has step {}", number, path, head.number));
  read_pairs(dimension, pairs, step);
  return step;
}

}  // namespace

Lmgc90Steps open_lmgc90_texts(const std::vector<std::string>& paths)
{
  Lmgc90Steps steps;
  Head first, last;
  for (const auto& path : paths) {
    TextSource text({path});
    last = read_head(text);
    if (paths.size() > 1 && steps.numbers.empty()) first = last;
    steps.numbers.push_back(last.number);
  }
  const double length = (last.time - first.time) /
                        (static_cast<double>(last.number) - static_cast<double>(first.number));
  if (!(length > 0) || !std::isfinite(length))
    throw FormatError(paths.back() +
                      ": numbers and times of the steps do not tell the length of a step");
  steps.read = [=](std::size_t k) { return read_step(paths[k], length); };
  return steps;
}

}  // namespace grseg
