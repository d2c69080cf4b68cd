#include <scree/base/exceptions.h>
#include <scree/base/text_file.h>
#include <scree/bodies/list_family.h>
#include <scree/parameters/data_file.h>
#include <scree/parameters/file.h>
#include <scree/parameters/values.h>

#include <deal.II/base/utilities.h>

#include <algorithm>

namespace scree
{
namespace
{
constexpr std::size_t largest_list_file = 64000000; // bytes

/** A table of texts. */
struct TextTable
{
  std::vector<std::string> columns;
  struct Row
  {
    std::size_t              line; //!< from 1
    std::vector<std::string> cells;
  };
  std::vector<Row> rows;

  /** @throws UserError for rows of another length than the first, which has the names */
  TextTable(const std::string &bytes, const std::string &name);
};

/** The cells of a row, between commas; in those in quotation marks commas may stand. */
std::vector<std::string>
split_cells(const std::string &line, const std::string &where)
{
  std::vector<std::string> cells(1);
  bool                     is_quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (line[i] == '"' && is_quoted && i + 1 < line.size() && line[i + 1] == '"')
      cells.back() += line[++i];
    else if (line[i] == '"')
      is_quoted = !is_quoted;
    else if (line[i] == ',' && !is_quoted)
      cells.emplace_back();
    else
      cells.back() += line[i];
  require(!is_quoted, where, "a quotation mark is not closed", "close it, or remove it");
  for (std::string &cell : cells)
    cell = dealii::Utilities::trim(cell);
  return cells;
}

TextTable::TextTable(const std::string &bytes, const std::string &name)
{
  for (const auto &[line, where, number] : data_lines(checked_text(bytes, name), name))
    {
      const std::vector<std::string> cells = split_cells(line, where);
      if (columns.empty())
        columns = cells;
      else
        rows.push_back({number, cells});
      require(cells.size() == columns.size(), where,
              "the row has " + std::to_string(cells.size()) + " cells, the first line "
                + std::to_string(columns.size()) + " names",
              "give every row a cell for each name, separated by commas");
    }
  for (const std::string &column : columns)
    require(!column.empty() && std::count(columns.begin(), columns.end(), column) == 1, name,
            column.empty() ? "a column has no name" : "two columns are called '" + column + "'",
            "give each column a name of its own");
  require(!rows.empty(), name, "the table has no row",
          "write the names of columns, then the bodies");
}

/** The entry of section Shape that a column belongs to: "Centre" of "Centre x". */
std::string
entry_of(const std::string &column)
{
  const std::size_t n = column.size();
  const bool        is_component
    = n > 2 && column[n - 2] == ' ' && column[n - 1] >= 'x' && column[n - 1] <= 'z';
  return is_component ? column.substr(0, n - 2) : column;
}

/**
 * Section Shape as a row tells it. The line of an entry is the number of its column, which messages
 * then tell.
 */
std::string
shape_text(const TextTable &table, const TextTable::Row &row, const std::string &type)
{
  std::string text;
  for (std::size_t c = 0; c < table.columns.size(); ++c, text += '\n')
    {
      const std::string &column = table.columns[c], entry = entry_of(column);
      if (column == "Name" || column == "Material" || row.cells[c].empty()
          || (c > 0 && entry != column && entry_of(table.columns[c - 1]) == entry))
        continue;
      text += "set " + entry + " = " + row.cells[c];
      for (std::size_t next = c + 1;
           next < table.columns.size() && entry != column && entry_of(table.columns[next]) == entry;
           ++next)
        text += ", " + row.cells[next];
    }
  const bool has_type = std::count(table.columns.begin(), table.columns.end(), "Type") > 0;
  return has_type ? text : text + "set Type = " + type + "\n";
}

/** The cell of a row in a column that need not be there. */
std::string
cell(const TextTable &table, const TextTable::Row &row, const std::string &column)
{
  const auto found = std::find(table.columns.begin(), table.columns.end(), column);
  return found == table.columns.end() ? "" : row.cells[found - table.columns.begin()];
}

template <int dim>
FamilyMember<dim>
member_of(const TextTable &table, const TextTable::Row &row, const std::string &type,
          const std::string &path, const std::size_t number)
{
  const std::string where = path + ", line " + std::to_string(row.line);
  ParameterFile file = ParameterFile::from_string(shape_text(table, row, type), where + ", column");
  ShapeParameters<dim> shape;
  shape.declare(file.root());
  file.check();
  const std::string name = cell(table, row, "Name");
  require(name.find_first_of("/=") == std::string::npos, where, "'" + name + "' cannot be a name",
          "use names without '/' and '='");
  return member_of_shape(name.empty() ? member_name(number) : name, shape,
                         cell(table, row, "Material"));
}

template <int dim>
std::vector<FamilyMember<dim>>
declare_list(const ParameterSection &section, const ShapeParameters<dim> & /*shape*/)
{
  std::string       path, type = ShapeParameters<dim>().type;
  const std::string bytes = read_data_file(
    section, "File", path, largest_list_file, "bodies",
    "Table (CSV), a body in each row. The first line names the columns: entries of "
    "section Shape, as Radius, numbers of coordinates one by one, as Centre x and "
    "Centre y; Name (else bodies are numbered); Material. Cells with commas stand in quotation "
    "marks, as \"0,0; 1,0; 1,1\" of Vertices; what follows # is not read.");
  section.entry("Type", type, "Type of the shapes, where there is no column Type.");
  std::vector<FamilyMember<dim>> members;
  if (bytes.empty())
    return members;
  const TextTable table(bytes, path);
  for (const auto &row : table.rows)
    members.push_back(member_of<dim>(table, row, type, path, members.size() + 1));
  return members;
}
} // namespace

template <int dim>
FamilyKind<dim>
list_family()
{
  return {"list", "List", "A table of bodies.", false, declare_list<dim>};
}

template FamilyKind<2> list_family();
template FamilyKind<3> list_family();
} // namespace scree
