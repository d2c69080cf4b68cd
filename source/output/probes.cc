#include <scree/base/exceptions.h>
#include <scree/output/body_output.h>
#include <scree/output/column_names.h>
#include <scree/output/probes.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>
#include <sstream>

namespace scree
{
template <int dim>
void
ProbeParameters<dim>::declare(ParameterSection &section)
{
  section.entry("Body", body, "Name of the body.");
  section.entry("Start", start, "The point, or the first point of a line [L].");
  section.entry("End", end, "The last point of a line [L].");
  section.entry("Number of points", n_points, dealii::Patterns::Integer(1, 1000000),
                "1: a point, a row per step in probes.csv; more: a line, a file per output.");
  if (n_points > 1 && start.distance(end) == 0.)
    section.error("End", "a line needs two different ends", "set End, or Number of points = 1");
}

template <int dim>
unsigned int
body_of_probe(const ProbeParameters<dim> &probe, const std::vector<Body<dim>> &bodies)
{
  const auto found = std::find_if(bodies.begin(), bodies.end(),
                                  [&](const Body<dim> &body) { return body.name == probe.body; });
  AssertThrow(found != bodies.end(), dealii::ExcMessage("a probe names an unknown body"));
  return found - bodies.begin();
}

template <int dim>
std::vector<std::string>
sample_columns(const ProbeParameters<dim> &probe)
{
  std::vector<std::string> names(axes.begin(), axes.begin() + dim);
  for (unsigned int d = 0; d < dim; ++d)
    names.push_back("u_" + axes[d]);
  add_symmetric_names<dim>("stress", names);
  if (dim == 2)
    names.push_back("stress_zz");
  names.push_back("von_mises");
  if (probe.with_plastic_strain)
    names.push_back("plastic_strain");
  return names;
}

template <int dim>
std::vector<std::vector<double>>
sample(const ProbeParameters<dim> &probe, const unsigned int body,
       const DisplacementSpace<dim> &space, const Bulk<dim> &bulk,
       const dealii::TrilinosWrappers::MPI::Vector &ghosted, const bool must_exist)
{
  const PointEvaluator<dim> u(space, ghosted);
  const MPI_Comm            communicator = space.grid.communicator();
  const unsigned int        rank         = dealii::Utilities::MPI::this_mpi_process(communicator);
  const unsigned int        n_columns    = sample_columns(probe).size();
  // A row ends with whether it was found.
  std::vector<double> values(probe.n_points * (n_columns + 1), 0.);
  const auto          place = [&](const unsigned int i) {
    return dealii::Point<dim>(probe.start
                              + (probe.n_points == 1 ? 0. : double(i) / (probe.n_points - 1))
                                  * (probe.end - probe.start));
  };
  for (unsigned int i = 0; i < probe.n_points; ++i)
    {
      const dealii::Point<dim> point = place(i);
      if (space.grid.locate(point).rank != rank)
        continue;
      const int cell = space.nearest_active_cell(point, body);
      if (cell < 0)
        continue;
      const auto sampled = bulk.sample(cell, space.unit_point(cell, point), u);
      double    *value   = &values[i * (n_columns + 1)];
      for (unsigned int d = 0; d < dim; ++d)
        *value++ = point[d];
      for (unsigned int d = 0; d < dim; ++d)
        *value++ = sampled.displacement[d];
      for (unsigned int k = 0; k < dim; ++k)
        for (unsigned int j = k; j < dim; ++j)
          *value++ = sampled.stress[k][j];
      if (dim == 2)
        *value++ = sampled.out_of_plane_stress;
      *value++ = von_mises(sampled.stress, sampled.out_of_plane_stress);
      if (probe.with_plastic_strain)
        *value++ = sampled.plastic_strain;
      *value = 1.;
    }
  dealii::Utilities::MPI::sum(values, communicator, values);
  std::vector<std::vector<double>> rows;
  for (unsigned int i = 0; i < probe.n_points; ++i)
    {
      const auto first    = values.begin() + i * (n_columns + 1);
      const bool is_found = first[n_columns] == 1.;
      if (!is_found && must_exist)
        {
          std::ostringstream where;
          where << place(i);
          throw UserError("Output/Probes/" + probe.name,
                          "the body '" + probe.body + "' has no cell at the point " + where.str(),
                          "choose points inside the body");
        }
      rows.emplace_back(first, first + n_columns);
      if (!is_found)
        rows.back().assign(n_columns, std::numeric_limits<double>::quiet_NaN());
    }
  return rows;
}

#define SCREE_INSTANTIATE(dim)                                                             \
  template struct ProbeParameters<dim>;                                                    \
  template unsigned int                     body_of_probe(const ProbeParameters<dim> &,    \
                                                          const std::vector<Body<dim>> &); \
  template std::vector<std::string>         sample_columns(const ProbeParameters<dim> &);  \
  template std::vector<std::vector<double>> sample(                                        \
    const ProbeParameters<dim> &, const unsigned int, const DisplacementSpace<dim> &,      \
    const Bulk<dim> &, const dealii::TrilinosWrappers::MPI::Vector &, const bool);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
