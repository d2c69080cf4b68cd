#include <scree/base/joint_sum.h>
#include <scree/output/mean_motion.h>

#include <cmath>

namespace scree
{
namespace
{
/** Integrals over a body, of places relative to the centre of its box. */
template <int dim>
struct Moments
{
  double                 volume = 0.;
  dealii::Tensor<1, dim> now, displacement;
  dealii::Tensor<2, dim> now_then; //!< int x X^T
};

template <int dim>
std::vector<Moments<dim>>
moments(const DisplacementSpace<dim> &space, const std::vector<Body<dim>> &bodies,
        const CutQuadrature<dim> &quadrature, const PointEvaluator<dim> &u_n,
        const PointEvaluator<dim> &u)
{
  std::vector<Moments<dim>> result(bodies.size());
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    {
      const ActiveCell  &cell  = space.cells()[a];
      const auto        &whole = quadrature.whole_cell;
      const auto        &cut   = quadrature.bulk;
      Moments<dim>      &sum   = result[cell.body];
      const double       scale = cell.is_cut ? 1. : std::pow(space.cell_size(a), dim);
      const unsigned int first = cell.is_cut ? cut.begin[a] : 0;
      const unsigned int last  = cell.is_cut ? cut.begin[a + 1] : whole.points.size();
      for (unsigned int q = first; q < last; ++q)
        {
          const PointInCell<dim> point  = {a, (cell.is_cut ? cut.points : whole.points)[q]};
          const double           weight = scale * (cell.is_cut ? cut.weights : whole.weights)[q];
          const auto             step   = u.value(point);
          const auto             before = u_n.value(point);
          const dealii::Tensor<1, dim> x
            = space.position(a, point.unit_point) - bodies[cell.body].box.center();
          sum.volume += weight;
          sum.now += weight * (x + step);
          sum.displacement += weight * (before + step);
          sum.now_then += weight * outer_product(x + step, x - before);
        }
    }
  JointSum sum;
  for (auto &of_body : result)
    {
      sum.add(of_body.volume);
      sum.add(of_body.now);
      sum.add(of_body.displacement);
      sum.add(of_body.now_then);
    }
  sum.reduce(space.grid.communicator());
  return result;
}
} // namespace

template <int dim>
std::vector<MeanMotion<dim>>
mean_motions(const DisplacementSpace<dim> &space, const std::vector<Body<dim>> &bodies,
             const CutQuadrature<dim> &quadrature, const Kinematics<dim> &kinematics,
             const dealii::TrilinosWrappers::MPI::Vector &u)
{
  std::vector<MeanMotion<dim>> result(bodies.size());
  const auto sums = moments(space, bodies, quadrature, kinematics.start_displacement_field(),
                            PointEvaluator<dim>(space, u));
  for (unsigned int b = 0; b < bodies.size(); ++b)
    if (!bodies[b].is_rigid())
      {
        const double volume    = sums[b].volume;
        const auto   centre    = bodies[b].box.center();
        const auto   then      = sums[b].now - sums[b].displacement;
        result[b].position     = centre + sums[b].now / volume;
        result[b].displacement = sums[b].displacement / volume;
        result[b].rotation
          = rotation_vector<dim>(sums[b].now_then - outer_product(sums[b].now, then) / volume);
      }
  return result;
}

template <int dim>
dealii::Tensor<1, 3>
rotation_vector(const dealii::Tensor<2, dim> &matrix)
{
  dealii::Tensor<1, 3> result;
  if constexpr (dim == 2)
    result[2] = std::atan2(matrix[1][0] - matrix[0][1], matrix[0][0] + matrix[1][1]);
  else
    {
      // Newton's iteration R <- (R + R^-T)/2.
      dealii::Tensor<2, 3> R      = matrix * std::pow(determinant(matrix), -1. / 3.);
      double               change = 1.;
      for (unsigned int i = 0; i < 100 && change > 1e-15; ++i)
        {
          const dealii::Tensor<2, 3> next = 0.5 * (R + transpose(invert(R)));
          change                          = (next - R).norm();
          R                               = next;
        }
      // 2 sin(angle) axis, where it does not vanish.
      result[0]         = R[2][1] - R[1][2];
      result[1]         = R[0][2] - R[2][0];
      result[2]         = R[1][0] - R[0][1];
      const double sine = 0.5 * result.norm();
      if (sine > 0.)
        result *= 0.5 * std::atan2(sine, 0.5 * (trace(R) - 1.)) / sine;
    }
  return result;
}

#define SCREE_INSTANTIATE(dim)                                                                  \
  template std::vector<MeanMotion<dim>> mean_motions(                                           \
    const DisplacementSpace<dim> &, const std::vector<Body<dim>> &, const CutQuadrature<dim> &, \
    const Kinematics<dim> &, const dealii::TrilinosWrappers::MPI::Vector &);                    \
  template dealii::Tensor<1, 3> rotation_vector(const dealii::Tensor<2, dim> &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
