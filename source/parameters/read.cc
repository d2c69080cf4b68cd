#include <scree/base/exceptions.h>
#include <scree/base/text_file.h>
#include <scree/parameters/nearest_name.h>
#include <scree/parameters/tree.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <boost/algorithm/string/predicate.hpp>
#include <filesystem>
#include <map>
#include <sstream>

namespace scree
{
namespace
{
namespace fs = std::filesystem;
using dealii::Utilities::trim;

// Far beyond what an input needs; what exceeds them was not meant to be one.
constexpr std::size_t largest_size  = 64000000; // bytes of all files
constexpr std::size_t most_files    = 1000;     // counted as often as they are included
constexpr std::size_t deepest_chain = 100;      // of files that include each other

/** A line with its continuations joined and without its comment; the keyword in lower case. */
struct Statement
{
  std::string    keyword;
  std::string    rest;
  SourcePosition position;
};

/** Splits the text of one file into statements, without regard to what they mean. */
std::vector<Statement>
statements_of(std::istream &in, const std::string &file)
{
  std::vector<Statement> statements;
  std::string            line, joined;
  bool                   is_continuation = false;
  SourcePosition         position{file, 0};
  for (unsigned int n = 1; std::getline(in, line); ++n)
    {
      const bool has_comment = line.find('#') != std::string::npos;
      line                   = trim(line.substr(0, line.find('#')));
      if (line.empty() && has_comment && is_continuation)
        continue;
      if (!is_continuation)
        {
          joined.clear();
          position.line = n;
        }
      is_continuation = !line.empty() && line.back() == '\\';
      if (is_continuation)
        line.pop_back();
      joined += line;
      if (is_continuation || trim(joined).empty())
        continue;

      const std::string text    = trim(joined);
      const auto        gap     = std::min(text.find_first_of(" \t"), text.size());
      std::string       keyword = text.substr(0, gap);
      for (const std::string known : {"set", "subsection", "end", "include"})
        if (boost::iequals(keyword, known))
          keyword = known;
      statements.push_back({keyword, trim(text.substr(gap)), position});
    }
  require(!is_continuation, position.text(), "the file ends in a line that is to be continued",
          "remove the '\\' at its end");
  return statements;
}

/** Reads files into a tree. */
class Reader
{
public:
  void read_file(const std::string &path, const std::string &where, ParameterNode &section)
  {
    require(open_files.size() < deepest_chain, where,
            "more than " + std::to_string(deepest_chain) + " files include one another in a chain",
            "write the parameters into fewer files");
    require(++n_files <= most_files, where,
            "more than " + std::to_string(most_files) + " files are included",
            "write the parameters into fewer files; one that is included twice counts twice");
    const std::string text = read_text_file(
      path, largest_size - n_bytes, where,
      open_files.empty() ? "check the path"
                         : "the path of an included file is relative to the file that includes it");
    n_bytes += text.size();
    std::istringstream in(text);
    const std::string  canonical = fs::weakly_canonical(path).string();
    require(std::find(open_files.begin(), open_files.end(), canonical) == open_files.end(), where,
            "the file '" + path + "' includes itself, directly or through other files",
            "remove one of the 'include' lines");
    open_files.push_back(canonical);
    read(in, path, section);
    open_files.pop_back();
  }

  void read(std::istream &in, const std::string &file, ParameterNode &top)
  {
    std::map<ParameterEntry *, unsigned int> line_of;
    std::vector<Statement>                   open_sections;
    ParameterNode                           *section = &top;
    for (const auto &statement : statements_of(in, file))
      {
        const std::string where = statement.position.text();
        if (statement.keyword == "set")
          set(statement, *section, line_of);
        else if (statement.keyword == "subsection")
          {
            require(!statement.rest.empty()
                      && statement.rest.find_first_of("/=") == std::string::npos,
                    where, "'" + statement.rest + "' cannot be the name of a section",
                    "write 'subsection NAME' with a name without '/' and '='");
            section = &section->get_written_section(statement.rest, where);
            if (section->position.file.empty())
              section->position = statement.position;
            open_sections.push_back(statement);
          }
        else if (statement.keyword == "end" && statement.rest.empty())
          {
            require(!open_sections.empty(), where, "'end' without 'subsection'",
                    "remove it, or add the missing 'subsection' line");
            open_sections.pop_back();
            section = section->parent;
          }
        else if (statement.keyword == "include")
          read_file((fs::path(file).parent_path() / statement.rest).lexically_normal().string(),
                    where, *section);
        else
          throw UserError(
            where,
            "'" + statement.keyword + (statement.rest.empty() ? "" : " " + statement.rest)
              + "' is not understood"
              + did_you_mean(statement.keyword, {"set", "subsection", "end", "include"}),
            "lines are 'set KEY = VALUE', 'subsection NAME', 'end' or 'include FILE'");
      }
    if (!open_sections.empty())
      throw UserError(open_sections.back().position.text(),
                      "'subsection " + open_sections.back().rest + "' has no 'end' in this file",
                      "add a line 'end' behind the last entry of the section");
  }

private:
  void set(const Statement &statement, ParameterNode &section,
           std::map<ParameterEntry *, unsigned int> &line_of) const
  {
    const std::string where  = statement.position.text();
    const auto        equals = statement.rest.find('=');
    require(equals != std::string::npos, where, "'set " + statement.rest + "' has no '='",
            "write 'set KEY = VALUE'");
    const std::string key = trim(statement.rest.substr(0, equals));
    require(!key.empty(), where, "the key before '=' is missing", "write 'set KEY = VALUE'");

    ParameterEntry &entry         = section.get_entry(key);
    const auto [previous, is_new] = line_of.emplace(&entry, statement.position.line);
    if (!is_new)
      throw UserError(where + (section.parent ? ": " + section.path() : ""),
                      "'" + key + "' is set a second time; the first is in line "
                        + std::to_string(previous->second),
                      "keep one of the two lines");
    entry.is_set   = true;
    entry.text     = trim(statement.rest.substr(equals + 1));
    entry.position = statement.position;
  }

  /** The files being read, from the first to the one included last. */
  std::vector<std::string> open_files;
  std::size_t              n_files = 0; //!< read so far
  std::size_t              n_bytes = 0; //!< of them
};
} // namespace

void
read_parameters(ParameterTree &tree, const std::string &path)
{
  Reader().read_file(path, path, tree.root);
}

void
read_parameters_from_string(ParameterTree &tree, const std::string &text)
{
  std::istringstream in(checked_text(text, tree.name));
  Reader().read(in, tree.name, tree.root);
}
} // namespace scree
