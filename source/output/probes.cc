#include <scree/base/exceptions.h>
#include <scree/output/body_output.h>
#include <scree/output/probes.h>

#include <deal.II/base/mpi.h>

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
std::vector<std::string>
sample_columns()
{
  const std::vector<std::string> axes = {"x", "y", "z"};
  std::vector<std::string>       names(axes.begin(), axes.begin() + dim);
  for (unsigned int d = 0; d < dim; ++d)
    names.push_back("u_" + axes[d]);
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = i; j < dim; ++j)
      names.push_back("stress_" + axes[i] + axes[j]);
  if (dim == 2)
    names.push_back("stress_zz");
  names.push_back("von_mises");
  return names;
}

template <int dim>
std::vector<std::vector<double>>
sample(const ProbeParameters<dim> &probe, const unsigned int body, const Fields<dim> &fields,
       const Bulk<dim> &bulk, const dealii::TrilinosWrappers::MPI::Vector &u, const bool must_exist)
{
  const MPI_Comm                   communicator = fields.grid.communicator();
  const unsigned int               rank = dealii::Utilities::MPI::this_mpi_process(communicator);
  const unsigned int               n_columns = sample_columns<dim>().size();
  std::vector<std::vector<double>> rows;
  for (unsigned int i = 0; i < probe.n_points; ++i)
    {
      const double             t     = probe.n_points == 1 ? 0. : double(i) / (probe.n_points - 1);
      const dealii::Point<dim> point = probe.start + t * (probe.end - probe.start);
      std::vector<double>      row(n_columns + 1, 0.);
      if (fields.grid.locate(point).rank == rank)
        {
          const int cell = fields.nearest_active_cell(point, body);
          if (cell >= 0)
            {
              const auto   values = bulk.sample(cell, fields.unit_point(cell, point), u);
              unsigned int c      = 0;
              for (unsigned int d = 0; d < dim; ++d)
                row[c++] = point[d];
              for (unsigned int d = 0; d < dim; ++d)
                row[c++] = values.displacement[d];
              for (unsigned int k = 0; k < dim; ++k)
                for (unsigned int j = k; j < dim; ++j)
                  row[c++] = values.stress[k][j];
              if (dim == 2)
                row[c++] = values.out_of_plane_stress;
              row[c++] = von_mises(values.stress, values.out_of_plane_stress);
              row[c]   = 1.; // found
            }
        }
      dealii::Utilities::MPI::sum(row, communicator, row);
      std::ostringstream where;
      where << point;
      if (row.back() != 1. && !must_exist)
        row.assign(n_columns + 1, std::numeric_limits<double>::quiet_NaN());
      require(row.back() == 1. || !must_exist, "Output/Probes/" + probe.name,
              "the body '" + probe.body + "' has no cell at the point " + where.str(),
              "choose points inside the body");
      row.pop_back();
      rows.push_back(row);
    }
  return rows;
}

#define SCREE_INSTANTIATE(dim)                                                                \
  template struct ProbeParameters<dim>;                                                       \
  template std::vector<std::string>         sample_columns<dim>();                            \
  template std::vector<std::vector<double>> sample(                                           \
    const ProbeParameters<dim> &, const unsigned int, const Fields<dim> &, const Bulk<dim> &, \
    const dealii::TrilinosWrappers::MPI::Vector &, const bool);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
