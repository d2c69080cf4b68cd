#include <scree/mechanics/free_bodies.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <numeric>

// Motions of free bodies as unknowns of the displacement, and forces on them.
namespace scree
{
template <int dim>
std::array<double, FreeBodies<dim>::Motions::n_motions>
FreeBodies<dim>::motions_of(const unsigned int i, const unsigned int j, const Vector *u) const
{
  std::array<double, Motions::n_motions> result    = {};
  const unsigned int                     component = free_components[i][j];
  const bool                             is_rigid  = bodies[free_motions[i].body].is_rigid();
  dealii::Point<dim>                     x;
  if (!is_rigid)
    {
      x = positions[i][j];
      for (unsigned int d = 0; d < dim && turns_finitely && u; ++d)
        x[d] += (*u)(free_unknowns[i][j] - component + d);
    }
  for (unsigned int k = 0; k < bases[i].n(); ++k)
    result[k] = is_rigid ? bases[i](component, k) : motion(i, k, x)[component];
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
        const auto modes = motions_of(i, j, u);
        for (unsigned int k = 0; k < bases[i].n(); ++k)
          for (unsigned int l = 0; l < bases[i].n(); ++l)
            sums[(i * n + k) * n + l] += mass(free_unknowns[i][j]) * modes[k] * modes[l];
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
        const DofIndex unknown = free_unknowns[i][j];
        const auto     modes   = motions_of(i, j, u);
        const double   sum     = std::inner_product(modes.begin(), modes.begin() + bases[i].n(),
                                                    motion.begin() + first[i], 0.);
        result(unknown) += factor * (mass ? (*mass)(unknown) : 1.) * sum;
      }
  result.compress(dealii::VectorOperation::add);
}

template <int dim>
typename FreeBodies<dim>::Coordinates
FreeBodies<dim>::neutral_part(const Coordinates &forces, const Coordinates &loads) const
{
  constexpr double no_work = 1e-3;
  const auto       product = [](const Coordinates &a, const Coordinates &b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.);
  };
  double coarsest = 0.;
  for (unsigned int i = 0; i < free_motions.size(); ++i)
    coarsest = std::max(coarsest, tolerance(i));
  const auto  motions = not_resisted(4. * coarsest * coarsest);
  Coordinates weak(n_coordinates, 0.), driven(n_coordinates, 0.); // parts of forces and loads
  for (const Coordinates &motion : motions)
    for (unsigned int k = 0; k < n_coordinates; ++k)
      {
        weak[k] += product(motion, forces) * motion[k];
        driven[k] += product(motion, loads) * motion[k];
      }
  if (const double square = product(driven, driven);
      std::sqrt(square) > no_work * std::sqrt(product(loads, loads)))
    {
      const double along = product(driven, weak) / square;
      for (unsigned int k = 0; k < n_coordinates; ++k)
        weak[k] -= along * driven[k];
    }
  const double size = std::sqrt(product(weak, weak));
  if (size == 0.)
    return {};
  std::vector<double> acting(free_motions.size(), 0.);
  for (unsigned int i = 0; i < contact.points().size(); ++i)
    for (const unsigned int body :
         {contact.pairs()[contact.points()[i].pair].a, contact.pairs()[contact.points()[i].pair].b})
      if (number_of[body] != none)
        acting[number_of[body]]
          += contact.points()[i].weight
             * contact.responses()[i].traction(contact.points()[i].normal).norm();
  dealii::Utilities::MPI::sum(acting, communicator, acting);
  double allowed = 0.;
  for (unsigned int i = 0; i < free_motions.size(); ++i)
    allowed = std::hypot(allowed, magnitude(weak, i) / size * 2. * tolerance(i) * acting[i]);
  return size > allowed ? Coordinates() : weak;
}

template <int dim>
void
FreeBodies<dim>::subtract(const Coordinates &forces, const Vector &mass, Vector &r) const
{
  add_small(-1., times(inverse_masses(mass, nullptr), forces), nullptr, &mass, r);
}

template <int dim>
void
FreeBodies<dim>::advance(const Vector &du, const Vector &mass, Vector &u) const
{
  Coordinates forces(n_coordinates, 0.); // R^T M du
  for (unsigned int i = 0; i < free_motions.size(); ++i)
    for (unsigned int j = 0; j < free_unknowns[i].size(); ++j)
      {
        const auto modes = motions_of(i, j, &u);
        for (unsigned int k = 0; k < bases[i].n(); ++k)
          forces[first[i] + k] += mass(free_unknowns[i][j]) * modes[k] * du(free_unknowns[i][j]);
      }
  dealii::Utilities::MPI::sum(forces, communicator, forces);
  const Coordinates q = times(inverse_masses(mass, &u), forces);
  const Vector      start(u);
  u += du;
  add_small(-1., q, &start, nullptr, u);
  add(q, u);
}

template <int dim>
void
FreeBodies<dim>::add(const Coordinates &motion, Vector &u) const
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
          else if (turns_finitely)
            {
              auto x = positions[i][j];
              for (unsigned int d = 0; d < dim; ++d)
                x[d] += before(free_unknowns[i][j] - component + d);
              increment = rigid_motions[i].finite_motion(q, x)[component];
            }
          else
            for (unsigned int m = 0; m < q.size(); ++m)
              increment += q[m] * rigid_motions[i].motion(m, positions[i][j])[component];
          u(free_unknowns[i][j]) += increment;
        }
    }
  u.compress(dealii::VectorOperation::add);
}

#define SCREE_INSTANTIATE(dim)                                                                   \
  template std::vector<double> FreeBodies<dim>::neutral_part(const std::vector<double> &,        \
                                                             const std::vector<double> &) const; \
  template void FreeBodies<dim>::subtract(const std::vector<double> &, const Vector &, Vector &) \
    const;                                                                                       \
  template void FreeBodies<dim>::advance(const Vector &, const Vector &, Vector &) const;        \
  template void FreeBodies<dim>::add(const std::vector<double> &, Vector &) const;

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
