// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/lmgc90/lmgc90.hpp"
#include "formats/import/lmgc90/lmgc90_fields.hpp"

#include <filesystem>
#include <numbers>

namespace grseg {
namespace {

using Words = std::vector<std::string_view>;

class BodiesReader {
 public:
  explicit BodiesReader(const std::string& path) : text_({path}) { bodies_.path = path; }

  Lmgc90Bodies read()
  {
    while (text_.next()) {
      const auto words = words_of(text_.line());
      if (words.size() == 2 && words[0].starts_with("RBDY"))
        begin(words);
      else if (!words.empty() && words[0] == "MAILx")
        fail("is deformable (MAILx)");
      else if (!bodies_.all.empty() && words.size() > 3 && words[2] == "behav")
        bodies_.all.back().material = words[3];
      fields_.read(text_.line());
      if (!bodies_.all.empty() && words.size() > 3 && words[2] == "color")
        add_contactor(std::string(words[0]), bodies_.all.back());
    }
    finish();
    read_materials();
    read_driven();
    return std::move(bodies_);
  }

 private:
  void begin(const Words& words)
  {
    const int dimension = words[0] == "RBDY3" ? 3 : 2;
    if (bodies_.all.empty())
      bodies_.dimension = dimension;
    else
      finish();
    bodies_.all.emplace_back();
    fields_.clear();
    if (number_of(words[1]) != bodies_.all.size() || dimension != bodies_.dimension)
      text_.fail("the bodies are not numbered 1, 2, 3, ..., or some are RBDY2 and others RBDY3");
  }

  void add_contactor(const std::string& kind, Lmgc90Body& body)
  {
    const bool is_grain = kind == (bodies_.dimension == 3 ? "SPHER" : "DISKx");
    if (!is_grain && kind != "JONCx" && kind != "xKSID" && kind != "PLANx" && kind != "DNLYC")
      fail("has a contactor " + kind);
    if (body.contactors++ > 0 && (is_grain || body.radius > 0))
      fail("is a cluster of several contactors");
    if (is_grain) {
      body.radius = fields_.number("byrd=", text_);
      if (body.radius <= 0) text_.fail("the radius is not positive");
      return;
    }
    if (body.contactors == 1) body.first_wall = static_cast<std::int32_t>(bodies_.walls.size());
    bodies_.walls.push_back(fmt::format("body {} ({})", bodies_.all.size(), kind));
  }

  /// Completes the last body. As in LMGC90 its mass follows from a disc or sphere of radius avrd.
  void finish()
  {
    if (bodies_.all.empty() || bodies_.all.back().contactors == 0)
      text_.fail("there is no body (RBDY2 or RBDY3) with a contactor before this line");
    auto& body = bodies_.all.back();
    body.position = fields_.vector("coo{}=", 1, bodies_.dimension, text_);
    double r = fields_.number("avrd=", text_);
    if (r == 0) r = body.radius;
    body.mass = std::numbers::pi * (bodies_.dimension == 3 ? 4 * r * r * r / 3 : r * r);
  }

  void read_materials()
  {
    std::map<std::string, double, std::less<>> density;
    read_beside("BULK_BEHAV.DAT", [&](const TextSource& text, const Words& words) {
      Lmgc90Fields fields;
      fields.read(text.line());
      if (fields.contains("Umas=")) density.emplace(words[0], fields.number("Umas=", text));
      if (fields.contains("grv1="))
        bodies_.gravity = fields.vector("grv{}=", 1, bodies_.dimension, text);
    });
    for (auto& body : bodies_.all) {
      body.mass *= density[body.material];
      bodies_.know_masses = bodies_.know_masses && (body.radius == 0 || body.mass > 0);
    }
  }

  /// Finds the bodies of which all velocities, without the spin, are prescribed as 0.
  void read_driven()
  {
    std::vector<int> resting(bodies_.all.size() + 1);
    std::size_t now = 0;
    read_beside("DRV_DOF.DAT", [&](const TextSource&, const Words& words) {
      if (words.size() == 2 && words[0].starts_with("RBDY")) now = number_of(words[1]);
      double constant = 1, amplitude = 1;
      if (now < resting.size() && words.size() > 3 && words[0] == "vlocy" &&
          number_of(words[1]) <= static_cast<std::size_t>(bodies_.dimension) &&
          read_number(words[2], constant) && read_number(words[3], amplitude) && constant == 0 &&
          amplitude == 0 && ++resting[now] == bodies_.dimension && now > 0)
        bodies_.all[now - 1].fixed = true;
    });
  }

  template <class Line>
  void read_beside(const char* name, Line line) const
  {
    const auto path = std::filesystem::path(bodies_.path).replace_filename(name);
    if (!std::filesystem::is_regular_file(path)) return;
    TextSource text({path.string()});
    while (text.next())
      if (const auto words = words_of(text.line()); !words.empty()) line(text, words);
  }

  [[noreturn]] void fail(const std::string& why) const
  {
    text_.fail(
        fmt::format("body {} {}; grains can be bodies of one disc (DISKx) or sphere (SPHER), "
                    "and walls JONCx, xKSID, PLANx and DNLYC",
                    bodies_.all.size(), why));
  }

  TextSource text_;
  Lmgc90Bodies bodies_;
  Lmgc90Fields fields_;  // of the last body
};

}  // namespace

Lmgc90Bodies read_lmgc90_bodies(const std::string& path)
{
  return BodiesReader(path).read();
}

}  // namespace grseg
