#include <scree/mechanics/boundary_terms.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace scree
{
template <int dim>
unsigned int
BoundaryTerms<dim>::n_multipliers(const std::vector<Body<dim>> &bodies)
{
  unsigned int n = 0;
  for (const auto &body : bodies)
    for (const auto &condition : body.conditions)
      if (condition.parameters.type == ConditionType::mean_support)
        n += condition.components.size();
  return n;
}

template <int dim>
BoundaryTerms<dim>::BoundaryTerms(const Fields<dim>            &fields,
                                  const LevelSetNodes<dim>     &level_set_nodes,
                                  const CutQuadrature<dim>     &quadrature,
                                  const std::vector<Body<dim>> &bodies, const Bulk<dim> &bulk,
                                  const double start_time)
    : fields(fields)
    , bodies(bodies)
    , boundary_regions(
        find_boundary_regions(fields, level_set_nodes, quadrature, bodies, bulk.step_start()))
    , bulk(bulk)
    , start(bulk.step_start())
{
  if (start)
    release_edges(level_set_nodes);
  find_moments();
  if (start)
    {
      forgive_flow(start_time);
      find_starts();
    }
}

template <int dim>
double
BoundaryTerms<dim>::beta(const BoundaryRegion<dim> &region, const unsigned int q) const
{
  const ActiveCell &cell = fields.cells()[region.points[q].active_cell];
  const double      k    = fields.basis.degree;
  return pointwise_share(region, q) * region.condition->parameters.penalty_factor * k * k
         * bodies[region.body].material->p_wave_modulus()
         / fields.grid.cells()[cell.grid_cell].size;
}

template <int dim>
double
BoundaryTerms<dim>::multiplier_scale(const BoundaryRegion<dim> &region) const
{
  return bodies[region.body].material->young() * std::pow(fields.grid.finest_size(), dim - 2)
         / region.area;
}

template <int dim>
void
BoundaryTerms<dim>::stress_vectors(const BoundaryRegion<dim> &region,
                                   const BoundaryPoint<dim> &point, ShapeValues<dim> &shape,
                                   std::vector<dealii::Tensor<1, dim>> &vectors) const
{
  const auto  &material = *bodies[region.body].material;
  const double lambda = material.lame_lambda(), mu = material.shear_modulus();
  const double scale = 1. / fields.grid.cells()[fields.cells()[point.active_cell].grid_cell].size;
  const auto  &n     = point.normal;
  fields.basis.evaluate(point.unit_point, shape);
  vectors.resize(fields.basis.n_nodes * dim);
  std::vector<double> divergence;
  const double        projected
    = bulk.projected_divergence(point.active_cell, point.unit_point, divergence)
        ? bulk.projected_lambda(region.body)
        : 0.;
  for (unsigned int a = 0; a < fields.basis.n_nodes; ++a)
    {
      const dealii::Tensor<1, dim> g  = scale * shape.gradient[a];
      const double                 gn = g * n;
      for (unsigned int i = 0; i < dim; ++i)
        {
          // sigma = lambda div I + mu (e_i g + g e_i)
          const double volumetric = (lambda - projected) * g[i]
                                    + (projected > 0. ? projected * divergence[a * dim + i] : 0.);
          dealii::Tensor<1, dim> vector = volumetric * n + mu * n[i] * g;
          vector[i] += mu * gn;
          vectors[a * dim + i] = vector;
        }
    }
}

template <int dim>
void
BoundaryTerms<dim>::mean_row(const BoundaryRegion<dim> &region, const BoundaryPoint<dim> &point,
                             const unsigned int m, std::vector<double> &row) const
{
  std::vector<double> shape(fields.basis.n_nodes);
  fields.basis.evaluate_values(point.unit_point, shape.data());
  const unsigned int           component = region.condition->components[m];
  const dealii::Tensor<1, dim> arm       = point.position - region.centre;
  row.assign(fields.basis.n_nodes * dim, 0.);
  for (unsigned int a = 0; a < fields.basis.n_nodes; ++a)
    if (component < dim)
      row[a * dim + component] = shape[a] * point.weight;
    else
      {
        row[a * dim]     = -arm[1] * shape[a] * point.weight;
        row[a * dim + 1] = arm[0] * shape[a] * point.weight;
      }
  const double scale = multiplier_scale(region);
  for (double &entry : row)
    entry *= scale;
}

template <int dim>
void
BoundaryTerms<dim>::add_to_matrix(dealii::TrilinosWrappers::SparseMatrix &matrix) const
{
  const unsigned int                  n = fields.basis.n_nodes;
  ShapeValues<dim>                    shape;
  std::vector<dealii::Tensor<1, dim>> stress;
  dealii::FullMatrix<double>          block;
  std::vector<double>                 row;
  for (const auto &region : boundary_regions)
    for (unsigned int q = 0; q < region.points.size(); ++q)
      {
        const auto &point   = region.points[q];
        const auto  type    = region.condition->parameters.type;
        auto        indices = unknowns_of_nodes<dim>(fields.nodes(point.active_cell), n);
        if (type == ConditionType::mean_support)
          {
            const unsigned int n_rows = region.condition->components.size();
            block.reinit(n * dim + n_rows, n * dim + n_rows);
            for (unsigned int m = 0; m < n_rows; ++m)
              {
                mean_row(region, point, m, row);
                indices.push_back(fields.multiplier(region.first_multiplier + m));
                for (unsigned int i = 0; i < n * dim; ++i)
                  block(i, n * dim + m) = block(n * dim + m, i) = row[i];
              }
            fields.hanging_constraints().distribute_local_to_global(block, indices, matrix);
            continue;
          }
        if (type != ConditionType::springs && type != ConditionType::displacement)
          continue;
        block.reinit(n * dim, n * dim);
        stress_vectors(region, point, shape, stress);
        const auto method = region.condition->parameters.method;
        const bool nitsche
          = type == ConditionType::displacement && method != DisplacementMethod::penalty;
        const double adjoint = (method == DisplacementMethod::nonsymmetric_nitsche ? 1. : -1.)
                               * flow_ratio(point.active_cell);
        for (unsigned int k = 0; k < region.condition->components.size(); ++k)
          {
            const unsigned int c         = region.condition->components[k];
            const double       stiffness = type == ConditionType::springs
                                             ? region.condition->value(k, point.reference_position, 0.)
                                             : beta(region, q);
            require(stiffness >= 0., region.condition->path + "/Value",
                    "a spring stiffness is negative", "give values that are not less than zero");
            for (unsigned int a = 0; a < n; ++a)
              for (unsigned int b = 0; b < n; ++b)
                block(a * dim + c, b * dim + c)
                  += point.weight * stiffness * shape.value[a] * shape.value[b];
            if (nitsche)
              for (unsigned int a = 0; a < n; ++a)
                for (unsigned int j = 0; j < n * dim; ++j)
                  {
                    const double entry = point.weight * shape.value[a] * stress[j][c];
                    if (!start)
                      block(a * dim + c, j) -= entry;
                    block(j, a * dim + c) += adjoint * entry;
                  }
          }
        fields.hanging_constraints().distribute_local_to_global(block, indices, matrix);
      }
  add_moments_to_matrix(matrix);
}

template <int dim>
void
BoundaryTerms<dim>::add_loads(Vector &loads, const double time, const bool dead_loads,
                              const bool prescribed) const
{
  const unsigned int                  n = fields.basis.n_nodes;
  ShapeValues<dim>                    shape;
  std::vector<dealii::Tensor<1, dim>> stress;
  dealii::Vector<double>              cell_load(n * dim);
  for (const auto &region : boundary_regions)
    {
      const auto &condition = *region.condition;
      const auto  type      = condition.parameters.type;
      for (unsigned int q = 0; q < region.points.size(); ++q)
        {
          const auto &point   = region.points[q];
          const auto  indices = unknowns_of_nodes<dim>(fields.nodes(point.active_cell), n);
          cell_load           = 0.;
          if (type == ConditionType::mean_support && prescribed)
            {
              const dealii::Tensor<1, dim> arm = point.position - region.centre;
              const auto                  &u_n = point.start_displacement;
              for (unsigned int m = 0; m < condition.components.size(); ++m)
                {
                  const unsigned int c     = condition.components[m];
                  const double       value = condition.value(m, point.reference_position, time);
                  loads(fields.multiplier(region.first_multiplier + m))
                    += multiplier_scale(region) * point.weight
                       * (c < dim ? value - u_n[c]
                                  : value * squared_arm(region, point)
                                      - (arm[0] * u_n[1] - arm[1] * u_n[0]));
                }
              continue;
            }
          if (dead_loads
              && (type == ConditionType::traction || (type == ConditionType::pressure && !start)))
            {
              const dealii::Tensor<1, dim> t
                = type == ConditionType::traction
                    ? point.area_ratio * condition.vector(point.reference_position, time)
                    : -condition.value(0, point.reference_position, time) * point.normal;
              stress_vectors(region, point, shape, stress);
              for (unsigned int a = 0; a < n; ++a)
                for (unsigned int d = 0; d < dim; ++d)
                  cell_load(a * dim + d) = point.weight * shape.value[a] * t[d];
            }
          else if (prescribed && type == ConditionType::displacement)
            {
              stress_vectors(region, point, shape, stress);
              const auto   method  = condition.parameters.method;
              const double adjoint = flow_ratio(point.active_cell)
                                     * (method == DisplacementMethod::penalty                ? 0.
                                        : method == DisplacementMethod::nonsymmetric_nitsche ? 1.
                                                                                             : -1.);
              for (unsigned int k = 0; k < condition.components.size(); ++k)
                {
                  const unsigned int c     = condition.components[k];
                  const double       value = condition.value(k, point.reference_position, time)
                                       - point.start_displacement[c];
                  for (unsigned int a = 0; a < n; ++a)
                    cell_load(a * dim + c)
                      += point.weight * beta(region, q) * shape.value[a] * value;
                  for (unsigned int j = 0; j < n * dim; ++j)
                    cell_load(j) += adjoint * point.weight * stress[j][c] * value;
                }
            }
          else if (prescribed && start && type == ConditionType::springs)
            {
              stress_vectors(region, point, shape, stress);
              for (unsigned int k = 0; k < condition.components.size(); ++k)
                {
                  const unsigned int c     = condition.components[k];
                  const double       force = -condition.value(k, point.reference_position, 0.)
                                       * point.start_displacement[c];
                  for (unsigned int a = 0; a < n; ++a)
                    cell_load(a * dim + c) += point.weight * shape.value[a] * force;
                }
            }
          else
            continue;
          fields.hanging_constraints().distribute_local_to_global(cell_load, indices, loads);
        }
    }
  if (prescribed)
    add_moment_loads(loads, time);
}

template <int dim>
std::vector<std::vector<DofIndex>>
BoundaryTerms<dim>::multiplier_couplings() const
{
  std::vector<std::vector<DofIndex>> result;
  for (const auto &region : boundary_regions)
    if (region.condition->parameters.type == ConditionType::mean_support)
      {
        int last_cell = -1;
        for (const auto &point : region.points)
          {
            if (last_cell == int(point.active_cell))
              continue;
            last_cell = point.active_cell;
            auto indices
              = unknowns_of_nodes<dim>(fields.nodes(point.active_cell), fields.basis.n_nodes);
            for (unsigned int m = 0; m < region.condition->components.size(); ++m)
              indices.push_back(fields.multiplier(region.first_multiplier + m));
            result.push_back(indices);
          }
      }
  return result;
}

template <int dim>
bool
BoundaryTerms<dim>::is_symmetric() const
{
  return std::none_of(boundary_regions.begin(), boundary_regions.end(), [&](const auto &region) {
    return (start && is_nonlinear(region))
           || (region.condition->parameters.type == ConditionType::displacement
               && region.condition->parameters.method == DisplacementMethod::nonsymmetric_nitsche);
  });
}

template <int dim>
bool
BoundaryTerms<dim>::has_multipliers() const
{
  return n_multipliers(bodies) > 0;
}

template <int dim>
dealii::Tensor<1, dim>
BoundaryTerms<dim>::displacement_at(const BoundaryRegion<dim> &region, const unsigned int q,
                                    const Vector &u) const
{
  const auto            &point = region.points[q];
  ShapeValues<dim>       shape;
  dealii::Tensor<1, dim> result = point.start_displacement;
  fields.basis.evaluate(point.unit_point, shape);
  const DofIndex *nodes = fields.nodes(point.active_cell);
  for (unsigned int a = 0; a < fields.basis.n_nodes; ++a)
    for (unsigned int d = 0; d < dim; ++d)
      result[d] += u(nodes[a] + d) * shape.value[a];
  return result;
}

template <int dim>
dealii::Tensor<1, dim>
BoundaryTerms<dim>::traction(const BoundaryRegion<dim> &region, const unsigned int q,
                             const Vector &u, const double time) const
{
  const auto            &point     = region.points[q];
  const auto            &condition = *region.condition;
  dealii::Tensor<1, dim> result;
  switch (condition.parameters.type)
    {
    case ConditionType::traction:
      return point.area_ratio * condition.vector(point.reference_position, time);
    case ConditionType::pressure:
      return -condition.value(0, point.reference_position, time)
             * (start ? turned_normal(region, q, u) : point.normal);
    case ConditionType::mean_support:
    case ConditionType::point_support:
      return result;
    case ConditionType::springs:
    case ConditionType::displacement:
      break;
    }
  ShapeValues<dim>                    shape;
  std::vector<dealii::Tensor<1, dim>> stress;
  stress_vectors(region, point, shape, stress);
  const dealii::Tensor<1, dim> displacement = displacement_at(region, q, u);
  dealii::Tensor<1, dim>       flux;
  const DofIndex              *nodes = fields.nodes(point.active_cell);
  for (unsigned int a = 0; a < fields.basis.n_nodes; ++a)
    for (unsigned int d = 0; d < dim; ++d)
      flux += u(nodes[a] + d) * stress[a * dim + d];
  if (start && is_nonlinear(region))
    flux = stress_vector(region, q, u);
  const bool is_spring = condition.parameters.type == ConditionType::springs;
  for (unsigned int k = 0; k < condition.components.size(); ++k)
    {
      const unsigned int c = condition.components[k];
      if (is_spring)
        result[c] = -condition.value(k, point.reference_position, 0.) * displacement[c];
      else
        result[c] = (condition.parameters.method == DisplacementMethod::penalty ? 0. : flux[c])
                    - beta(region, q)
                        * (displacement[c] - condition.value(k, point.reference_position, time));
    }
  return is_spring ? result : result + moment_traction(region, q, u, time);
}

template <int dim>
void
BoundaryTerms<dim>::add_multiplier_resultant(const BoundaryRegion<dim> &region, const Vector &u,
                                             Resultant<dim> &resultant) const
{
  for (unsigned int m = 0; m < region.condition->components.size(); ++m)
    {
      // The multiplier spreads -scale * (component, or arm turned by 90 degrees) over the region.
      const DofIndex index = fields.multiplier(region.first_multiplier + m);
      if (!fields.owned().is_element(index))
        continue;
      const unsigned int component = region.condition->components[m];
      const double       density   = -u(index) * multiplier_scale(region);
      if (component < dim)
        {
          dealii::Tensor<1, dim> force;
          force[component] = density * region.area;
          resultant.force += force;
          resultant.moment += moment_of<dim>(region.centre, force);
        }
      else
        resultant.moment[2] += density * region.polar_moment;
    }
}

template <int dim>
std::vector<Resultant<dim>>
BoundaryTerms<dim>::resultants(const Vector &u, const double time) const
{
  std::vector<Resultant<dim>> result;
  for (const auto &region : boundary_regions)
    {
      Resultant<dim> sum;
      for (unsigned int q = 0; q < region.points.size(); ++q)
        {
          const dealii::Tensor<1, dim> force
            = region.points[q].weight * traction(region, q, u, time);
          sum.force += force;
          sum.moment += moment_of<dim>(region.points[q].position, force);
        }
      if (region.condition->parameters.type == ConditionType::mean_support)
        add_multiplier_resultant(region, u, sum);
      result.push_back(sum);
    }
  sum_over_processes(result, fields.grid.communicator());
  return result;
}

template <int dim>
double
BoundaryTerms<dim>::energy(const Vector &u, const double time) const
{
  double sum = 0.;
  for (const auto &region : boundary_regions)
    {
      const auto &condition = *region.condition;
      if (condition.parameters.type != ConditionType::springs
          && condition.parameters.type != ConditionType::displacement)
        continue;
      std::vector<double> shape(fields.basis.n_nodes);
      for (unsigned int q = 0; q < region.points.size(); ++q)
        {
          const auto                  &point = region.points[q];
          const dealii::Tensor<1, dim> t     = traction(region, q, u, time);
          const bool is_spring               = condition.parameters.type == ConditionType::springs;
          const dealii::Tensor<1, dim> of_moments
            = is_spring ? dealii::Tensor<1, dim>() : moment_traction(region, q, u, time);
          fields.basis.evaluate_values(point.unit_point, shape.data());
          for (unsigned int k = 0; k < condition.components.size(); ++k)
            {
              const unsigned int c            = condition.components[k];
              double             displacement = point.start_displacement[c];
              for (unsigned int a = 0; a < fields.basis.n_nodes; ++a)
                displacement += shape[a] * u(fields.nodes(point.active_cell)[a] + c);
              if (is_spring)
                sum -= 0.5 * point.weight * t[c] * displacement;
              else
                {
                  // -(sigma n) e + beta e^2/2 with e = u - ubar and t = sigma n - beta e, and
                  // half the work of the moments
                  const double e
                    = displacement - condition.value(k, point.reference_position, time);
                  sum -= point.weight
                         * ((t[c] - 0.5 * of_moments[c]) * e + 0.5 * beta(region, q) * e * e);
                }
            }
        }
    }
  return dealii::Utilities::MPI::sum(sum, fields.grid.communicator());
}

template class BoundaryTerms<2>;
template class BoundaryTerms<3>;
} // namespace scree
