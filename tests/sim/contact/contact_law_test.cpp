// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/contact/contact_law-inl.hpp"
#include "sim/solver/solver.hpp"
#include "tests/sim/contact_list.hpp"

#include <gtest/gtest.h>

#include <array>
#include <utility>

namespace grseg {
namespace {

namespace law = HWY_NAMESPACE;

/// Two discs with centres along (0.6, 0.8), or one disc on an immobile body (b of mass 0).
struct TwoDiscs {
  std::vector<Motion<2>> motion;
  std::vector<Contact<2>> contacts;
  double friction = 0.5;

  TwoDiscs(const Motion<2>& a, const Motion<2>& b, double nx = 0.6, double ny = 0.8,
           double kappa = 1)
      : motion{a, b}
  {
    Contact<2> c{};
    c.n[0] = nx;
    c.n[1] = ny;
    c.kappa = kappa;
    const double w = a.inverse_mass + b.inverse_mass;
    c.mass_n = 1 / w;
    c.mass_t = 1 / (w * (1 + 2 * kappa * kappa));
    c.j = 1;
    contacts.push_back(c);
  }
  double separation() const
  {
    return (motion[0].v[0] - motion[1].v[0]) * contacts[0].n[0] +
           (motion[0].v[1] - motion[1].v[1]) * contacts[0].n[1];
  }
  double sliding() const
  {
    return (motion[0].v[1] - motion[1].v[1]) * contacts[0].n[0] -
           (motion[0].v[0] - motion[1].v[0]) * contacts[0].n[1] -
           contacts[0].kappa * (motion[0].rim[0] + motion[1].rim[0]);
  }
  void collide(double restitution, Effects effects = {})
  {
    contacts[0].rebound = restitution * std::max(-separation(), 0.0);
    solve_contacts(contacts, motion, friction, effects, {1e-14, 100}, 0);
  }
  double residual() const { return contact_residual(contacts, motion, friction, {}); }
};

double mass(const Motion<2>& m)
{
  return 1 / m.inverse_mass;
}

TEST(ContactLaw, AnImpactConservesMomentumAndAngularMomentum)
{
  // Radii 2 and 1, masses as their squares, centres 3 apart along (0.6, 0.8).
  const double ra = 2, rb = 1;
  TwoDiscs s({{-1, -2}, 1.0 / 4, {3}}, {{0.5, 1}, 1.0, {-1}});
  const auto momentum_x = [&] {
    return mass(s.motion[0]) * s.motion[0].v[0] + mass(s.motion[1]) * s.motion[1].v[0];
  };
  const auto momentum_y = [&] {
    return mass(s.motion[0]) * s.motion[0].v[1] + mass(s.motion[1]) * s.motion[1].v[1];
  };
  // Angular momentum about the centre of b: orbital part of a (at 3 n from b) plus the spins, I
  // omega = m r v_rim/2.
  const auto angular = [&] {
    const double orbital = mass(s.motion[0]) * (1.8 * s.motion[0].v[1] - 2.4 * s.motion[0].v[0]);
    return orbital + mass(s.motion[0]) * ra * s.motion[0].rim[0] / 2 +
           mass(s.motion[1]) * rb * s.motion[1].rim[0] / 2;
  };
  const double px = momentum_x(), py = momentum_y(), l = angular();
  s.collide(0.25);
  EXPECT_GT(std::abs(s.contacts[0].impulse_t[0]), 0.1);
  EXPECT_NEAR(momentum_x(), px, 1e-14);
  EXPECT_NEAR(momentum_y(), py, 1e-14);
  EXPECT_NEAR(angular(), l, 1e-13);
}

TEST(ContactLaw, AngularMomentumIsConservedAlsoWhereDiscsOverlap)
{
  // Centres 2.7 apart instead of 3; the lever arms kappa r add up to the distance.
  const double kappa = 0.9;
  TwoDiscs s({{-1, -2}, 1.0 / 4, {3}}, {{0.5, 1}, 1.0, {-1}}, 0.6, 0.8, kappa);
  const auto angular = [&] {
    const double orbital = 4 * (0.9 * 1.8 * s.motion[0].v[1] - 0.9 * 2.4 * s.motion[0].v[0]);
    return orbital + 4 * 2 * s.motion[0].rim[0] / 2 + 1 * s.motion[1].rim[0] / 2;
  };
  const double before = angular();
  s.collide(0.25);
  EXPECT_NEAR(angular(), before, 1e-13);
}

TEST(ContactLaw, TheReboundIsNewtonsRestitution)
{
  for (const double e : {0.0, 0.25, 0.5, 1.0}) {
    TwoDiscs s({{-1, -2}, 1.0 / 4}, {{0.5, 1}, 1.0});
    const double approach = -s.separation();
    s.collide(e);
    EXPECT_NEAR(s.separation(), e * approach, 1e-14);
  }
}

TEST(ContactLaw, ANormalImpactLosesOneMinusESquaredOfItsRelativeEnergy)
{
  const double e = 0.25;
  TwoDiscs s({{-0.6, -0.8}, 1.0 / 4}, {{0.6, 0.8}, 1.0});
  const auto energy = [&] {
    double sum = 0;
    for (const auto& m : s.motion)
      sum += mass(m) * (m.v[0] * m.v[0] + m.v[1] * m.v[1] + m.rim[0] * m.rim[0] / 2) / 2;
    return sum;
  };
  const double before = energy(), approach = -s.separation(), reduced = 4.0 * 1.0 / 5.0;
  s.collide(e);
  EXPECT_NEAR(before - energy(), (1 - e * e) * reduced * approach * approach / 2, 1e-14);
}

TEST(ContactLaw, AnObliqueImpactSticksInsideTheConeAndSlidesOutside)
{
  // On a wall, u_t = v_t: the disc sticks iff |u_t| <= 3 mu (1 + e) |u_n|, and then v_t' = 2/3 v_t.
  const double e = 0.25, mu = 0.5, cone = 3 * mu * (1 + e);
  for (const double slip : {0.5 * cone, 0.999 * cone, 1.001 * cone, 4 * cone}) {
    TwoDiscs s({{-slip, -1}, 1}, {}, 0, 1);  // t = (-1, 0): u_t = slip
    s.collide(e);
    if (slip <= cone) {
      EXPECT_NEAR(s.motion[0].v[0], -slip * 2 / 3, 1e-14);
      EXPECT_NEAR(s.sliding(), 0, 1e-14);
    } else {
      EXPECT_NEAR(s.motion[0].v[0], -slip + mu * (1 + e), 1e-14);
      EXPECT_GT(s.sliding(), 0);
      EXPECT_NEAR(s.contacts[0].impulse_t[0], -mu * s.contacts[0].impulse_n, 1e-14);
    }
  }
}

/// A disc of mass 1 that hits a wall below it with velocity `slip` along x and 1 downward, and rebounds
/// with e times that. It may have an impulse `base` from earlier sweeps, which its velocity includes.
/// The tangent is (-1, 0).
struct SingleImpact {
  Increments<2, float> contact{{0, 1}, 1, 1, 0, 1.0F / 3, 0.25F, 0, {0}, 0, {0}};
  MotionOf<2, float> disc, wall;
  Relaxed<2, float> relaxed;

  explicit SingleImpact(float slip, float base = 0) : disc{{slip, -1}}
  {
    contact.base_n = base;
    relaxed = law::relax<Effects{}>(contact, disc, wall, 0.5F);
  }
};

TEST(ContactLaw, InSinglePrecisionAnImpactSticksInsideTheConeAndSlidesOutside)
{
  constexpr float cone = 3 * 0.5F * 1.25F;
  for (const float slip : {0.5F * cone, 0.999F * cone, 1.001F * cone, 4 * cone, -4 * cone}) {
    const SingleImpact s(slip);
    EXPECT_FLOAT_EQ(s.disc.v[1], 0.25F);
    EXPECT_FLOAT_EQ(s.relaxed.change_n, 1.25F);
    const bool sticks = std::abs(slip) <= cone;
    const float tangential = sticks ? slip / 3 : std::copysign(0.5F * 1.25F, slip);
    EXPECT_NEAR(s.disc.v[0], slip - tangential, 1e-6F);
    EXPECT_NEAR(s.disc.rim[0], -2 * tangential, 1e-6F);
    EXPECT_NEAR(std::abs(s.relaxed.change_t[0]), 3 * std::abs(tangential), 1e-6F);  // W_tt = 3 W_nn
    EXPECT_EQ(s.wall.v[0], 0);
  }
}

TEST(ContactLaw, InSinglePrecisionALoadFromBeforeBearsFrictionAndIsGivenBackAtMost)
{
  // With an earlier impulse of 10, friction may stop 0.5 (10 + 1.25).
  EXPECT_NEAR(SingleImpact(20).disc.v[0], 20 - 0.625F, 1e-5F);
  EXPECT_NEAR(SingleImpact(20, 10).disc.v[0], 20 - 5.625F, 1e-5F);
  EXPECT_NEAR(SingleImpact(-20, 10).disc.v[0], -20 + 5.625F, 1e-5F);
  EXPECT_FLOAT_EQ(SingleImpact(0, 10).relaxed.level_n, 11.25F);
  // The friction impulse from earlier sweeps counts towards its limit.
  SingleImpact loaded(0, 10);
  loaded.contact.base_t[0] = -5.625F;
  loaded.disc = {{-20, 0.25F}};
  law::relax<Effects{}>(loaded.contact, loaded.disc, loaded.wall, 0.5F);
  EXPECT_NEAR(loaded.contact.impulse_t[0], 0, 1e-5F);
  EXPECT_NEAR(loaded.disc.v[0], -20, 1e-5F);
  // A disc that parts gives back no more impulse than it has.
  loaded.contact.rebound = 0;
  loaded.contact.base_t[0] = 0;
  loaded.disc = {{0, 100}};
  law::relax<Effects{}>(loaded.contact, loaded.disc, loaded.wall, 0.5F);
  EXPECT_EQ(loaded.contact.impulse_n, -10);
}

TEST(ContactLaw, ASlidingDiscEndsRollingAtTwoThirdsOfItsSpeed)
{
  // The normal impulse is large enough for friction to stop the sliding; the angular momentum about
  // the contact is conserved.
  TwoDiscs s({{3, -10}, 1}, {}, 0, 1);
  s.collide(0);
  EXPECT_NEAR(s.motion[0].v[0], 2, 1e-14);
  EXPECT_NEAR(s.motion[0].rim[0], -2, 1e-14);
}

TEST(ContactLaw, SeparatingDiscsFeelNothing)
{
  TwoDiscs s({{1, 2}, 1.0 / 4, {0.3}}, {{-0.5, -1}, 1.0, {0.1}});
  const auto before = s.motion;
  s.collide(0.25);
  EXPECT_EQ(s.contacts[0].impulse_n, 0);
  EXPECT_EQ(s.motion[0].v[0], before[0].v[0]);
  EXPECT_EQ(s.motion[1].rim[0], before[1].rim[0]);
}

TEST(ContactLaw, ASolvedContactHasNoResidual)
{
  for (const double slip : {0.5, 50.0}) {  // sticks, slides
    TwoDiscs s({{-1, -2}, 1.0 / 4, {3}}, {{0.5, 1}, 1.0, {-1}});
    s.motion[0].rim[0] = slip;
    s.collide(0);
    EXPECT_GT(s.contacts[0].impulse_n, 1);
    EXPECT_LT(s.residual(), 1e-14);
  }
}

TEST(ContactLaw, TheResidualIsTheApproachOfAContactThatWasNotSolved)
{
  TwoDiscs s({{-1, -2}, 1.0 / 4, {3}}, {{0.5, 1}, 1.0, {-1}});
  EXPECT_NEAR(s.residual(), 3.3, 1e-14);  // -n . (v_a - v_b), more than the sliding velocity 2.6
  s.contacts[0].rebound = 0.5;
  EXPECT_NEAR(s.residual(), 3.8, 1e-14);
}

TEST(ContactLaw, TheResidualIsTheSlidingVelocityThatFrictionCouldHaveStopped)
{
  // On a wall with t = (-1, 0): at rest along the normal, with a load, sliding.
  TwoDiscs s({{-0.3, 0}, 1}, {}, 0, 1);
  s.contacts[0].impulse_n = 4;  // stops 6 m/s
  EXPECT_NEAR(s.residual(), 0.3, 1e-14);
  s.contacts[0].impulse_n = 0.1;  // W_tt mu p_n = 3 x 0.5 x 0.1 m/s
  EXPECT_NEAR(s.residual(), 0.15, 1e-14);
}

TEST(ContactLaw, TheResidualShowsAnImpulseOnDiscsThatSeparateAndFrictionOutsideTheCone)
{
  TwoDiscs parting({{0, 2}, 1}, {}, 0, 1);
  parting.contacts[0].impulse_n = 0.5;  // the whole impulse is removed: W_nn p_n = 0.5 m/s
  EXPECT_NEAR(parting.residual(), 0.5, 1e-14);
  TwoDiscs pulled({{0, 0}, 1}, {}, 0, 1);
  pulled.contacts[0].impulse_n = -0.5;
  EXPECT_NEAR(pulled.residual(), 0.5, 1e-14);
  TwoDiscs rough({{0, 0}, 1}, {}, 0, 1);
  rough.contacts[0].impulse_n = 1;
  rough.contacts[0].impulse_t[0] = 0.7;  // Coulomb's limit is 0.5; W_tt = 3
  EXPECT_NEAR(rough.residual(), 0.6, 1e-14);
}

TEST(ContactLaw, EveryLawIsItsForecastMarginAndHorizon)
{
  const auto of = [](ContactLaw law) {
    const auto p = law_parameters(law, 0.75, 2e-4, 10, 4e-3);
    return std::array{p.forecast, p.margin, p.horizon};
  };
  EXPECT_EQ(of(ContactLaw::touch), (std::array{0.0, 0.0, 0.0}));
  EXPECT_EQ(of(ContactLaw::centred), (std::array{0.5, 0.0, 0.0}));
  EXPECT_EQ(of(ContactLaw::predictive), (std::array{1.0, 0.0, 0.0}));
  const auto [forecast, margin, horizon] = of(ContactLaw::speculative);
  EXPECT_EQ(forecast, 0.75);
  EXPECT_EQ(horizon, 0.75);
  EXPECT_NEAR(margin, 0.75 * 2e-4 * 0.2, 1e-18);  // horizon h sqrt(g d_S)
}

TEST(ContactLaw, APairThatTouchesReboundsAtOnceAndOneStillApartAStepLater)
{
  const double e = 0.25, horizon = 0.5, u = -2;  // s, m/s
  const auto rebound = [&](double gap, double impulse_n, double remembered) {
    const auto r = law::rebound_of<true, true>(gap, u, impulse_n, remembered, e, horizon);
    return std::pair{r.velocity, r.remembered};
  };
  EXPECT_EQ(rebound(0, 0, 0), std::pair(0.5, 0.0));  // e |u|
  EXPECT_EQ(rebound(-0.1, 3, 0), std::pair(0.5, 0.0));
  EXPECT_EQ(rebound(0.1, 0, 0), std::pair(-0.2, 2.0));  // -gap/horizon; |u| is stored
  EXPECT_EQ(rebound(0.1, 3, 0), std::pair(-0.2, 0.0));  // with a load before: nothing is stored
  EXPECT_EQ(rebound(2, 0, 0), std::pair(-4.0, 0.0));    // too slow to close its gap
  EXPECT_EQ(rebound(0.1, 3, 7), std::pair(1.75, 0.0));  // e times the stored speed
  // Without a horizon the disc rebounds at once.
  EXPECT_EQ((law::rebound_of<true, false>(0.1, u, 0.0, 0.0, e, 0).velocity), 0.5);
}

TEST(ContactLaw, APairThatWasPartingMayComeBackWithETimesItsVelocity)
{
  const double e = 0.25, horizon = 0.5;  // s
  const auto rebound = [&](double gap, double load) {
    return law::rebound_of<true, true>(gap, 2.0, load, 0.0, e, horizon).velocity;
  };
  EXPECT_EQ(rebound(0, 0), -0.5);
  EXPECT_EQ(rebound(-0.1, 19), -0.5);
  EXPECT_EQ(rebound(-0.1, 21), 0);   // below parting_error times the load
  EXPECT_EQ(rebound(0.1, 0), -0.5);  // larger than its gap would allow, -0.2
  EXPECT_EQ(rebound(1, 0), -2);      // -gap/horizon
}

/// Numbers of the two motions after an impact.
std::vector<double> after(TwoDiscs s, Effects effects, double friction, double restitution)
{
  s.friction = friction;
  s.collide(restitution, effects);
  std::vector<double> bits;
  for (const auto& m : s.motion) bits.insert(bits.end(), {m.v[0], m.v[1], m.rim[0]});
  return bits;
}

TEST(Effects, FrictionOffEqualsZeroFrictionToTheLastBit)
{
  const TwoDiscs s({{-1, -2}, 1.0 / 4, {3}}, {{0.5, 1}, 1.0, {-1}});
  EXPECT_EQ(after(s, {.friction = false}, 0.5, 0.25), after(s, {}, 0, 0.25));
  EXPECT_NE(after(s, {.friction = false}, 0.5, 0.25), after(s, {}, 0.5, 0.25));
}

TEST(Effects, RestitutionOffEqualsZeroRestitutionToTheLastBit)
{
  const TwoDiscs s({{-1, -2}, 1.0 / 4, {3}}, {{0.5, 1}, 1.0, {-1}});
  EXPECT_EQ(after(s, {.restitution = false}, 0.5, 0.25), after(s, {}, 0.5, 0));
  EXPECT_NE(after(s, {.restitution = false}, 0.5, 0.25), after(s, {}, 0.5, 0.25));
}

}  // namespace
}  // namespace grseg
