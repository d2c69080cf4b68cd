#include <scree/base/exceptions.h>
#include <scree/base/log.h>
#include <scree/bodies/body_list.h>

#include <algorithm>
#include <set>

namespace scree
{
namespace
{
/** A cell as Family = list reads it: in quotation marks if there is a comma in it. */
std::string
quoted(const std::string &cell)
{
  if (cell.find_first_of(",\"") == std::string::npos)
    return cell;
  std::string result = "\"";
  for (const char c : cell)
    result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + '"';
}

std::string
joined(const std::vector<std::string> &cells)
{
  std::string line;
  for (std::size_t c = 0; c < cells.size(); ++c)
    line += (c == 0 ? "" : ", ") + quoted(cells[c]);
  return line + '\n';
}
} // namespace

template <int dim>
std::string
list_of_family(const std::vector<BodyParameters<dim>> &bodies, const std::string &family)
{
  std::set<std::string>                           families, materials;
  std::vector<std::string>                        columns;
  std::vector<std::map<std::string, std::string>> rows;
  for (const BodyParameters<dim> &body : bodies)
    {
      if (!body.family.empty())
        families.insert(body.family);
      if (body.family != family)
        continue;
      require(body.listed_shape != nullptr, "--list " + family, "no table can tell its shapes",
              "list a family of Family = packing, array or list; no union, intersection or "
              "difference of parts");
      auto cells = body.listed_shape().cells();
      cells.insert(cells.begin(),
                   {{"Name", body.name.substr(family.size() + 1)}, {"Material", body.material}});
      materials.insert(body.material);
      for (const auto &cell : cells)
        if (std::find(columns.begin(), columns.end(), cell.first) == columns.end())
          columns.push_back(cell.first);
      rows.emplace_back(cells.begin(), cells.end());
    }
  require(!rows.empty(), "--list " + family, "there is no such family",
          families.empty() ? "set Family = packing in the section of a body"
                           : "one of: " + listed({families.begin(), families.end()}));
  if (materials.size() == 1) // that of the section
    columns.erase(std::find(columns.begin(), columns.end(), "Material"));
  std::string table = joined(columns);
  for (auto &row : rows)
    {
      std::vector<std::string> cells;
      for (const std::string &column : columns)
        cells.push_back(row[column]);
      table += joined(cells);
    }
  return table;
}

template std::string list_of_family(const std::vector<BodyParameters<2>> &, const std::string &);
template std::string list_of_family(const std::vector<BodyParameters<3>> &, const std::string &);
} // namespace scree
