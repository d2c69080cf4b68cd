#include <scree/mechanics/rigid_motion.h>

namespace scree
{
template <int dim>
std::vector<dealii::TrilinosWrappers::MPI::Vector>
near_null_space(const Fields<dim> &fields, const std::vector<Body<dim>> &bodies)
{
  using Vector                     = dealii::TrilinosWrappers::MPI::Vector;
  constexpr unsigned int n_motions = RigidMotions<dim>::n_motions;

  std::vector<Vector> result(n_motions, Vector(fields.owned(), fields.grid.communicator()));
  std::vector<RigidMotions<dim>> motions;
  for (const auto &body : bodies)
    motions.emplace_back(body);
  for (unsigned int a = 0; a < fields.cells().size(); ++a)
    {
      const ActiveCell &cell     = fields.cells()[a];
      const auto       &geometry = fields.grid.cells()[cell.grid_cell];
      for (unsigned int i = 0; i < fields.basis.n_nodes; ++i)
        {
          const dealii::Point<dim> position
            = geometry.lower + geometry.size * dealii::Tensor<1, dim>(fields.basis.node(i));
          for (unsigned int m = 0; m < n_motions; ++m)
            {
              const auto value = motions[cell.body].motion(m, position);
              for (unsigned int d = 0; d < dim; ++d)
                if (fields.owned().is_element(fields.nodes(a)[i] + d))
                  result[m](fields.nodes(a)[i] + d) = value[d];
            }
        }
    }
  for (Vector &motion : result)
    motion.compress(dealii::VectorOperation::insert);
  return result;
}

template std::vector<dealii::TrilinosWrappers::MPI::Vector>
near_null_space(const Fields<2> &, const std::vector<Body<2>> &);
template std::vector<dealii::TrilinosWrappers::MPI::Vector>
near_null_space(const Fields<3> &, const std::vector<Body<3>> &);
} // namespace scree
