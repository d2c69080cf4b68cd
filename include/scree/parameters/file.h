#pragma once

#include <scree/parameters/section.h>

#include <iosfwd>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace scree
{
/**
 * A parameter file as the user wrote it, and after the modules have visited its sections, as it
 * was understood.
 *
 * The syntax is that of dealii::ParameterHandler: `set Key = value`, `subsection Name` ... `end`,
 * `#` starts a comment anywhere in a line, a line ending in `\` goes on in the next one, and
 * `include FILE` reads another file (its path is relative to the including file) as if it stood
 * there. What comes later overrides what came before, but one file may set a key only once.
 *
 * Use: read, override_value, let every module visit root(), check, write.
 */
class ParameterFile
{
public:
  /**
   * Reads a file. Throws UserError with file and line for a missing file, a line that is not
   * understood, a key set twice by the same file, missing or surplus `end`, files that include
   * themselves, and what is no text (read_text_file()) or beyond the bounds of an input: 64 MB,
   * 1000 files, 100 of them in a chain, 100 sections within one another.
   */
  static ParameterFile read(const std::string &path);

  /** The same for a text; `name` stands for the file in messages and for relative includes. */
  static ParameterFile from_string(const std::string &text, const std::string &name = "input");

  /** An empty file in documentation mode: named() has one child "<name>", nothing is a problem. */
  static ParameterFile documentation();

  ParameterFile(ParameterFile &&) noexcept;
  ParameterFile &operator=(ParameterFile &&) noexcept;
  ~ParameterFile();

  /**
   * Sets an entry as the command line does: "Contact/default/Friction coefficient=0.3". Call it
   * before the visit. Throws UserError if the text is not of this form; whether the entry exists
   * is found by check().
   */
  void override_value(const std::string &path_equals_value);

  /** The section that contains everything. */
  ParameterSection root();

  /**
   * Throws one UserError that lists every problem with file, line and section: unknown entries
   * and sections with the nearest valid name, wrong values, and what modules recorded. To be
   * called after all modules have visited their sections.
   */
  void check() const;

  /** What modules found strange but possible, each with file, line and section. */
  std::vector<std::string> warnings() const;

  /**
   * Writes every declared entry in the order of declaration, with its value and the first sentence
   * of its documentation. Reading the result gives identical values.
   */
  void write(std::ostream &out) const;

  /** The values of all declared entries by path, "Bodies/block/Shape/Radius". */
  std::map<std::string, std::string> values() const;

  /** Records tables in formulas that have no value at the start of the run or at `end_time`. */
  void check_tables(const double end_time) const;

  /** Writes a Markdown table per section: entry, default, allowed values, meaning. */
  void write_markdown(std::ostream &out) const;

  /** The entries of this file that `other` has not or not so, and those that only it has. */
  void write_markdown_differences(std::ostream &out, const ParameterFile &other) const;

private:
  ParameterFile();

  std::unique_ptr<ParameterTree> tree;
};
} // namespace scree
