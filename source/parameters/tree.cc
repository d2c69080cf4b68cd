#include <scree/base/exceptions.h>
#include <scree/parameters/tree.h>

#include <algorithm>

namespace scree
{
std::string
SourcePosition::text() const
{
  return line == 0 ? file : file + ":" + std::to_string(line);
}

ParameterNode::ParameterNode(const std::string &name, ParameterNode *parent)
    : name(name)
    , parent(parent)
    , depth(parent == nullptr ? 0 : parent->depth + 1)
{
}

std::string
ParameterNode::path() const
{
  if (parent == nullptr)
    return "";
  const std::string above = parent->path();
  return above.empty() ? name : above + "/" + name;
}

ParameterEntry *
ParameterNode::find_entry(const std::string &key) const
{
  const auto found = entry_of_key.find(key);
  return found == entry_of_key.end() ? nullptr : found->second;
}

ParameterNode *
ParameterNode::find_section(const std::string &section_name) const
{
  const auto found = section_of_name.find(section_name);
  return found == section_of_name.end() ? nullptr : found->second;
}

ParameterEntry &
ParameterNode::get_entry(const std::string &key)
{
  if (ParameterEntry *entry = find_entry(key))
    return *entry;
  entries.push_back(std::make_unique<ParameterEntry>());
  entries.back()->key = key;
  entry_of_key[key]   = entries.back().get();
  return *entries.back();
}

ParameterNode &
ParameterNode::get_section(const std::string &section_name)
{
  if (ParameterNode *section = find_section(section_name))
    return *section;
  sections.push_back(std::make_unique<ParameterNode>(section_name, this));
  section_of_name[section_name] = sections.back().get();
  return *sections.back();
}

ParameterNode &
ParameterNode::get_written_section(const std::string &section_name, const std::string &where)
{
  require(depth < largest_depth, where,
          "sections are nested more than " + std::to_string(largest_depth) + " deep",
          "close sections with 'end' before others begin");
  return get_section(section_name);
}

namespace
{
template <typename Item>
std::vector<const Item *>
declared(const std::vector<std::unique_ptr<Item>> &items)
{
  std::vector<const Item *> result;
  for (const auto &item : items)
    if (item->order > 0)
      result.push_back(item.get());
  std::sort(result.begin(), result.end(),
            [](const Item *a, const Item *b) { return a->order < b->order; });
  return result;
}
} // namespace

std::vector<const ParameterEntry *>
ParameterNode::declared_entries() const
{
  return declared(entries);
}

std::vector<const ParameterNode *>
ParameterNode::declared_sections() const
{
  return declared(sections);
}

std::string
ParameterProblem::where() const
{
  return path.empty() ? position.text() : position.text() + ": " + path;
}

ParameterTree::ParameterTree(const std::string &name, const bool is_documentation)
    : name(name)
    , is_documentation(is_documentation)
    , root("", nullptr)
{
}

void
ParameterTree::add_problem(const ParameterNode &node, const SourcePosition &position,
                           const std::string &what, const std::string &remedy)
{
  add(problems, node, position, what, remedy);
}

void
ParameterTree::add_warning(const ParameterNode &node, const SourcePosition &position,
                           const std::string &what, const std::string &remedy)
{
  add(warnings, node, position, what, remedy);
}

void
ParameterTree::add(std::vector<ParameterProblem> &list, const ParameterNode &node,
                   const SourcePosition &position, const std::string &what,
                   const std::string &remedy)
{
  if (is_documentation)
    return;

  SourcePosition found = position;
  for (const ParameterNode *section = &node; found.file.empty() && section != nullptr;
       section                      = section->parent)
    found = section->position;
  if (found.file.empty())
    found.file = name;

  const std::string path = node.path();
  if (recorded.emplace(path, what).second)
    list.push_back({found, path, what, remedy});
}
} // namespace scree
