#include <scree/output/force_chains.h>
#include <scree/output/vtu_files.h>

#include <deal.II/base/utilities.h>

namespace scree
{
namespace
{
/** A data array of as many words as write(file) makes. */
template <typename F>
void
write_array(std::ofstream &file, const std::string &attributes, const F &write)
{
  file << "<DataArray " << attributes << " format=\"ascii\">\n";
  write();
  file << "</DataArray>\n";
}

/** A vector of three components. */
template <int dim>
void
write_vector(std::ofstream &file, const dealii::Tensor<1, dim> &vector)
{
  for (unsigned int d = 0; d < 3; ++d)
    file << (d < dim ? vector[d < dim ? d : 0] : 0.) << (d == 2 ? '\n' : ' ');
}
} // namespace

template <int dim>
ForceChains<dim>::ForceChains(const std::vector<Body<dim>>           &bodies,
                              const std::vector<ContactPair>         &pairs,
                              const std::vector<ContactSummary<dim>> &summaries,
                              const std::vector<GrainState<dim>>     &grains)
{
  for (unsigned int p = 0; p < pairs.size(); ++p)
    if (const auto &summary = summaries[p]; summary.is_closed())
      for (const unsigned int body : {pairs[p].a, pairs[p].b})
        if (!bodies[body].is_rigid())
          lines.push_back({{{grains[body].centroid, summary.place()}},
                           p,
                           summary.normal_force(),
                           summary.tangential_force(),
                           summary.force});
}

template <int dim>
std::string
ForceChains<dim>::write(const std::string &directory, const unsigned int number,
                        const double time) const
{
  const std::string name  = "chains_" + dealii::Utilities::int_to_string(number, 4) + ".vtp";
  const auto        write = [&](std::ofstream &file) {
    file << std::setprecision(9)
         << "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\">\n<PolyData>\n"
         << "<FieldData>\n"
         << field_datum("TimeValue", time) << "</FieldData>\n<Piece NumberOfPoints=\""
         << 2 * lines.size() << "\" NumberOfLines=\"" << lines.size() << "\">\n<Points>\n";
    write_array(file, "type=\"Float64\" NumberOfComponents=\"3\"", [&]() {
      for (const Line &line : lines)
        for (const auto &end : line.ends)
          write_vector<dim>(file, end);
    });
    file << "</Points>\n<Lines>\n";
    write_array(file, "type=\"Int32\" Name=\"connectivity\"", [&]() {
      for (std::size_t i = 0; i < 2 * lines.size(); ++i)
        file << i << '\n';
    });
    write_array(file, "type=\"Int32\" Name=\"offsets\"", [&]() {
      for (std::size_t i = 0; i < lines.size(); ++i)
        file << 2 * i + 2 << '\n';
    });
    file << "</Lines>\n<CellData Scalars=\"normal_force\">\n";
    const auto write_scalar
      = [&](const std::string &type, const std::string &of, auto Line::*value) {
          write_array(file, "type=\"" + type + "\" Name=\"" + of + "\"", [&]() {
            for (const Line &line : lines)
              file << line.*value << '\n';
          });
        };
    write_scalar("Float64", "normal_force", &Line::normal_force);
    write_scalar("Float64", "tangential_force", &Line::tangential_force);
    write_scalar("Int32", "pair", &Line::pair);
    write_array(file, "type=\"Float64\" Name=\"force\" NumberOfComponents=\"3\"", [&]() {
      for (const Line &line : lines)
        write_vector<dim>(file, line.force);
    });
    file << "</CellData>\n</Piece>\n</PolyData>\n</VTKFile>\n";
  };
  return write_file(directory + "/" + name, write) ? name : "";
}

template class ForceChains<2>;
template class ForceChains<3>;
} // namespace scree
