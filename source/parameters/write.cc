#include <scree/parameters/file.h>
#include <scree/parameters/tree.h>

#include <ostream>
#include <sstream>

namespace scree
{
namespace
{
/** `text` on one line, and only its first sentence. */
std::string
first_sentence(std::string text)
{
  for (char &c : text)
    if (c == '\n' || c == '\t')
      c = ' ';
  const auto end = text.find(". ");
  return end == std::string::npos ? text : text.substr(0, end + 1);
}

void
write_section(std::ostream &out, const ParameterNode &node, const std::string &indent)
{
  for (const ParameterEntry *entry : node.declared_entries())
    {
      if (!entry->documentation.empty())
        out << indent << "# " << first_sentence(entry->documentation) << '\n';
      out << indent << "set " << entry->key << " = " << entry->value << '\n';
    }
  for (const ParameterNode *section : node.declared_sections())
    {
      out << '\n';
      if (!section->documentation.empty())
        out << indent << "# " << first_sentence(section->documentation) << '\n';
      out << indent << "subsection " << section->name << '\n';
      write_section(out, *section, indent + "  ");
      out << indent << "end\n";
    }
}

void
collect_values(const ParameterNode &node, std::map<std::string, std::string> &values)
{
  const std::string path = node.path().empty() ? "" : node.path() + "/";
  for (const ParameterEntry *entry : node.declared_entries())
    values[path + entry->key] = entry->value;
  for (const ParameterNode *section : node.declared_sections())
    collect_values(*section, values);
}

/** `text` on one line, with the signs escaped that mean something in a Markdown table. */
std::string
cell(const std::string &text)
{
  std::string escaped;
  for (const char c : text)
    switch (c)
      {
      case '\n':
        escaped += ' ';
        break;
      case '|':
      case '<':
      case '*':
        escaped += '\\';
        [[fallthrough]];
      default:
        escaped += c;
      }
  return escaped;
}

void
write_row(std::ostream &out, const ParameterEntry &entry)
{
  out << "| " << cell(entry.key) << " | "
      << (entry.default_value.empty() ? "(none)" : cell(entry.default_value)) << " | "
      << cell(entry.allowed) << " | " << cell(entry.documentation) << " |\n";
}

constexpr auto table_head = "| Entry | Default | Allowed | Meaning |\n|---|---|---|---|\n";

void
write_markdown_section(std::ostream &out, const ParameterNode &node)
{
  const auto entries = node.declared_entries();
  if (node.parent != nullptr)
    out << "## " << cell(node.path()) << "\n\n";
  if (!node.documentation.empty())
    out << cell(node.documentation) << "\n\n";
  if (!entries.empty())
    {
      out << table_head;
      for (const ParameterEntry *entry : entries)
        write_row(out, *entry);
      out << '\n';
    }
  for (const ParameterNode *section : node.declared_sections())
    write_markdown_section(out, *section);
}

/** The entries of `node` that those of `other` are not, and which are missing. */
void
write_differences(std::ostream &out, const ParameterNode &node, const ParameterNode &other)
{
  std::ostringstream rows;
  for (const ParameterEntry *entry : node.declared_entries())
    {
      const ParameterEntry *same = other.find_entry(entry->key);
      if (same == nullptr || same->default_value != entry->default_value
          || same->allowed != entry->allowed || same->documentation != entry->documentation)
        write_row(rows, *entry);
    }
  std::string missing;
  for (const ParameterEntry *entry : other.declared_entries())
    if (node.find_entry(entry->key) == nullptr)
      missing += (missing.empty() ? "" : ", ") + entry->key;
  if (!rows.str().empty() || !missing.empty())
    out << "### " << cell(node.path()) << "\n\n";
  if (!missing.empty())
    out << "There is no entry " << cell(missing) << ".\n\n";
  if (!rows.str().empty())
    out << table_head << rows.str() << '\n';
  for (const ParameterNode *section : node.declared_sections())
    if (const ParameterNode *same = other.find_section(section->name); same != nullptr)
      write_differences(out, *section, *same);
}
} // namespace

void
ParameterFile::write(std::ostream &out) const
{
  write_section(out, tree->root, "");
}

std::map<std::string, std::string>
ParameterFile::values() const
{
  std::map<std::string, std::string> result;
  collect_values(tree->root, result);
  return result;
}

void
ParameterFile::write_markdown(std::ostream &out) const
{
  write_markdown_section(out, tree->root);
}

void
ParameterFile::write_markdown_differences(std::ostream &out, const ParameterFile &other) const
{
  write_differences(out, tree->root, other.tree->root);
}
} // namespace scree
