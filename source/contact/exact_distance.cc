#include <scree/contact/exact_distance.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace scree
{
template <int dim>
ExactDistances<dim>::ExactDistances(const Fields<dim> &fields, const std::vector<Body<dim>> &bodies,
                                    const dealii::TrilinosWrappers::MPI::Vector *start_displacement)
    : fields(fields)
    , bodies(bodies)
    , step(1e-6 * fields.grid.finest_size())
{
  for (const Body<dim> &body : bodies)
    {
      poses.emplace_back();
      if (body.is_rigid())
        poses.back().emplace(*body.rigid, body.pose);
    }
  const bool is_needed = std::any_of(bodies.begin(), bodies.end(), [](const Body<dim> &body) {
    return body.shape && !body.shape->is_smooth();
  });
  if (!start_displacement || !is_needed)
    return;
  dealii::TrilinosWrappers::MPI::Vector ghosted(fields.owned(), fields.relevant(),
                                                start_displacement->get_mpi_communicator());
  ghosted       = *start_displacement;
  displacements = values_by_cell(fields, ghosted);
}

template <int dim>
std::optional<dealii::Point<dim>>
ExactDistances<dim>::initial_position(const unsigned int body, const dealii::Point<dim> &x) const
{
  if (poses[body])
    return poses[body]->initial_position(x);
  if (!bodies[body].law)
    return x;
  const int cell = fields.nearest_active_cell(x, body);
  if (cell < 0)
    return {};
  std::array<double, max_nodes_per_cell<dim>> shape;
  fields.basis.evaluate_values(fields.unit_point(cell, x), shape.data());
  const double      *u = &displacements[std::size_t(cell) * fields.basis.n_nodes * dim];
  dealii::Point<dim> X = x;
  for (unsigned int i = 0; i < fields.basis.n_nodes; ++i)
    for (unsigned int d = 0; d < dim; ++d)
      X[d] -= shape[i] * u[i * dim + d];
  return X;
}

template <int dim>
bool
ExactDistances<dim>::is_known(const unsigned int body, const dealii::Point<dim> &x) const
{
  const auto &shape = bodies[body].shape;
  if (!shape || (bodies[body].law && displacements.empty()))
    return false;
  const auto X = initial_position(body, x);
  if (!X)
    return false;
  // Off the kinks, which may lie on grid lines.
  constexpr double   aside[]       = {137., 261., 183.};
  dealii::Point<dim> beside        = *X;
  double             slope_squared = 0.;
  for (unsigned int d = 0; d < dim; ++d)
    beside[d] += aside[d] * step;
  for (unsigned int d = 0; d < dim; ++d)
    {
      dealii::Point<dim> before = beside, after = beside;
      before[d] -= 0.5 * step;
      after[d] += 0.5 * step;
      const double slope = (shape->signed_distance(after) - shape->signed_distance(before)) / step;
      slope_squared += slope * slope;
    }
  return std::abs(slope_squared - 1.) < 1e-3;
}

template <int dim>
double
ExactDistances<dim>::level_set(const unsigned int body, const dealii::Point<dim> &x) const
{
  return bodies[body].shape->signed_distance(initial_position(body, x).value_or(x));
}

template <int dim>
dealii::Tensor<1, dim>
ExactDistances<dim>::gradient(const unsigned int body, const dealii::Point<dim> &x) const
{
  dealii::Tensor<1, dim> result;
  for (unsigned int d = 0; d < dim; ++d)
    {
      dealii::Point<dim> before = x, after = x;
      before[d] -= 0.5 * step;
      after[d] += 0.5 * step;
      result[d] = (level_set(body, after) - level_set(body, before)) / step;
    }
  return result;
}

template <int dim>
double
ExactDistances<dim>::value(const unsigned int body, const dealii::Point<dim> &x) const
{
  const double phi = level_set(body, x);
  return is_exact(body) ? phi : phi / std::max(0.1, gradient(body, x).norm());
}

template <int dim>
dealii::Tensor<1, dim>
ExactDistances<dim>::normal(const unsigned int body, const dealii::Point<dim> &x) const
{
  const dealii::Tensor<1, dim> slope = gradient(body, x);
  return slope / std::max(0.1, slope.norm());
}

template <int dim>
dealii::Point<dim>
ExactDistances<dim>::foot(const unsigned int body, const dealii::Point<dim> &x) const
{
  dealii::Point<dim> result = x;
  for (unsigned int iteration = 0; iteration < (is_exact(body) ? 1 : 3); ++iteration)
    result -= value(body, result) * normal(body, result);
  return result;
}

template <int dim>
bool
ExactDistances<dim>::is_kinked(const unsigned int body, const dealii::BoundingBox<dim> &box) const
{
  const auto &shape = bodies[body].shape;
  if (!shape || shape->is_smooth())
    return false;
  std::vector<dealii::Point<dim>> corners;
  for (unsigned int v = 0; v < 1u << dim; ++v)
    if (const auto X = initial_position(body, box.vertex(v)))
      corners.push_back(*X);
  std::vector<SmoothPiece<dim>> pieces;
  if (!corners.empty())
    shape->append_pieces(dealii::BoundingBox<dim>(corners), pieces);
  return pieces.size() > 1;
}

template class ExactDistances<2>;
template class ExactDistances<3>;
} // namespace scree
