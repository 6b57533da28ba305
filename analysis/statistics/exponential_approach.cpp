// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/statistics/exponential_approach.hpp"

#include "analysis/statistics/correlated_windows.hpp"
#include "analysis/statistics/least_squares.hpp"

#include <gsl/gsl_multifit_nlinear.h>

#include <Eigen/LU>
#include <cmath>
#include <memory>

namespace grseg {
namespace {

/// Start, end and rate of the curve for x scaled to the range 0 to 1.
using Parameters = Eigen::Vector3d;

struct Data {
  Eigen::VectorXd x, y;
};

Eigen::VectorXd decay(const Eigen::VectorXd& x, double rate)
{
  return (-rate * x.array()).exp();
}

Eigen::VectorXd residuals(const Data& data, const Parameters& p)
{
  return (data.y.array() - p[1] + (p[1] - p[0]) * decay(data.x, p[2]).array()).matrix();
}

/// Derivatives of the curve with respect to the parameters (columns) at each x (rows).
Eigen::MatrixX3d jacobian(const Data& data, const Parameters& p)
{
  const Eigen::ArrayXd e = decay(data.x, p[2]).array();
  Eigen::MatrixX3d j(data.x.size(), 3);
  j.col(0) = e;
  j.col(1) = 1 - e;
  j.col(2) = (p[1] - p[0]) * data.x.array() * e;
  return j;
}

/// Parameters of the best fit at a given rate, which is linear in start and end.
Parameters best_for(const Data& data, double rate)
{
  Eigen::MatrixX2d basis(data.x.size(), 2);
  basis.col(0) = decay(data.x, rate);
  basis.col(1) = 1 - basis.col(0).array();
  const Eigen::Vector2d ends = LeastSquares(basis).solve(data.y);
  return {ends[0], ends[1], rate};
}

Parameters first_guess(const Data& data)
{
  Parameters best = best_for(data, 1);
  for (int power = -6; power <= 13; ++power) {
    const auto p = best_for(data, std::ldexp(1.0, power));
    if (residuals(data, p).squaredNorm() < residuals(data, best).squaredNorm()) best = p;
  }
  return best;
}

Parameters as_parameters(const gsl_vector* p)
{
  return {gsl_vector_get(p, 0), gsl_vector_get(p, 1), gsl_vector_get(p, 2)};
}

int fill_residuals(const gsl_vector* p, void* data, gsl_vector* f)
{
  const auto r = residuals(*static_cast<const Data*>(data), as_parameters(p));
  for (Eigen::Index k = 0; k < r.size(); ++k) gsl_vector_set(f, static_cast<std::size_t>(k), r[k]);
  return GSL_SUCCESS;
}

int fill_jacobian(const gsl_vector* p, void* data, gsl_matrix* out)
{
  const auto j = jacobian(*static_cast<const Data*>(data), as_parameters(p));
  for (Eigen::Index k = 0; k < j.rows(); ++k)
    for (Eigen::Index c = 0; c < 3; ++c)
      gsl_matrix_set(out, static_cast<std::size_t>(k), static_cast<std::size_t>(c), -j(k, c));
  return GSL_SUCCESS;
}

/// Improves the parameters `p`; false if the fit does not converge.
bool least_squares(Data& data, Parameters& p)
{
  const auto n = static_cast<std::size_t>(data.x.size());
  const auto settings = gsl_multifit_nlinear_default_parameters();
  const std::unique_ptr<gsl_multifit_nlinear_workspace, decltype(&gsl_multifit_nlinear_free)> work(
      gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &settings, n, 3),
      &gsl_multifit_nlinear_free);
  gsl_multifit_nlinear_fdf problem{};
  problem.f = fill_residuals;
  problem.df = fill_jacobian;
  problem.n = n;
  problem.p = 3;
  problem.params = &data;
  const auto start = gsl_vector_const_view_array(p.data(), 3);
  gsl_multifit_nlinear_init(&start.vector, &problem, work.get());
  int reason = 0;
  const int status =
      gsl_multifit_nlinear_driver(200, 1e-12, 1e-14, 0, nullptr, nullptr, &reason, work.get());
  p = as_parameters(gsl_multifit_nlinear_position(work.get()));
  // GSL_ENOPROG: no step improves the first guess, e.g. if it is exact and data have no noise.
  return (status == GSL_SUCCESS || reason == GSL_ENOPROG) && p.allFinite();
}

/// Standard errors of linear combinations of the parameters.
class Errors {
 public:
  Errors(const Data& data, const Parameters& p)
  {
    const Eigen::MatrixX3d j = jacobian(data, p);
    const Eigen::Matrix3d inverse = (j.transpose() * j).inverse();
    influences_ = residuals(data, p).asDiagonal() * (j * inverse);
  }
  StandardError of(const Parameters& combination) const
  {
    return standard_error(influences_ * combination, 3);
  }
  const Eigen::MatrixX3d& influences() const { return influences_; }

 private:
  Eigen::MatrixX3d influences_;  // influence of each observation (row) on each parameter (column)
};

/// Reason why the fit has no meaning, or "".
const char* trouble_with(const Parameters& p, const Errors& errors)
{
  const auto rise = errors.of({-1, 1, 0}), rate = errors.of({0, 0, 1});
  if (!(p[2] > rate.reach())) return "cannot be distinguished from a straight line";
  if (!(std::abs(p[1] - p[0]) > rise.reach())) return "changes by no more than its scatter";
  return "";
}

/// Sets the estimates of a fit from scaled parameters; `range` of x is the unit of the scaled x.
void fill(ExponentialApproach& fit, const Parameters& p, const Errors& errors, double range)
{
  fit.start = errors.of({1, 0, 0}).around(p[0]);
  fit.end = errors.of({0, 1, 0}).around(p[1]);
  const double reach = errors.of({0, 0, 1}).reach();
  fit.scale = {range / p[2], range / (p[2] + reach), range / (p[2] - reach)};
}

}  // namespace

ExponentialApproach fit_approach(const Eigen::VectorXd& x, const Eigen::VectorXd& y)
{
  ExponentialApproach fit;
  const auto n = x.size();
  if (n < 8) {
    fit.trouble = "has too few frames";
    return fit;
  }
  if (!x.allFinite() || !y.allFinite()) {
    fit.trouble = "is not known in every frame";
    return fit;
  }
  const double range = x[n - 1] - x[0], height = y.maxCoeff() - y.minCoeff();
  if (!(range > 0) || !(height > 0)) {
    fit.trouble = "does not change";
    return fit;
  }
  // Scaled so that y begins at 1, not 0: convergence is judged by a step over its parameter.
  const double origin = y[0] - height;
  Data data{(x.array() - x[0]) / range, (y.array() - origin) / height};
  auto p = first_guess(data);
  if (!least_squares(data, p)) {
    fit.trouble = "is not an exponential approach";
    return fit;
  }
  const Errors errors(data, p);
  fit.trouble = trouble_with(p, errors);
  if (!fit.trouble.empty()) return fit;
  fill(fit, p, errors, range);
  for (auto* level : {&fit.start, &fit.end})
    *level = {origin + height * level->value, origin + height * level->low,
              origin + height * level->high};
  fit.influences = height * errors.influences().leftCols<2>();
  fit.scatter = height * std::sqrt(residuals(data, p).squaredNorm() / static_cast<double>(n - 3));
  return fit;
}

Estimate time_to(double part, const ExponentialApproach& fit, const Eigen::VectorXd& x,
                 const Eigen::VectorXd& y)
{
  if (!fit.trouble.empty()) return {};
  const double rise = fit.end.value - fit.start.value, level = fit.start.value + part * rise;
  const auto passed = [&](Eigen::Index k) { return (y[k] - level) * rise >= 0; };
  Eigen::Index k = 0;
  while (k < y.size() && !passed(k)) ++k;
  if (k == y.size()) return {};
  const double between = k == 0 ? 0 : (level - y[k - 1]) / (y[k] - y[k - 1]);
  const double when = k == 0 ? 0 : x[k - 1] - x[0] + between * (x[k] - x[k - 1]);

  auto error = standard_error(fit.influences * Eigen::Vector2d{1 - part, part}, 3);
  const double speed = std::abs(rise) * (1 - part) / fit.scale.value;
  error.error = std::hypot(error.error, fit.scatter) / speed;
  return error.around(when);
}

}  // namespace grseg
