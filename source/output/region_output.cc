#include <scree/output/region_output.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <fstream>
#include <iomanip>

namespace scree
{
template <int dim>
void
write_regions_csv(const std::vector<BoundaryRegion<dim>> &regions,
                  const std::vector<Body<dim>> &bodies, const MPI_Comm communicator,
                  const std::string &directory)
{
  std::vector<std::vector<double>> rows;
  for (unsigned int i = 0; i < regions.size(); ++i)
    for (const auto &point : regions[i].points)
      {
        rows.push_back({double(i)});
        for (unsigned int d = 0; d < dim; ++d)
          rows.back().push_back(point.position[d]);
        rows.back().push_back(point.weight);
      }
  const auto gathered = dealii::Utilities::MPI::gather(communicator, rows);
  if (dealii::Utilities::MPI::this_mpi_process(communicator) != 0)
    return;
  rows.clear();
  for (const auto &of_process : gathered)
    rows.insert(rows.end(), of_process.begin(), of_process.end());
  std::sort(rows.begin(), rows.end());
  std::ofstream file(directory + "/regions.csv");
  file << "body,condition" << (dim == 2 ? ",x,y" : ",x,y,z") << ",weight\n"
       << std::setprecision(12);
  for (const auto &row : rows)
    {
      const auto &region = regions[static_cast<unsigned int>(row[0])];
      file << bodies[region.body].name << ',' << region.condition->name;
      for (unsigned int c = 1; c < row.size(); ++c)
        file << ',' << row[c];
      file << '\n';
    }
}

template void write_regions_csv(const std::vector<BoundaryRegion<2>> &,
                                const std::vector<Body<2>> &, const MPI_Comm, const std::string &);
template void write_regions_csv(const std::vector<BoundaryRegion<3>> &,
                                const std::vector<Body<3>> &, const MPI_Comm, const std::string &);
} // namespace scree
