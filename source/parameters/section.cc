#include <scree/base/exceptions.h>
#include <scree/base/time_table.h>
#include <scree/parameters/data_file.h>
#include <scree/parameters/nearest_name.h>
#include <scree/parameters/section.h>
#include <scree/parameters/tree.h>
#include <scree/parameters/values.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <set>

namespace scree
{
namespace
{
/** The entry `key` of `node`, declared, with its default as its value. */
ParameterEntry &
declare_entry(ParameterTree &tree, ParameterNode &node, const std::string &key,
              const std::string &default_value, const std::string &documentation)
{
  Assert(!key.empty() && key.find_first_of("/=#\n") == std::string::npos,
         dealii::ExcMessage("'" + key + "' cannot be the key of an entry"));
  Assert(default_value.find_first_of("#\n") == std::string::npos,
         dealii::ExcMessage("'" + default_value + "' cannot be written to a parameter file"));
  ParameterEntry &entry = node.get_entry(key);
  if (entry.order == 0)
    entry.order = ++tree.n_declared;
  entry.default_value = default_value;
  entry.value         = default_value;
  entry.documentation = documentation;
  return entry;
}

/** A text for a message: its begin, if it is long. */
std::string
in_short(const std::string &text)
{
  constexpr std::size_t most = 200;
  if (text.empty())
    return "(nothing)";
  return text.size() <= most ? text : text.substr(0, most) + " ...";
}

void
add_wrong_value(ParameterTree &tree, const ParameterNode &node, ParameterEntry &entry,
                const std::string &hint)
{
  entry.is_wrong = true;
  tree.add_problem(
    node, entry.position,
    '"' + entry.key + "\" = " + in_short(entry.text) + " is not allowed: " + entry.allowed, hint);
}

template <typename T>
void
visit_entry(ParameterTree &tree, ParameterNode &node, const std::string &key, T &value,
            const dealii::Patterns::PatternBase *pattern, const std::string &documentation)
{
  ParameterEntry &entry = declare_entry(tree, node, key, format_value(value), documentation);
  entry.allowed         = allowed_values<T>(pattern);
  if (!entry.is_set || entry.text == entry.default_value)
    return;

  T             written = value;
  const Reading reading = parse_value(entry.text, written);
  if (!reading.ok)
    add_wrong_value(tree, node, entry, reading.hint);
  // Of numbers by formula the value must match.
  else if (pattern != nullptr && !matches<T>(*pattern, entry.text)
           && !matches<T>(*pattern, format_value(written)))
    add_wrong_value(tree, node, entry, "");
  else
    {
      value       = written;
      entry.value = format_value(value);
    }
}

ParameterNode &
declare_section(ParameterTree &tree, ParameterNode &node, const std::string &name,
                const std::string &documentation)
{
  Assert(!name.empty() && name.find_first_of("/=#\n") == std::string::npos,
         dealii::ExcMessage("'" + name + "' cannot be the name of a section"));
  ParameterNode &section = node.get_section(name);
  if (section.order == 0)
    section.order = ++tree.n_declared;
  section.documentation = documentation;
  return section;
}

/** The names of `entry` that can be used; problems are recorded. */
std::vector<std::string>
checked_names(ParameterTree &tree, const ParameterNode &node, ParameterEntry &entry)
{
  std::vector<std::string> names;
  std::set<std::string>    seen;
  const auto               refuse = [&](const std::string &what, const std::string &remedy) {
    entry.is_wrong = true;
    tree.add_problem(node, entry.position, "\"" + entry.key + "\" = " + in_short(entry.text) + what,
                                   remedy);
  };
  for (const auto &name : split_list(entry.text))
    {
      if (name.empty())
        refuse(" has an empty name", "remove the surplus comma or write the missing name");
      else if (name.find_first_of("/=") != std::string::npos)
        refuse(": '" + name + "' cannot be a name", "use names without '/' and '='");
      else if (!seen.insert(name).second)
        refuse(" lists '" + name + "' more than once", "give each its own name");
      else
        names.push_back(name);
    }
  return names;
}
} // namespace

ParameterSection::ParameterSection(ParameterTree &tree, ParameterNode &node)
    : tree(&tree)
    , node(&node)
{
}

template <typename T>
void
ParameterSection::entry(const std::string &key, T &value, const std::string &documentation) const
{
  visit_entry(*tree, *node, key, value, nullptr, documentation);
}

template <typename T>
void
ParameterSection::entry(const std::string &key, T &value,
                        const dealii::Patterns::PatternBase &pattern,
                        const std::string                   &documentation) const
{
  visit_entry(*tree, *node, key, value, &pattern, documentation);
}

std::string
ParameterSection::choice(const std::string &key, const std::string &default_name,
                         const std::vector<std::string> &allowed,
                         const std::string              &documentation) const
{
  ParameterEntry &entry = declare_entry(*tree, *node, key, default_name, documentation);
  entry.allowed.clear();
  for (const auto &name : allowed)
    entry.allowed += (entry.allowed.empty() ? "" : ", ") + name;
  if (!entry.is_set)
    return default_name;

  if (std::find(allowed.begin(), allowed.end(), entry.text) != allowed.end())
    entry.value = entry.text;
  else
    {
      const std::string nearest = nearest_name(entry.text, allowed);
      add_wrong_value(*tree, *node, entry,
                      nearest.empty() ? "write one of these names"
                                      : "did you mean '" + nearest + "'?");
    }
  return entry.value;
}

ParameterSection
ParameterSection::subsection(const std::string &name, const std::string &documentation) const
{
  return {*tree, declare_section(*tree, *node, name, documentation)};
}

std::vector<std::pair<std::string, ParameterSection>>
ParameterSection::named(const std::string &key, const std::string &documentation) const
{
  ParameterEntry &entry = declare_entry(*tree, *node, key, "", documentation);
  entry.allowed         = "names separated by commas, each of a subsection here";
  if (std::find(node->name_keys.begin(), node->name_keys.end(), key) == node->name_keys.end())
    node->name_keys.push_back(key);

  std::vector<std::string> names;
  if (tree->is_documentation)
    {
      // Sections that contain sections of their own kind are described once.
      if (node->made_by_key == key)
        return {};
      names = {"<name>"};
    }
  else
    names = checked_names(*tree, *node, entry);

  std::vector<std::pair<std::string, ParameterSection>> sections;
  for (const auto &name : names)
    {
      ParameterNode &section
        = declare_section(*tree, *node, name, "What belongs to one name of '" + key + "'.");
      if (tree->is_documentation)
        section.made_by_key = key;
      else
        entry.value += (entry.value.empty() ? "" : ", ") + name;
      node->listed_names.push_back(name);
      sections.emplace_back(name, ParameterSection(*tree, section));
    }
  return sections;
}

namespace
{
/** What is to be said of `key` in `node`. */
ParameterProblem
problem_of(const ParameterNode &node, const std::string &key, const std::string &what,
           const std::string &remedy)
{
  const ParameterEntry *entry   = node.find_entry(key);
  const ParameterNode  *section = node.find_section(key);
  SourcePosition        position;
  std::string           subject;
  if (!key.empty())
    subject = '"' + key + '"';
  if (entry != nullptr && entry->is_set)
    {
      position = entry->position;
      subject += " = " + in_short(entry->text);
    }
  else if (section != nullptr)
    position = section->position;
  return {position, node.path(), subject.empty() ? what : subject + ": " + what, remedy};
}
} // namespace

void
ParameterSection::error(const std::string &key, const std::string &what,
                        const std::string &remedy) const
{
  if (is_wrong(key))
    return;
  const ParameterProblem problem = problem_of(*node, key, what, remedy);
  tree->add_problem(*node, problem.position, problem.what, problem.remedy);
}

void
ParameterSection::warning(const std::string &key, const std::string &what,
                          const std::string &remedy) const
{
  const ParameterProblem problem = problem_of(*node, key, what, remedy);
  tree->add_warning(*node, problem.position, problem.what, problem.remedy);
}

bool
ParameterSection::is_set(const std::string &key) const
{
  const ParameterEntry *entry = node->find_entry(key);
  return entry != nullptr && entry->is_set
         && (entry->order == 0 ? !entry->text.empty() : entry->value != entry->default_value);
}

bool
ParameterSection::is_wrong(const std::string &key) const
{
  const ParameterEntry *entry = node->find_entry(key);
  return entry != nullptr && entry->is_wrong;
}

std::string
ParameterSection::found_file(const std::string &key, const std::string &path) const
{
  namespace fs                = std::filesystem;
  const ParameterEntry &entry = node->get_entry(key);
  std::error_code       none;
  const fs::path        beside    = fs::path(entry.position.file).parent_path() / path;
  const bool            is_beside = entry.position.file != "--set" && fs::exists(beside, none);
  if (is_beside && fs::exists(path, none) && !fs::equivalent(path, beside, none))
    warning(key, "there is another file '" + path
                   + "' in the folder where the program runs; the one beside the input is taken");
  const std::string found = fs::absolute(is_beside ? beside : fs::path(path), none).string();
  if (!none && found.find_first_of("#\n") == std::string::npos && found.back() != '\\')
    return fs::path(found).lexically_normal().string();
  error(key, "the file '" + found + "' cannot be named in a parameter file",
        "move it to where the path has no '#'");
  return "";
}

void
ParameterSection::file(const std::string &key, std::string &path,
                       const std::string &documentation) const
{
  entry(key, path, documentation);
  if (path.empty() || tree->is_documentation)
    return;
  const std::string found = found_file(key, path);
  if (!found.empty())
    path = node->get_entry(key).value = found;
}

void
ParameterSection::formula(const std::string &key, std::string &text,
                          const std::string &documentation) const
{
  entry(key, text, documentation);
  if (tree->is_documentation)
    return;
  try
    {
      const auto calls = table_calls(text, key);
      for (auto call = calls.rbegin(); call != calls.rend(); ++call)
        {
          auto checked = checked_table(*this, key, *call);
          text.replace(call->begin, call->length, checked.call);
          tree->tables.push_back({node, key, std::move(checked.table)});
        }
      if (!calls.empty())
        node->get_entry(key).value = text;
    }
  catch (const UserError &problem)
    {
      error(key, problem.what());
      text = node->get_entry(key).value = node->get_entry(key).default_value;
    }
}

void
ParameterSection::refuse(const std::string &name, const std::string &what,
                         const std::string &remedy) const
{
  ParameterNode *section = node->find_section(name);
  if (section == nullptr)
    return;
  section->is_refused = true;
  error(name, what, remedy);
}

bool
ParameterSection::is_documentation() const
{
  return tree->is_documentation;
}

std::string
ParameterSection::path() const
{
  return node->path();
}

dealii::Patterns::Double
positive_number()
{
  return dealii::Patterns::Double(std::numeric_limits<double>::min());
}

#define INSTANTIATE(...)                                                                         \
  template void ParameterSection::entry(const std::string &, __VA_ARGS__ &, const std::string &) \
    const;                                                                                       \
  template void ParameterSection::entry(const std::string &, __VA_ARGS__ &,                      \
                                        const dealii::Patterns::PatternBase &,                   \
                                        const std::string &) const;

INSTANTIATE(bool)
INSTANTIATE(int)
INSTANTIATE(unsigned int)
INSTANTIATE(double)
INSTANTIATE(std::string)
INSTANTIATE(std::vector<std::string>)
INSTANTIATE(std::vector<unsigned int>)
INSTANTIATE(std::vector<double>)
INSTANTIATE(dealii::Point<2>)
INSTANTIATE(dealii::Point<3>)
INSTANTIATE(dealii::Tensor<1, 2>)
INSTANTIATE(dealii::Tensor<1, 3>)
INSTANTIATE(std::vector<dealii::Point<2>>)
INSTANTIATE(std::vector<dealii::Point<3>>)
#undef INSTANTIATE
} // namespace scree
