// The hand-written tangents against automatic differentiation of the laws written a second time: in
// plain components, with matrix series and iterations in place of eigenvalues.
#include <gtest/gtest.h>

#include <scree/material/logarithmic_strain.h>

#include <Sacado.hpp>
#include <algorithm>
#include <iostream>

#include "increment_points.h"

namespace scree
{
namespace
{
using namespace increment_points;

template <typename Number>
using Matrix = std::array<std::array<Number, 3>, 3>;

using Fad = Sacado::Fad::SFad<double, 9>;

template <typename Number>
Matrix<Number>
diagonal(const Number &value)
{
  Matrix<Number> result;
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      result[i][j] = i == j ? value : Number(0);
  return result;
}

template <typename Number>
Matrix<Number>
product(const Matrix<Number> &a, const Matrix<Number> &b)
{
  Matrix<Number> result = diagonal(Number(0));
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      for (unsigned int k = 0; k < 3; ++k)
        result[i][j] += a[i][k] * b[k][j];
  return result;
}

/** `a + factor b`. */
template <typename Number>
Matrix<Number>
sum(const Matrix<Number> &a, const Matrix<Number> &b, const Number &factor)
{
  Matrix<Number> result = a;
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      result[i][j] += factor * b[i][j];
  return result;
}

template <typename Number>
Matrix<Number>
transposed(const Matrix<Number> &a)
{
  Matrix<Number> result;
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      result[i][j] = a[j][i];
  return result;
}

template <typename Number>
Number
trace(const Matrix<Number> &a)
{
  return a[0][0] + a[1][1] + a[2][2];
}

template <typename Number>
Matrix<Number>
cofactor(const Matrix<Number> &a)
{
  Matrix<Number> result;
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      {
        const unsigned int p = (i + 1) % 3, q = (i + 2) % 3, r = (j + 1) % 3, s = (j + 2) % 3;
        result[i][j] = a[p][r] * a[q][s] - a[p][s] * a[q][r];
      }
  return result;
}

template <typename Number>
Number
determinant(const Matrix<Number> &a)
{
  const Matrix<Number> c = cofactor(a);
  return a[0][0] * c[0][0] + a[0][1] * c[0][1] + a[0][2] * c[0][2];
}

/** `a^{-T}`. */
template <typename Number>
Matrix<Number>
inverse_transposed(const Matrix<Number> &a)
{
  const Number   factor = 1 / determinant(a);
  Matrix<Number> result = cofactor(a);
  for (auto &row : result)
    for (Number &entry : row)
      entry *= factor;
  return result;
}

/** `ln b = 2 sum_k z^(2k+1)/(2k+1)`, `z = (b - I)(b + I)^{-1}`: no eigenvalues. */
template <typename Number>
Matrix<Number>
logarithm(const Matrix<Number> &b)
{
  const Matrix<Number> one = diagonal(Number(1));
  const Matrix<Number> z
    = product(sum(b, one, Number(-1)), transposed(inverse_transposed(sum(b, one, Number(1)))));
  const Matrix<Number> square = product(z, z);
  Matrix<Number>       power = z, result = diagonal(Number(0));
  for (unsigned int k = 0; k < 80; ++k)
    {
      result = sum(result, power, Number(2. / (2 * k + 1)));
      power  = product(power, square);
    }
  return result;
}

/** The rotation of `F`: the limit of `R <- (R + R^{-T})/2`. */
template <typename Number>
Matrix<Number>
rotation(const Matrix<Number> &F)
{
  Matrix<Number> R = F;
  for (unsigned int i = 0; i < 12; ++i)
    R = sum(diagonal(Number(0)), sum(R, inverse_transposed(R), Number(1)), Number(0.5));
  return R;
}

template <typename Number>
Matrix<Number>
hooke(const Matrix<Number> &strain)
{
  return sum(diagonal(Number(lambda * trace(strain))), strain, Number(2 * mu));
}

template <typename Number>
Matrix<Number>
radial_return(const Matrix<Number> &trial, const double alpha)
{
  const Matrix<Number> s    = sum(trial, diagonal(Number(1)), Number(-trace(trial) / 3));
  const Number         norm = sqrt(trace(product(s, s)));
  const Number         f = norm - std::sqrt(2. / 3.) * (yield_stress + hardening_modulus * alpha);
  if (f <= 0)
    return trial;
  return sum(trial, s, Number(-2 * mu * f / (2 * mu + 2. / 3. * hardening_modulus) / norm));
}

/** First Piola-Kirchhoff stress `P(F_D)` of the law called `name`. */
template <typename Number>
Matrix<Number>
piola(const std::string &name, const Matrix<Number> &F, const IncrementStart &start)
{
  Matrix<Number> old, F_n;
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      {
        old[i][j] = start.tensor[i][j];
        F_n[i][j] = start.deformation_gradient[i][j];
      }
  const Matrix<Number> one = diagonal(Number(1));
  if (is_total(name))
    {
      const Matrix<Number> total  = product(F, F_n);
      const Matrix<Number> twice  = sum(sum(total, transposed(total), Number(1)), one, Number(-2));
      const Matrix<Number> strain = sum(diagonal(Number(0)), twice, Number(0.5));
      const Matrix<Number> sigma
        = is_plastic(name) ? radial_return(hooke(sum(strain, old, Number(-1))), start.alpha)
                           : hooke(strain);
      return sum(diagonal(Number(0)), product(sigma, transposed(F_n)),
                 Number(1 / start.volume_ratio));
    }
  if (!is_geometric(name))
    {
      const Matrix<Number> twice  = sum(sum(F, transposed(F), Number(1)), one, Number(-2));
      const Matrix<Number> strain = sum(diagonal(Number(0)), twice, Number(0.5));
      return sum(old, hooke(strain), Number(1));
    }
  const Matrix<Number> b   = product(product(F, old), transposed(F));
  const Number         J_D = determinant(F);
  Matrix<Number>       tau;
  if (name == "neo-Hookean")
    tau = sum(diagonal(Number(lambda * log(J_D * start.volume_ratio))), sum(b, one, Number(-1)),
              Number(mu));
  else if (name == "Saint Venant-Kirchhoff")
    {
      const Matrix<Number> strain = sum(diagonal(Number(-0.5)), b, Number(0.5));
      tau                         = product(hooke(strain), b);
    }
  else if (name == "Hencky" || name == "J2")
    {
      const Matrix<Number> trial = hooke(sum(diagonal(Number(0)), logarithm(b), Number(0.5)));
      tau                        = name == "J2" ? radial_return(trial, start.alpha) : trial;
    }
  else
    {
      const Matrix<Number> R = rotation(F);
      const Matrix<Number> strain
        = sum(diagonal(Number(0)), logarithm(product(F, transposed(F))), Number(0.5));
      Matrix<Number> trial = product(product(R, old), transposed(R));
      trial                = sum(trial, hooke(strain), Number(1));
      tau                  = is_plastic(name) ? radial_return(trial, start.alpha) : trial;
      tau                  = sum(diagonal(Number(0)), tau, J_D);
    }
  return sum(diagonal(Number(0)), product(tau, inverse_transposed(F)),
             Number(1 / start.volume_ratio));
}

/** Largest errors of `P` and `dP/dF_D` over their norms. */
template <int dim>
std::array<double, 2>
errors(const std::string &name, const dealii::Tensor<2, dim> &F_D, const IncrementStart &start)
{
  Matrix<Fad> F = diagonal(Fad(1));
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      F[i][j] = Fad(9, 3 * i + j, F_D[i][j]);
  const Matrix<Fad>     expected = piola(name, F, start);
  const auto            result = answer(*make_increment_law<dim>(parameters_of(name)), F_D, start);
  std::array<double, 2> error  = {{0, 0}};
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      {
        error[0] = std::max(error[0], std::abs(result.response.piola[i][j] - expected[i][j].val()));
        for (unsigned int k = 0; k < dim; ++k)
          for (unsigned int l = 0; l < dim; ++l)
            error[1] = std::max(
              error[1], std::abs(result.tangent[i][j][k][l] - expected[i][j].dx(3 * k + l)));
      }
  return {{error[0] / young, error[1] / young}};
}

template <int dim>
void
check_against_sacado()
{
  std::mt19937 generator(11 + dim);
  for (const std::string &name : increment_laws())
    {
      std::array<double, 2> largest = {{0, 0}};
      unsigned int          n_flow = 0, n_elastic = 0;
      for (unsigned int sample = 0; sample < 100; ++sample)
        {
          const auto                   law     = make_increment_law<dim>(parameters_of(name));
          PointHistory<dim>            history = random_history(generator, *law);
          const double                 size    = sample % 2 == 0 ? 0.01 : 0.2;
          const dealii::Tensor<2, dim> forth   = unit<dim>() + random_tensor<dim>(generator, size);
          dealii::Tensor<2, dim>       F_D     = forth;
          if (sample % 4 >= 2) // after an increment, back by a part of it: unloading
            {
              const auto response = answer(*law, forth, law->start(history)).response;
              history             = law->finish(history, forth, response);
              F_D                 = unit<dim>() - 0.1 * (forth - unit<dim>());
            }
          const IncrementStart start = law->start(history);
          const auto           error = errors<dim>(name, F_D, start);
          const bool           flow  = answer(*law, F_D, start).response.alpha > start.alpha;
          (flow ? n_flow : n_elastic) += 1;
          for (unsigned int i = 0; i < 2; ++i)
            largest[i] = std::max(largest[i], error[i]);
        }
      std::cout << "  " << dim << "D " << name << ": stress " << largest[0] << " E, tangent "
                << largest[1] << " E (" << n_elastic << " elastic, " << n_flow << " plastic)\n";
      EXPECT_LT(largest[0], 1e-12) << name;
      EXPECT_LT(largest[1], 1e-11) << name;
      EXPECT_GT(n_elastic, 20u) << name;
      EXPECT_EQ(n_flow > 20, is_plastic(name)) << name;
    }
}

TEST(IncrementSacado, StressAndTangent)
{
  check_against_sacado<2>();
  check_against_sacado<3>();
}

/** Equal and nearly equal eigenvalues, from 1e-1 apart to not apart, in turned axes. */
TEST(IncrementSacado, EqualAndNearlyEqualEigenvalues)
{
  std::mt19937 generator(1);
  for (const std::string name :
       {"Hencky", "J2", "linear elastic rotated", "J2 small strain rotated"})
    {
      double largest = 0;
      for (const double stretch : {1., 1.3})
        for (const double apart :
             {0., 1e-17, 1e-16, 3e-16, 1e-15, 1e-14, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 1e-1})
          for (const bool two_equal : {false, true})
            {
              dealii::Tensor<2, 3> stretches = stretch * unit<3>();
              stretches[0][0] += apart;
              stretches[1][1] += two_equal ? apart : 0.5 * apart;
              const dealii::Tensor<2, 3> Q    = random_rotation<3>(generator);
              const dealii::Tensor<2, 3> turn = random_rotation<3>(generator);
              const auto                 law  = make_increment_law<3>(parameters_of(name));
              PointHistory<3>            history;
              if (name.find("rotated") != std::string::npos)
                history.internal[0][1] = 1;
              largest = std::max(largest, errors<3>(name, turn * Q * stretches * transpose(Q),
                                                    law->start(history))[1]);
            }
      std::cout << "  " << name << ": tangent " << largest << " E\n";
      EXPECT_LT(largest, 1e-11) << name;
    }
}

TEST(LogarithmicStrain, TinyStrainsAreNoTrouble)
{
  for (const double size : {0., 1e-310, 1e-170, 1e-140, 1e-20})
    {
      dealii::Tensor<2, 3> shear;
      shear[0][1] = shear[1][0] = size;
      shear[1][2] = shear[2][1] = -size;
      EXPECT_LT((exponential(shear) - unit<3>()).norm(), 1e-15) << size;
    }
}

TEST(LogarithmicStrain, EigensystemAndLogarithmAreAccurate)
{
  std::mt19937 generator(2);
  for (unsigned int sample = 0; sample < 200; ++sample)
    {
      const auto m = random_tensor<3>(generator, std::pow(10., -double(sample % 17)));
      const dealii::Tensor<2, 3> a      = unit<3>() + 0.1 * (m + transpose(m));
      const Eigensystem          system = eigensystem(a);
      dealii::Tensor<2, 3>       principal;
      for (unsigned int i = 0; i < 3; ++i)
        principal[i][i] = system.values[i];
      EXPECT_LT((system.rotate(principal) - a).norm(), 4e-15);
      EXPECT_LT((system.vectors * transpose(system.vectors) - unit<3>()).norm(), 4e-15);

      Matrix<double> b;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          b[i][j] = (a * a)[i][j];
      const Matrix<double>       expected = logarithm(b);
      const dealii::Tensor<2, 3> strain   = LogarithmicStrain(eigensystem(a * a)).value();
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          EXPECT_NEAR(2 * strain[i][j], expected[i][j], 1e-14);
      EXPECT_LT((exponential(2 * strain) - a * a).norm(), 1e-14);
    }
}
} // namespace
} // namespace scree
