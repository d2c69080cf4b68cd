#pragma once

#include <scree/base/enum_names.h>

#include <deal.II/base/patterns.h>

#include <string>
#include <utility>
#include <vector>

namespace scree
{
struct ParameterTree;
struct ParameterNode;

/**
 * One section of a parameter file, to be visited once by the module it belongs to: every call of
 * entry() declares an entry, reads what the user wrote for it and checks it. Problems do not stop
 * the visit; they are collected and told together by ParameterFile::check().
 *
 * A section is a light handle that may be copied; it is valid as long as its ParameterFile lives.
 */
class ParameterSection
{
public:
  /** Made by ParameterFile::root() and by the functions below. */
  ParameterSection(ParameterTree &tree, ParameterNode &node);

  /**
   * Declares the entry `key` with the current content of `value` as its default, and sets `value`
   * if the user wrote it. A wrong value is recorded as a problem and leaves `value` alone. A text
   * equal to the printed default is always accepted.
   *
   * `T` is bool, int, unsigned int, double, std::string, or, with commas between the components,
   * std::vector<std::string>, std::vector<unsigned int>, std::vector<double>, dealii::Point<2|3>,
   * dealii::Tensor<1, 2|3>, or std::vector<dealii::Point<2|3>> as in "0,0; 1,0; 1,1". NaN means
   * unset and is printed as the empty text; NaN and infinity cannot be written by the user.
   */
  template <typename T>
  void entry(const std::string &key, T &value, const std::string &documentation) const;

  /**
   * The same with a restriction. For lists, points and tensors the pattern is that of the whole
   * text (dealii::Patterns::List) or that of each number or word.
   */
  template <typename T>
  void entry(const std::string &key, T &value, const dealii::Patterns::PatternBase &pattern,
             const std::string &documentation) const;

  /** A choice among `names`; a wrong name is answered with the allowed ones and the nearest. */
  template <typename Enum>
  void entry(const std::string &key, Enum &value, const EnumNames<Enum> &names,
             const std::string &documentation) const
  {
    std::vector<std::string> allowed;
    for (const auto &name : names)
      allowed.push_back(name.second);
    value = value_of(names, choice(key, name_of(names, value), allowed, documentation));
  }

  /** A choice among the names `allowed`: returns what the user chose, or `default_name`. */
  std::string choice(const std::string &key, const std::string &default_name,
                     const std::vector<std::string> &allowed,
                     const std::string              &documentation) const;

  /**
   * Declares `key` as the name of a file: beside the parameter file, or as it is where there is
   * none or --set names it. It becomes absolute, so that a file that is written back finds it too.
   * Of two different ones is warned.
   */
  void file(const std::string &key, std::string &path, const std::string &documentation) const;

  /** The absolute path of such a file that the entry `key` names; empty, and a problem, if it
   * cannot be written back. */
  std::string found_file(const std::string &key, const std::string &path) const;

  /**
   * Declares `key` as formulas for an Expression, in which table(FILE) is a TimeTable; it becomes
   * table(FILE, CHECKSUM) with the absolute path, so that a run that is resumed or repeated sees
   * whether the table is still the same.
   */
  void formula(const std::string &key, std::string &text, const std::string &documentation) const;

  /** Records the subsection `name` as a problem if the user wrote it; what stands there is not
   * read. */
  void refuse(const std::string &name, const std::string &what, const std::string &remedy) const;

  /** Declares the subsection `name` and returns it, whether or not the user wrote it. */
  ParameterSection subsection(const std::string &name, const std::string &documentation) const;

  /**
   * Declares `key` as a list of names ("set Names = block, cylinder") and returns the subsection
   * of each, in order. A listed name needs no subsection in the file; a subsection that is neither
   * listed nor declared by subsection() is a problem, and so are empty and repeated names. In
   * documentation mode there is one subsection, "<name>", and none for a `key` below a subsection
   * that the same `key` made.
   */
  std::vector<std::pair<std::string, ParameterSection>>
  named(const std::string &key, const std::string &documentation) const;

  /**
   * Records a problem that only the module can see. It is told with file and line of `key` (an
   * entry or a subsection) if the user wrote it, else with the line of the section. `key` may be
   * empty. Ignored in documentation mode, and of an entry that cannot be read, which was told.
   */
  void error(const std::string &key, const std::string &what, const std::string &remedy = "") const;

  /** The same for what is possible but hardly meant: it is told, and the run goes on. */
  void warning(const std::string &key, const std::string &what,
               const std::string &remedy = "") const;

  /**
   * Whether the user gave the entry `key` a value other than its default (asked after entry(); the
   * resolved file, which contains every entry, then gives the same answers).
   */
  bool is_set(const std::string &key) const;

  /**
   * Whether what the user wrote for the entry `key` cannot be read (asked after entry()): then its
   * value is the default, and what follows from that must not be told.
   */
  bool is_wrong(const std::string &key) const;

  /**
   * Whether the visit only collects documentation: alternatives of which a run visits one should
   * then all be visited.
   */
  bool is_documentation() const;

  /** "Bodies/block/Shape"; empty for the root. */
  std::string path() const;

private:
  ParameterTree *tree;
  ParameterNode *node;
};

/** The pattern of a number greater than zero (dealii::Patterns::Double has closed bounds only). */
dealii::Patterns::Double positive_number();
} // namespace scree
