#include <scree/mechanics/free_bodies.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>
#include <numeric>

// Motions of free bodies as unknowns of the displacement, and forces on them.
namespace scree
{
template <int dim>
std::array<double, FreeBodies<dim>::Motions::n_motions>
FreeBodies<dim>::motions_of(const unsigned int i, const unsigned int j, const double *u) const
{
  std::array<double, Motions::n_motions> result = {};
  const unsigned int                     n      = bases[i].n();
  if (!u || !turns_finitely || bodies[free_motions[i].body].is_rigid())
    {
      std::copy_n(start_motions[i].begin() + j * n, n, result.begin());
      return result;
    }
  const unsigned int component = free_components[i][j];
  dealii::Point<dim> x         = positions[i][j];
  for (unsigned int d = 0; d < dim; ++d)
    x[d] += u[places[i][j] - component + d];
  for (unsigned int k = 0; k < n; ++k)
    result[k] = motion(i, k, x)[component];
  return result;
}

template <int dim>
std::vector<dealii::FullMatrix<double>>
FreeBodies<dim>::inverse_masses(const Vector &mass, const Vector *u) const
{
  constexpr unsigned int n = Motions::n_motions;
  std::vector<double>    sums(free_motions.size() * n * n, 0.);
  for (unsigned int i = 0; i < free_motions.size(); ++i)
    for (unsigned int j = 0; j < free_unknowns[i].size(); ++j)
      {
        const auto   modes = motions_of(i, j, u ? u->begin() : nullptr);
        const double m     = mass.begin()[places[i][j]];
        for (unsigned int k = 0; k < bases[i].n(); ++k)
          for (unsigned int l = 0; l < bases[i].n(); ++l)
            sums[(i * n + k) * n + l] += m * modes[k] * modes[l];
      }
  dealii::Utilities::MPI::sum(sums, communicator, sums);
  std::vector<dealii::FullMatrix<double>> result;
  for (unsigned int i = 0; i < free_motions.size(); ++i)
    {
      dealii::FullMatrix<double> matrix(bases[i].n(), bases[i].n());
      for (unsigned int k = 0; k < bases[i].n(); ++k)
        for (unsigned int l = 0; l < bases[i].n(); ++l)
          matrix(k, l) = sums[(i * n + k) * n + l];
      matrix.gauss_jordan();
      result.push_back(matrix);
    }
  return result;
}

template <int dim>
typename FreeBodies<dim>::Coordinates
FreeBodies<dim>::times(const std::vector<dealii::FullMatrix<double>> &matrices,
                       const Coordinates                             &coordinates) const
{
  Coordinates result(n_coordinates, 0.);
  for (unsigned int i = 0; i < free_motions.size(); ++i)
    for (unsigned int k = 0; k < bases[i].n(); ++k)
      for (unsigned int l = 0; l < bases[i].n(); ++l)
        result[first[i] + k] += matrices[i](k, l) * coordinates[first[i] + l];
  return result;
}

template <int dim>
void
FreeBodies<dim>::add_small(const double factor, const Coordinates &motion, const Vector *u,
                           const Vector *mass, Vector &result) const
{
  for (unsigned int i = 0; i < free_motions.size(); ++i)
    for (unsigned int j = 0; j < free_unknowns[i].size(); ++j)
      {
        const unsigned int place = places[i][j];
        const auto         modes = motions_of(i, j, u ? u->begin() : nullptr);
        const double       sum   = std::inner_product(modes.begin(), modes.begin() + bases[i].n(),
                                                      motion.begin() + first[i], 0.);
        result.begin()[place] += factor * (mass ? mass->begin()[place] : 1.) * sum;
      }
}

template <int dim>
typename FreeBodies<dim>::Coordinates
FreeBodies<dim>::rotations(const Coordinates &motion) const
{
  Coordinates result(n_coordinates, 0.);
  for (unsigned int i = 0; i < free_motions.size(); ++i)
    for (unsigned int m = dim; m < Motions::n_motions; ++m)
      {
        double turn = 0.;
        for (unsigned int k = 0; k < bases[i].n(); ++k)
          turn += bases[i](m, k) * motion[first[i] + k];
        for (unsigned int k = 0; k < bases[i].n(); ++k)
          result[first[i] + k] += bases[i](m, k) * turn;
      }
  return result;
}

template <int dim>
std::vector<double>
FreeBodies<dim>::contact_on_bodies() const
{
  std::vector<double> result(free_motions.size(), 0.);
  for (unsigned int i = 0; i < contact.points().size(); ++i)
    {
      const ContactPoint<dim> &point = contact.points()[i];
      const double force = point.weight * contact.responses()[i].traction(point.normal).norm();
      for (const unsigned int body : {contact.pairs()[point.pair].a, contact.pairs()[point.pair].b})
        if (number_of[body] != none)
          result[number_of[body]] += force;
    }
  dealii::Utilities::MPI::sum(result, communicator, result);
  return result;
}

template <int dim>
void
FreeBodies<dim>::add_moments(const JointMotions &motions, const Coordinates &forces,
                             Coordinates &moments) const
{
  constexpr double   smallest_turn = 1e-2; // part of a motion
  const auto        &coordinates   = motions.coordinates;
  const unsigned int n             = motions.vectors.n();
  if (n == 0)
    return;
  // M = P Z (Z^T P Z)^+ Z^T F
  dealii::FullMatrix<double>       turns(coordinates.size(), n), products(n, n);
  dealii::LAPACKFullMatrix<double> matrix(n, n);
  dealii::Vector<double>           part(n), factors(n);
  for (unsigned int j = 0; j < n; ++j)
    {
      Coordinates motion(n_coordinates, 0.);
      for (unsigned int k = 0; k < coordinates.size(); ++k)
        {
          motion[coordinates[k]] = motions.vectors(k, j);
          part[j] += motions.vectors(k, j) * forces[coordinates[k]];
        }
      motion = rotations(motion);
      for (unsigned int k = 0; k < coordinates.size(); ++k)
        turns(k, j) = motion[coordinates[k]];
    }
  motions.vectors.Tmmult(products, turns);
  matrix = products;
  matrix.compute_svd();
  moments.resize(n_coordinates, 0.);
  if (matrix.singular_value(0) <= smallest_turn)
    return;
  matrix.compute_inverse_svd(smallest_turn / matrix.singular_value(0));
  matrix.vmult(factors, part);
  for (unsigned int k = 0; k < coordinates.size(); ++k)
    for (unsigned int j = 0; j < n; ++j)
      moments[coordinates[k]] += turns(k, j) * factors[j];
}

template <int dim>
typename FreeBodies<dim>::MisplacedMoments
FreeBodies<dim>::misplaced_moments(const Coordinates &forces, const double share) const
{
  double coarsest = 0.;
  for (unsigned int i = 0; i < free_motions.size(); ++i)
    coarsest = std::max(coarsest, tolerance(i));
  Coordinates moments;
  for (const JointMotions &motions : not_resisted(4. * coarsest * coarsest))
    add_moments(motions, forces, moments);
  if (moments.empty())
    return {};
  const std::vector<double> contact_forces = contact_on_bodies();
  double                    scale          = 1.;
  for (unsigned int i = 0; i < free_motions.size(); ++i)
    if (const double moment = magnitude(moments, i); moment > 0.)
      scale = std::min(scale, share * tolerance(i) * contact_forces[i] / moment);
  for (double &moment : moments)
    moment *= scale;
  return {moments, scale};
}

template <int dim>
void
FreeBodies<dim>::subtract(const Coordinates &forces, const Vector &mass, Vector &r) const
{
  add_small(-1., times(inverse_masses(mass, nullptr), forces), nullptr, &mass, r);
}

template <int dim>
typename FreeBodies<dim>::Coordinates
FreeBodies<dim>::rigid_part(const Vector &du, const Vector &mass, const Vector *u) const
{
  Coordinates forces(n_coordinates, 0.); // R^T M du
  for (unsigned int i = 0; i < free_motions.size(); ++i)
    for (unsigned int j = 0; j < free_unknowns[i].size(); ++j)
      {
        const unsigned int place    = places[i][j];
        const auto         modes    = motions_of(i, j, u ? u->begin() : nullptr);
        const double       momentum = mass.begin()[place] * du.begin()[place];
        for (unsigned int k = 0; k < bases[i].n(); ++k)
          forces[first[i] + k] += modes[k] * momentum;
      }
  dealii::Utilities::MPI::sum(forces, communicator, forces);
  return times(inverse_masses(mass, u), forces);
}

template <int dim>
typename FreeBodies<dim>::Vector
FreeBodies<dim>::strained(const Vector &u, const Vector &u_0, const Vector &mass) const
{
  Vector du(u), result(u);
  du -= u_0;
  Coordinates q = rigid_part(du, mass, nullptr);
  for (unsigned int i = 0; i < free_motions.size(); ++i)
    if (bodies[free_motions[i].body].is_rigid())
      std::fill_n(q.begin() + first[i], bases[i].n(), 0.);
  add_small(-1., q, nullptr, nullptr, result);
  return result;
}

template <int dim>
void
FreeBodies<dim>::advance(const Vector &du, const Vector &mass, Vector &u) const
{
  const Coordinates q = rigid_part(du, mass, &u);
  const Vector      start(u);
  u += du;
  add_small(-1., q, &start, nullptr, u);
  add(q, u);
}

template <int dim>
void
FreeBodies<dim>::add(const Coordinates &motion, Vector &u, const bool infinitesimally) const
{
  const Vector before(u);
  for (unsigned int i = 0; i < free_motions.size(); ++i)
    {
      const bool                             is_rigid = bodies[free_motions[i].body].is_rigid();
      std::array<double, Motions::n_motions> q        = {};
      for (unsigned int m = 0; m < q.size(); ++m)
        for (unsigned int k = 0; k < bases[i].n(); ++k)
          q[m] += bases[i](m, k) * motion[first[i] + k];
      for (unsigned int j = 0; j < free_unknowns[i].size(); ++j)
        {
          const unsigned int component = free_components[i][j];
          double             increment = 0.;
          if (is_rigid)
            increment = q[component];
          else if (turns_finitely && !infinitesimally)
            {
              auto x = positions[i][j];
              for (unsigned int d = 0; d < dim; ++d)
                x[d] += before.begin()[places[i][j] - component + d];
              increment = rigid_motions[i].finite_motion(q, x)[component];
            }
          else
            for (unsigned int m = 0; m < q.size(); ++m)
              increment += q[m] * rigid_motions[i].motion(m, positions[i][j])[component];
          u.begin()[places[i][j]] += increment;
        }
    }
}

#define SCREE_INSTANTIATE(dim)                                                                   \
  template FreeBodies<dim>::MisplacedMoments FreeBodies<dim>::misplaced_moments(                 \
    const std::vector<double> &, const double) const;                                            \
  template void FreeBodies<dim>::subtract(const std::vector<double> &, const Vector &, Vector &) \
    const;                                                                                       \
  template dealii::TrilinosWrappers::MPI::Vector FreeBodies<dim>::strained(                      \
    const Vector &, const Vector &, const Vector &) const;                                       \
  template void FreeBodies<dim>::advance(const Vector &, const Vector &, Vector &) const;        \
  template void FreeBodies<dim>::add(const std::vector<double> &, Vector &, const bool) const;

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
