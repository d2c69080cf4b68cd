#include <scree/mechanics/rigid_motion.h>

#include <cmath>

namespace scree
{
template <int dim>
dealii::Tensor<1, dim>
RigidMotions<dim>::finite_motion(const std::array<double, n_motions> &q,
                                 const dealii::Point<dim>            &position) const
{
  dealii::Tensor<1, 3> v, omega, arm;
  for (unsigned int d = 0; d < dim; ++d)
    {
      v[d]   = q[d];
      arm[d] = position[d] - centre[d];
    }
  for (unsigned int m = dim; m < n_motions; ++m)
    omega[dim == 2 ? 2 : m - dim] = q[m] / size;
  // (R - I) arm + V v, Rodrigues' formulas.
  const double angle = omega.norm(), half = std::sin(0.5 * angle);
  const double one    = angle == 0. ? 1. : std::sin(angle) / angle;
  const double two    = angle == 0. ? 0.5 : 2. * half * half / (angle * angle);
  const double three  = angle < 1e-3 ? 1. / 6. : (1. - one) / (angle * angle);
  const auto   turned = [&](const dealii::Tensor<1, 3> &x) { return cross_product_3d(omega, x); };
  const auto   sum
    = one * turned(arm) + two * (turned(turned(arm)) + turned(v)) + v + three * turned(turned(v));
  dealii::Tensor<1, dim> result;
  for (unsigned int d = 0; d < dim; ++d)
    result[d] = sum[d];
  return result;
}

template <int dim>
std::vector<dealii::TrilinosWrappers::MPI::Vector>
near_null_space(const DisplacementSpace<dim> &space, const std::vector<Body<dim>> &bodies)
{
  using Vector                     = dealii::TrilinosWrappers::MPI::Vector;
  constexpr unsigned int n_motions = RigidMotions<dim>::n_motions;

  std::vector<Vector> result(n_motions, Vector(space.owned(), space.grid.communicator()));
  const std::vector<RigidMotions<dim>> motions(bodies.begin(), bodies.end());
  for (unsigned int a = 0; a < space.cells().size(); ++a)
    {
      const ActiveCell &cell = space.cells()[a];
      for (unsigned int i = 0; i < space.basis.n_nodes; ++i)
        {
          const dealii::Point<dim> position = space.position(a, space.basis.node(i));
          for (unsigned int m = 0; m < n_motions; ++m)
            {
              const auto value = motions[cell.body].motion(m, position);
              for (unsigned int d = 0; d < dim; ++d)
                if (space.owned().is_element(space.nodes(a)[i] + d))
                  result[m](space.nodes(a)[i] + d) = value[d];
            }
        }
    }
  for (Vector &motion : result)
    motion.compress(dealii::VectorOperation::insert);
  return result;
}

template std::vector<dealii::TrilinosWrappers::MPI::Vector>
near_null_space(const DisplacementSpace<2> &, const std::vector<Body<2>> &);
template std::vector<dealii::TrilinosWrappers::MPI::Vector>
near_null_space(const DisplacementSpace<3> &, const std::vector<Body<3>> &);
template class RigidMotions<2>;
template class RigidMotions<3>;
} // namespace scree
