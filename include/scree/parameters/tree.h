#pragma once

#include <scree/base/time_table.h>

#include <memory>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace scree
{
/** Where something was written. */
struct SourcePosition
{
  /** As the user gave it, or "--set" for an override. */
  std::string file;

  /** Counted from 1; 0 if there is none. */
  unsigned int line = 0;

  /** "cases/hertz.prm:12", "cases/hertz.prm" or "--set". */
  std::string text() const;
};

/** One `set Key = text` of the file, one entry declared by a module, or both. */
struct ParameterEntry
{
  std::string key;

  /** What the user wrote, if anything. */
  bool           is_set = false;
  std::string    text;
  SourcePosition position;

  /** It cannot be read, which was told. */
  bool is_wrong = false;

  /** Rank of the declaration among all entries and sections; 0 if no module declared the entry. */
  unsigned int order = 0;
  std::string  value;
  std::string  default_value;
  std::string  allowed;
  std::string  documentation;
};

/** One section, as written and as declared. */
struct ParameterNode
{
  ParameterNode(const std::string &name, ParameterNode *parent);

  /** Sections within sections; an input needs fewer than ten. */
  static constexpr unsigned int largest_depth = 100;

  std::string    name;
  ParameterNode *parent;

  /** 0 for the root. */
  unsigned int depth;

  /** Of the `subsection` line; the file is empty if the user did not write the section. */
  SourcePosition position;

  unsigned int order = 0;
  std::string  documentation;

  /** What stands here is not read, which was told. */
  bool is_refused = false;

  /** The keys that list names of subsections here, and the names listed. */
  std::vector<std::string> name_keys;
  std::vector<std::string> listed_names;

  /** In documentation mode, the key whose stand-in "<name>" this section is. */
  std::string made_by_key;

  std::vector<std::unique_ptr<ParameterEntry>> entries;
  std::vector<std::unique_ptr<ParameterNode>>  sections;

  /** "Bodies/block/Shape"; empty for the root. */
  std::string path() const;

  /** The entry or section of that name, or nullptr. */
  ParameterEntry *find_entry(const std::string &key) const;
  ParameterNode  *find_section(const std::string &section_name) const;

  /** The entry or section of that name, made if there was none. */
  ParameterEntry &get_entry(const std::string &key);
  ParameterNode  &get_section(const std::string &section_name);

  /** The same for what somebody wrote at `where`. @throws UserError if it is nested too deeply */
  ParameterNode &get_written_section(const std::string &section_name, const std::string &where);

  /** What modules declared, in the order of declaration. */
  std::vector<const ParameterEntry *> declared_entries() const;
  std::vector<const ParameterNode *>  declared_sections() const;

private:
  std::unordered_map<std::string, ParameterEntry *> entry_of_key;
  std::unordered_map<std::string, ParameterNode *>  section_of_name;
};

/** Something the user has to change, or should know. */
struct ParameterProblem
{
  SourcePosition position;
  std::string    path;
  std::string    what;
  std::string    remedy;

  /** "cases/hertz.prm:12: Bodies/block". */
  std::string where() const;
};

/** A table in a formula. */
struct TableUse
{
  ParameterNode *node;
  std::string    key;
  TimeTable      table;
};

/** A parameter file: what was written, what was declared, what is wrong. */
struct ParameterTree
{
  ParameterTree(const std::string &name, bool is_documentation);

  std::string                   name;
  bool                          is_documentation;
  ParameterNode                 root;
  unsigned int                  n_declared = 0;
  std::vector<ParameterProblem> problems;
  std::vector<ParameterProblem> warnings;
  std::vector<TableUse>         tables;

  /** Records a problem once, in `node` at `position` or, if that is empty, at the section. */
  void add_problem(const ParameterNode &node, const SourcePosition &position,
                   const std::string &what, const std::string &remedy = "");

  /** The same for what the user should know but need not change. */
  void add_warning(const ParameterNode &node, const SourcePosition &position,
                   const std::string &what, const std::string &remedy = "");

private:
  void add(std::vector<ParameterProblem> &list, const ParameterNode &node,
           const SourcePosition &position, const std::string &what, const std::string &remedy);

  /** Path and text of what was recorded. */
  std::set<std::pair<std::string, std::string>> recorded;
};

/** Reads the file `path` into the empty `tree`; throws what ParameterFile::read() promises. */
void read_parameters(ParameterTree &tree, const std::string &path);

/** The same for a text, for which tree.name stands. */
void read_parameters_from_string(ParameterTree &tree, const std::string &text);
} // namespace scree
