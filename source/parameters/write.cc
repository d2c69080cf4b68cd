#include <scree/parameters/file.h>
#include <scree/parameters/tree.h>

#include <ostream>

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
write_markdown_section(std::ostream &out, const ParameterNode &node)
{
  const auto entries = node.declared_entries();
  if (node.parent != nullptr)
    out << "## " << cell(node.path()) << "\n\n";
  if (!node.documentation.empty())
    out << cell(node.documentation) << "\n\n";
  if (!entries.empty())
    {
      out << "| Entry | Default | Allowed | Meaning |\n|---|---|---|---|\n";
      for (const ParameterEntry *entry : entries)
        out << "| " << cell(entry->key) << " | "
            << (entry->default_value.empty() ? "(none)" : cell(entry->default_value)) << " | "
            << cell(entry->allowed) << " | " << cell(entry->documentation) << " |\n";
      out << '\n';
    }
  for (const ParameterNode *section : node.declared_sections())
    write_markdown_section(out, *section);
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
} // namespace scree
