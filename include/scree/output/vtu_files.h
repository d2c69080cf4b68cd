#pragma once

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

namespace scree
{
/**
 * Writes a file by f(stream), as FILE.part until it is whole; returns whether all of it was
 * written. If not, an older one stays.
 */
template <typename F>
bool
write_file(const std::string &file_name, const F &f)
{
  std::error_code error;
  const auto      status = std::filesystem::status(file_name, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    return false;
  const std::string part = file_name + ".part";
  std::filesystem::remove(part, error); // a pipe would be waited for
  std::ofstream file(part);
  try
    {
      f(file);
    }
  catch (const dealii::ExcIO &)
    {
      file.setstate(std::ios::failbit);
    }
  file.close();
  if (file.good())
    std::filesystem::rename(part, file_name, error);
  if (file.good() && !error)
    return true;
  std::filesystem::remove(part, error);
  return false;
}

/** A text as the value of an attribute in XML. */
inline std::string
xml_text(const std::string &text)
{
  std::string result;
  for (const char character : text)
    result += character == '&'   ? "&amp;"
              : character == '<' ? "&lt;"
              : character == '"' ? "&quot;"
                                 : std::string(1, character);
  return result;
}

/** A number for the FieldData of a VTU file. */
inline std::string
field_datum(const std::string &name, const double value)
{
  std::ostringstream text;
  text << "<DataArray type=\"Float64\" Name=\"" << xml_text(name)
       << "\" NumberOfTuples=\"1\" format=\"ascii\">" << std::setprecision(16) << value
       << "</DataArray>\n";
  return text.str();
}

/**
 * The numbers of bodies or pairs for the FieldData of a VTU file: KIND.NAME is the number of the
 * one of that name. Arrays of texts would do as well, but meshio reads no file that has one.
 */
template <typename Named>
std::string
field_data_of_names(const std::string &kind, const std::vector<Named> &all)
{
  std::string text;
  for (std::size_t i = 0; i < all.size(); ++i)
    text += field_datum(kind + "." + all[i].name, double(i));
  return text;
}

/** Writes the VTU file of an output, with FieldData, which deal.II has none of but its own. */
template <typename Output>
void
write_vtu_with(const Output &output, const std::string &field_data, std::ofstream &file)
{
  std::ostringstream text;
  output.write_vtu(text);
  const std::string vtu = text.str(), begin = "<UnstructuredGrid>\n";
  const auto        at = vtu.find(begin);
  if (field_data.empty() || at == std::string::npos)
    {
      file << vtu;
      return;
    }
  const auto behind = static_cast<std::streamsize>(at + begin.size());
  file.write(vtu.data(), behind);
  file << "<FieldData>\n" << field_data << "</FieldData>\n";
  file.write(vtu.data() + behind, static_cast<std::streamsize>(vtu.size()) - behind);
}

/**
 * Writes what each process has of a dealii::DataOutInterface to DIR/NAME.vtu, on several processes
 * as pieces with a record DIR/NAME.pvtu. Returns the name to put into a PVD record; empty if a
 * process could not write, on all of them. Collective.
 *
 * @param field_data see field_datum()
 */
template <typename Output>
std::string
write_vtu_files(const Output &output, const std::string &directory, const std::string &name,
                const MPI_Comm communicator, const std::string &field_data = "")
{
  const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
  const unsigned int rank    = dealii::Utilities::MPI::this_mpi_process(communicator);
  const auto         piece   = [&](const unsigned int p) {
    return name + (n_ranks == 1 ? "" : "." + std::to_string(p)) + ".vtu";
  };
  bool is_written = write_file(directory + "/" + piece(rank), [&](std::ofstream &file) {
    write_vtu_with(output, field_data, file);
  });
  if (n_ranks > 1 && rank == 0)
    {
      std::vector<std::string> names;
      for (unsigned int p = 0; p < n_ranks; ++p)
        names.push_back(piece(p));
      is_written &= write_file(directory + "/" + name + ".pvtu",
                               [&](std::ofstream &file) { output.write_pvtu_record(file, names); });
    }
  if (dealii::Utilities::MPI::min(is_written ? 1 : 0, communicator) == 0)
    return "";
  return n_ranks == 1 ? piece(0) : name + ".pvtu";
}
} // namespace scree
