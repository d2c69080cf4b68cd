#include <scree/base/exceptions.h>
#include <scree/parameters/file.h>
#include <scree/parameters/nearest_name.h>
#include <scree/parameters/tree.h>
#include <scree/parameters/values.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <tuple>

namespace scree
{
namespace
{
/** Adds the problems of what the user wrote in `node` but no module declared. */
void
find_unknown(ParameterTree &tree, const ParameterNode &node)
{
  std::vector<std::string> known_entries, known_sections;
  for (const ParameterEntry *entry : node.declared_entries())
    known_entries.push_back(entry->key);
  for (const ParameterNode *section : node.declared_sections())
    known_sections.push_back(section->name);

  const auto known = [](const std::string &kind, const std::vector<std::string> &names) {
    std::string joined;
    for (const auto &name : names)
      joined += (joined.empty() ? "" : ", ") + name;
    return joined.empty() ? "there are no " + kind + " here" : kind + " here: " + joined;
  };

  for (const auto &entry : node.entries)
    if (entry->order == 0)
      {
        const std::string what = "unknown entry '" + entry->key + "'";
        const std::string near = did_you_mean(entry->key, known_entries);
        if (std::find(known_sections.begin(), known_sections.end(), entry->key)
            != known_sections.end())
          tree.add_problem(node, entry->position, what,
                           "'" + entry->key + "' is a section: write 'subsection " + entry->key
                             + "' ... 'end'");
        else
          tree.add_problem(node, entry->position, what + near,
                           near.empty() ? known("entries", known_entries) : "");
      }

  for (const auto &section : node.sections)
    if (section->order > 0)
      find_unknown(tree, *section);
    else if (!section->is_refused)
      {
        const std::string near = did_you_mean(section->name, known_sections);
        if (node.name_keys.empty())
          tree.add_problem(node, section->position,
                           "unknown section '" + section->name + "'" + near,
                           near.empty() ? known("sections", known_sections) : "");
        else
          {
            std::string keys;
            for (const auto &key : node.name_keys)
              keys += (keys.empty() ? "'" : " or '") + key + "'";
            tree.add_problem(node, section->position,
                             "subsection '" + section->name + "' is not listed in " + keys + near,
                             near.empty() ? "add the name to the list or remove the subsection"
                                          : "");
          }
      }
}
} // namespace

ParameterFile::ParameterFile()                                     = default;
ParameterFile::ParameterFile(ParameterFile &&) noexcept            = default;
ParameterFile &ParameterFile::operator=(ParameterFile &&) noexcept = default;
ParameterFile::~ParameterFile()                                    = default;

ParameterFile
ParameterFile::read(const std::string &path)
{
  ParameterFile file;
  file.tree = std::make_unique<ParameterTree>(path, false);
  read_parameters(*file.tree, path);
  return file;
}

ParameterFile
ParameterFile::from_string(const std::string &text, const std::string &name)
{
  ParameterFile file;
  file.tree = std::make_unique<ParameterTree>(name, false);
  read_parameters_from_string(*file.tree, text);
  return file;
}

ParameterFile
ParameterFile::documentation()
{
  ParameterFile file;
  file.tree = std::make_unique<ParameterTree>("documentation", true);
  return file;
}

void
ParameterFile::override_value(const std::string &path_equals_value)
{
  using dealii::Utilities::trim;
  const std::string where  = "--set " + path_equals_value;
  const std::string remedy = "write Section/Subsection/Key=value";
  const auto        equals = path_equals_value.find('=');
  require(equals != std::string::npos, where, "there is no '='", remedy);
  const std::string value = trim(path_equals_value.substr(equals + 1));
  require(value.find_first_of("#\n") == std::string::npos
            && (value.empty() || value.back() != '\\'),
          where, "a value cannot contain '#' or a line break, nor end in '\\'", remedy);

  const auto names = split_list(path_equals_value.substr(0, equals), '/');
  require(!names.empty() && std::find(names.begin(), names.end(), "") == names.end(), where,
          "the key or the name of a section is missing", remedy);
  ParameterNode *section = &tree->root;
  for (unsigned int i = 0; i + 1 < names.size(); ++i)
    {
      section = &section->get_written_section(names[i], where);
      if (section->position.file.empty())
        section->position.file = "--set";
    }
  ParameterEntry &entry = section->get_entry(names.back());
  entry.is_set          = true;
  entry.text            = value;
  entry.position        = {"--set", 0};
}

ParameterSection
ParameterFile::root()
{
  return {*tree, tree->root};
}

std::vector<std::string>
ParameterFile::warnings() const
{
  std::vector<std::string> result;
  for (const auto &warning : tree->warnings)
    result.push_back(warning.where() + ": " + warning.what
                     + (warning.remedy.empty() ? "" : "; " + warning.remedy));
  return result;
}

void
ParameterFile::check() const
{
  ParameterTree all(tree->name, tree->is_documentation);
  all.problems = tree->problems;
  find_unknown(all, tree->root);
  if (all.problems.empty())
    return;

  auto &problems = all.problems;
  std::stable_sort(problems.begin(), problems.end(),
                   [](const ParameterProblem &a, const ParameterProblem &b) {
                     return std::tie(a.position.file, a.position.line)
                            < std::tie(b.position.file, b.position.line);
                   });
  if (problems.size() == 1)
    throw UserError(problems[0].where(), problems[0].what, problems[0].remedy);
  constexpr std::size_t most_told = 50;
  std::string           list;
  for (std::size_t i = 0; i < std::min(problems.size(), most_told); ++i)
    list += "\n" + problems[i].where() + ": " + problems[i].what
            + (problems[i].remedy.empty() ? "" : "\n  remedy: " + problems[i].remedy);
  throw UserError(
    tree->name,
    std::to_string(problems.size()) + " problems"
      + (problems.size() > most_told ? ", the first " + std::to_string(most_told) + " of them" : "")
      + list);
}

void
ParameterFile::check_tables(const double end_time) const
{
  for (const TableUse &use : tree->tables)
    try
      {
        for (const double time : {0., end_time})
          use.table.value(time);
      }
    catch (const UserError &problem)
      {
        ParameterSection(*tree, *use.node).error(use.key, problem.what());
      }
}
} // namespace scree
